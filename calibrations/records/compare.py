"""What changed from one record to another."""

import math
from collections.abc import Iterator, Sequence, Set
from dataclasses import dataclass
from typing import Final

from scipy.special import stdtr

from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.quantities import format_number, join, rounded
from tumble.calibrations.core.verdict import Model
from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.messages import Message, read_back

SIGNIFICANT_P: Final = 0.05
"""Chance of calling any value of two records changed though none is."""


@dataclass(frozen=True, kw_only=True)
class Difference:
    """One parameter of two records; without numbers where the two cannot be compared."""

    name: str
    unit: str
    difference: float | None = None
    """The second minus the first."""
    standard_uncertainty: float | None = None
    degrees_of_freedom: float | None = None
    """Of that uncertainty, effective; may be infinite."""
    significance: float | None = None
    """The difference in standard uncertainties."""
    p_value: float | None = None
    """Probability of a difference as large, either way, if nothing changed (Student's t)."""
    sentence: str
    """What changed by how much, and what that means."""
    conclusion: str
    """The latter alone, where the numbers are beside it."""

    @property
    def expanded_uncertainty(self) -> float:
        """Of the difference, for a coverage probability of 95%, in `unit`; 0 where neither value has an uncertainty."""
        freedom = math.inf if self.degrees_of_freedom is None else self.degrees_of_freedom
        return self.standard_uncertainty * coverage_factor(freedom) if self.standard_uncertainty else 0.0


def compare(first: Record, second: Record) -> tuple[Difference, ...]:
    """Differences of the values to use, second minus first; what a loop withheld is not compared.

    The standard uncertainty is the root sum of squares (GUM 5.1.2), as if the two records were independent. What they
    share, the gain of one DAQ and the error of one head, moves both values alike and drops out of the difference: for
    records of one stand the uncertainty is too large, and the test conservative. For two analyses of the same data it
    is far too large: there every difference comes from the analysis, and the sentence says so. An interval
    that is not symmetric counts by its standard uncertainty. Values are called changed at 5% for all of them together
    (Bonferroni): at 5% for each, one of six that stayed as they were would be in every fourth comparison.

    Raises
    ------
    RecordError
        The records are of different methods.
    """
    if first.method != second.method:
        raise RecordError(
            Message(
                "record {first} is of method {first_method}, {second} of {second_method}: their values are not of "
                "one kind; compare records of one method",
                first=first.id,
                first_method=first.method,
                second=second.id,
                second_method=second.method,
            )
        )
    a, b = first.values, second.values
    files, others = set(first.provenance.source_hashes), set(second.provenance.source_hashes)
    of_both = [*_in_common(files, others), *_models(first, second)]
    compared = [name for name in a if name in b and not _obstacle(a[name], b[name])]
    chance = SIGNIFICANT_P / max(len(compared), 1)
    return tuple(
        _difference(a[name], b[name], files == others, chance, [*of_both, *_resting(a[name], b[name])])
        if name in a and name in b
        else _incomparable({**a, **b}[name], Message("only one of the records has it"))
        for name in {**a, **b}
    )


def _difference(
    a: RecordedParameter, b: RecordedParameter, same_file: bool, chance: float, remarks: Sequence[Message]
) -> Difference:
    obstacle = _obstacle(a, b)
    if obstacle or a.value is None or b.value is None:
        return _incomparable(a, obstacle)
    difference, u = b.value - a.value, math.hypot(a.standard_uncertainty or 0.0, b.standard_uncertainty or 0.0)
    significance = difference / u if u else None
    freedom = _freedom(a, b, u)
    p_value = None if significance is None else _two_sided_p(significance, freedom)
    change = _change(a, difference, u)
    said = _of_one_file(change, a.name, difference) if same_file else _sentence(change, p_value, chance)
    return Difference(
        name=a.name,
        unit=a.unit,
        difference=difference,
        standard_uncertainty=u,
        degrees_of_freedom=freedom,
        significance=significance,
        p_value=p_value,
        sentence=Message.joined(" ", [said, *remarks]),
        conclusion=Message.joined(" ", [*_conclusion(difference, p_value, chance, same_file), *remarks]),
    )


def _in_common(files: Set[str], others: Set[str]) -> Iterator[Message]:
    """That the records are not independent, where they are of some of the same raw files, by their hashes."""
    if files & others and files != others:
        yield Message("They have raw files in common: the uncertainty is too large, and the test conservative.")


def _models(first: Record, second: Record) -> Iterator[Message]:
    """Which models the values come from, where they are not the same."""
    if first.model is second.model:
        return
    if first.model is Model.DECLARED:
        yield Message("The first value is of the declared model, the second of the augmented one.")
    else:
        yield Message("The first value is of the augmented model, the second of the declared one.")


