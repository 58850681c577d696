"""What changed from one record to another."""

import math
from dataclasses import dataclass

from scipy.special import stdtr

from tumble.calibrations.records.errors import RecordError
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.messages import Message

SIGNIFICANT_P = 0.05


@dataclass(frozen=True, kw_only=True)
class Difference:
    """One parameter of two records; without numbers where the two cannot be compared."""

    name: str
    unit: str
    difference: float | None = None
    """The second minus the first."""
    standard_uncertainty: float | None = None
    significance: float | None = None
    """The difference in standard uncertainties."""
    p_value: float | None = None
    """Probability of a difference as large, either way, if nothing changed (Student's t)."""
    sentence: str


def compare(first: Record, second: Record) -> tuple[Difference, ...]:
    """Differences of the values to use, second minus first; what a loop withheld is not compared.

    The standard uncertainty is the root sum of squares (GUM 5.1.2), as if the two records were independent. What they
    share, the gain of one DAQ and the error of one head, moves both values alike and drops out of the difference: for
    records of one stand the uncertainty is too large, and the test conservative. For two analyses of one raw file it
    is far too large: there every difference comes from the analysis, and the sentence says so. An interval
    that is not symmetric counts by its standard uncertainty.

    Raises
    ------
    RecordError
        The records are of different methods.
    """
    if first.method != second.method:
        raise RecordError(
            Message(
                "record {first_id} is of method {method}, {second_id} of {method2}: their values are not of one "
                "kind; compare records of one method",
                first_id=first.id,
                method=first.method,
                second_id=second.id,
                method2=second.method,
            )
        )
    a, b = first.values, second.values
    same_file = set(first.provenance.source_hashes) == set(second.provenance.source_hashes)
    return tuple(
        _difference(a[name], b[name], same_file, remark=_models(first, second) + _resting(a[name], b[name]))
        if name in a and name in b
        else _incomparable({**a, **b}[name], "only one of the records has it")
        for name in {**a, **b}
    )


def _difference(a: RecordedParameter, b: RecordedParameter, same_file: bool, remark: str) -> Difference:
    obstacle = _obstacle(a, b)
    if obstacle or a.value is None or b.value is None:
        return _incomparable(a, obstacle)
    difference, u = b.value - a.value, math.hypot(a.standard_uncertainty or 0.0, b.standard_uncertainty or 0.0)
    significance = difference / u if u else None
    p_value = None if significance is None else _two_sided_p(significance, _freedom(a, b, u))
    return Difference(
        name=a.name,
        unit=a.unit,
        difference=difference,
        standard_uncertainty=u,
        significance=significance,
        p_value=p_value,
        sentence=_sentence(a, difference, u, p_value, same_file) + remark,
    )


def _models(first: Record, second: Record) -> str:
    """Which models the values come from, where they are not the same."""
    if first.model is second.model:
        return ""
    return f" The first value is of the {first.model} model, the second of the {second.model} one."


def _resting(a: RecordedParameter, b: RecordedParameter) -> str:
    """On what the values rest, where that was not measured."""
    sides = [f"the {which} on {p.rests_on} alone" for which, p in (("first", a), ("second", b)) if p.rests_on]
    return f" It rests in {' and in '.join(sides)}." if sides else ""


def _incomparable(parameter: RecordedParameter, obstacle: str) -> Difference:
    sentence = f"{parameter.name} cannot be compared: {obstacle}."
    return Difference(name=parameter.name, unit=parameter.unit, sentence=sentence)


def _obstacle(a: RecordedParameter, b: RecordedParameter) -> str:
    """Why one cannot be subtracted from the other; empty where it can."""
    for which, parameter in (("first", a), ("second", b)):
        if parameter.value is None:
            return f"the {which} record has no value" + (f" ({parameter.reason})" if parameter.reason else "")
    if a.unit != b.unit:
        return f"it is in {a.unit} in the first record and in {b.unit} in the second"
    if a.given != b.given:
        return f"the first value stands {_standing(a, b)}, the second {_standing(b, a)}"
    return ""


def _standing(parameter: RecordedParameter, other: RecordedParameter) -> str:
    """For which values of other parameters it stands, or for which as fitted that the other one takes as given."""
    if parameter.given:
        return f"for {', '.join(given.words for given in parameter.given)}"
    return f"for {', '.join(given.name for given in other.given)} as fitted"


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


def _sentence(a: RecordedParameter, difference: float, u: float, p_value: float | None, same_file: bool) -> str:
    change = f"{a.name} changed by {difference:+.3g} {a.unit}, standard uncertainty {u:.2g} {a.unit}"
    if same_file and difference == 0.0:
        return f"{a.name} did not change: both records come from one raw file."
    if same_file:
        return f"{change}: both records come from one raw file, so this is what the analysis changed."
    if p_value is None:
        return f"{change}."
    judgement = "significant" if p_value < SIGNIFICANT_P else "not significant"
    return f"{change}: {judgement} (p = {p_value:.2g})."