def _resting(a: RecordedParameter, b: RecordedParameter) -> Iterator[Message]:
    """On what the values rest, where that was not measured."""
    if a.rests_on and b.rests_on:
        yield Message(
            "It rests in the first on {first} alone and in the second on {second} alone.",
            first=a.rests_on,
            second=b.rests_on,
        )
    elif a.rests_on:
        yield Message("It rests in the first on {name} alone.", name=a.rests_on)
    elif b.rests_on:
        yield Message("It rests in the second on {name} alone.", name=b.rests_on)


def _incomparable(parameter: RecordedParameter, obstacle: str) -> Difference:
    sentence = Message("{name} cannot be compared: {obstacle}.", name=parameter.name, obstacle=obstacle)
    conclusion = Message("Cannot be compared: {obstacle}.", obstacle=obstacle)
    return Difference(name=parameter.name, unit=parameter.unit, sentence=sentence, conclusion=conclusion)


def _obstacle(a: RecordedParameter, b: RecordedParameter) -> str:
    """Why one cannot be subtracted from the other; empty where it can."""
    lacking = ((Message("the first record has no value"), a), (Message("the second record has no value"), b))
    for said, parameter in lacking:
        if parameter.value is None:
            why = read_back(parameter.reason)
            return Message("{said} ({reason})", said=said, reason=why) if why else said
    if a.unit != b.unit:
        return Message(
            "it is in {first} in the first record and in {second} in the second", first=a.unit, second=b.unit
        )
    if a.given != b.given:
        return Message(
            "the first value stands for {first}, the second for {second}", first=_standing(a, b), second=_standing(b, a)
        )
    return ""


def _standing(parameter: RecordedParameter, other: RecordedParameter) -> str:
    """For which values of other parameters it stands, or for which as fitted that the other one takes as given."""
    if parameter.given:
        return ", ".join(given.words for given in parameter.given)
    return Message("{names} as fitted", names=", ".join(given.name for given in other.given))


def _freedom(a: RecordedParameter, b: RecordedParameter, u: float) -> float:
    """Effective degrees of freedom of the difference (Welch-Satterthwaite, GUM G.4.1)."""
    shares = sum(
        (parameter.standard_uncertainty or 0.0) ** 4 / (parameter.degrees_of_freedom or math.inf)
        for parameter in (a, b)
    )
    return u**4 / shares if shares else math.inf


def _two_sided_p(significance: float, freedom: float) -> float:
    if math.isinf(freedom):
        return math.erfc(abs(significance) / math.sqrt(2.0))
    return float(2.0 * stdtr(freedom, -abs(significance)))


def _sentence(change: Message, p_value: float | None, chance: float) -> Message:
    if p_value is None:
        return Message("{change}.", change=change)
    if p_value < chance:
        return Message("{change}: significant (p = {p_value:.2g}).", change=change, p_value=p_value)
    return Message(
        "{change}: not significant (p = {p_value:.2g}; {chance:.1g} is asked for).",
        change=change,
        p_value=p_value,
        chance=chance,
    )


def _of_one_file(change: Message, name: str, difference: float) -> Message:
    if difference == 0.0:
        return Message("{name} did not change: both records come from the same raw data.", name=name)
    return Message(
        "{change}: both records come from the same raw data, so this is what the analysis changed.", change=change
    )


def _conclusion(difference: float, p_value: float | None, chance: float, same_file: bool) -> Iterator[Message]:
    """What a difference means; nothing where it has no uncertainty to be held against."""
    if same_file and difference == 0.0:
        yield Message("No change: both records come from the same raw data.")
    elif same_file:
        yield Message("Both records come from the same raw data: this is what the analysis changed.")
    elif p_value is not None and p_value < chance:
        yield Message("Significant (p = {p_value:.2g}).", p_value=p_value)
    elif p_value is not None:
        yield Message("Not significant (p = {p_value:.2g}; {chance:.1g} is asked for).", p_value=p_value, chance=chance)


def _change(a: RecordedParameter, difference: float, u: float) -> Message:
    """Difference and uncertainty in one unit with the prefix that suits both, to the digits that these have."""
    sign = "-" if difference < 0 else "+"
    text = rounded(abs(difference), u, a.unit)
    number = join(text.value, text.unit) if text.uncertainty else format_number(abs(difference), a.unit)
    return Message(
        "{name} changed by {difference}, standard uncertainty {uncertainty}",
        name=a.name,
        difference=f"{sign}{number}",
        uncertainty=join(text.uncertainty or "0", text.unit),
    )
