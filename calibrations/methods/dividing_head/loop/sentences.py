"""What closing the loop found, in words: the same for report and terminal."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_number, format_probability
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.misreading import Misreading
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing.sentences import Finding, findings, unexplained_sentence

MISREADING = "misreading"
_NEGLIGIBLE = 0.01
"""A change below this part of the standard uncertainty is none."""
_LISTED = 6
"""Of the misread rows so many are listed, the rest counted."""


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """One number before and after what was found is taken into account, every cell as text."""

    name: str
    declared: str
    augmented: str
    change: str
    """Empty where the two have no difference: one has no value, or they stand for different alpha0."""


def headline(loop: Loop) -> str:
    """What was found, or that nothing was, and whether the poses agree with the model after all."""
    found = found_sentences(loop)
    return " ".join(part for part in (*found, *withheld_sentences(loop), _verdict(loop, bool(found))) if part)


def found_sentences(loop: Loop) -> list[str]:
    """What was found; empty where nothing was."""
    named = [effect.name for effect in loop.effects if effect.name != MISREADING]
    sentences = [f"What the declared model leaves was traced to {series(named)}."] if named else []
    if loop.unexplained:
        sentences.append(unexplained_sentence(loop.unexplained))
    if loop.misread:
        sentences.append(f"Read or set wrong by a round amount: {misread_text(loop.misread)}.")
    return sentences


def _verdict(loop: Loop, found: bool) -> str:
    if loop.not_traced:
        return " ".join((f"Nothing was traced: {loop.not_traced}.", *(loop.still.sentences if loop.still else ())))
    limits = f"{loop.reach.limits}." if loop.reach and loop.reach.few else ""
    return " ".join(part for part in (_agreement(loop, found, bool(limits)), limits) if part)


def _agreement(loop: Loop, found: bool, few: bool) -> str:
    """Whether the poses agree with the model; that nothing is left only where there are enough settings to say so."""
    p_value = loop.augmented.lack_of_fit_p
    unfit = p_value is not None and p_value < LACK_OF_FIT_P
    if loop.unexplained and not loop.unexplained.shaped:
        return ""
    if p_value is not None and found:
        verdict = "the poses still disagree" if unfit else "the poses agree"
        return f"With that taken into account {verdict} with the model (lack of fit: p {equals(p_value)})."
    if p_value is not None and unfit:
        return (
            "Neither an effect of the catalogue nor any other structure was found, yet the poses disagree with the "
            f"declared model by more than the repeats explain (lack of fit: p {equals(p_value)})."
        )
    if found or loop.withheld or few:
        return ""
    return (
        "Nothing is left that the scatter of the data does not explain: neither an effect of the catalogue nor any "
        "other structure stands out of it."
    )


def withheld_sentences(loop: Loop) -> list[str]:
    """What would fit the rows and is not stated, each with the reason."""
    return [f"{each.name} would fit these rows and is not stated: {each.reason}." for each in loop.withheld]


def misread_text(misread: Sequence[Misreading]) -> str:
    """`row 17 by 10°, row 40 by -0.5°`."""
    listed = ", ".join(f"row {entry.row} by {entry.error_deg:.3g}°" for entry in misread[:_LISTED])
    more = len(misread) - _LISTED
    return f"{listed} and {more} more" if more > 0 else listed


def comparisons(loop: Loop) -> list[Comparison]:
    """Adequacy and parameters of the declared and of the augmented model; none where the two are one.

    Misread rows are in neither.
    """
    shaped = loop.unexplained is not None and loop.unexplained.shaped
    if not shaped and all(effect.name == MISREADING for effect in loop.effects):
        return []
    return [*_adequacy(loop.declared, loop.augmented), *_parameters(loop.declared, loop.augmented)]


def _adequacy(declared: Calibration, augmented: Calibration) -> Iterator[Comparison]:
    yield _scatter("residual, r.m.s.", declared.residual_rms_v, augmented.residual_rms_v)
    yield _scatter("held-out error, r.m.s.", declared.held_out_rms_v, augmented.held_out_rms_v)
    p_values = (declared.lack_of_fit_p, augmented.lack_of_fit_p)
    before, after = ("not tested" if p_value is None else format_probability(p_value) for p_value in p_values)
    yield Comparison(name="lack of fit, p", declared=before, augmented=after, change="")


def _scatter(name: str, before_v: float | None, after_v: float | None) -> Comparison:
    before, after = ("none" if value_v is None else format_number(value_v, "V") for value_v in (before_v, after_v))
    change = f"× {after_v / before_v:.2g}" if before_v and after_v is not None else ""
    return Comparison(name=name, declared=before, augmented=after, change=change)


def _parameters(declared: Calibration, augmented: Calibration) -> Iterator[Comparison]:
    for name, before in declared.parameters.items():
        after = augmented.parameters[name]
        change = _moved(before, after)
        yield Comparison(name=name, declared=_parameter(before), augmented=_parameter(after), change=change)


def _parameter(parameter: Parameter) -> str:
    if parameter.value is None:
        return "cannot be told"
    text = format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)
    return text if parameter.given_alpha0_deg is None else f"{text}, given alpha0 = {parameter.given_alpha0_deg:g}°"


def _moved(before: Parameter, after: Parameter) -> str:
    """By how much a value moved, also in standard uncertainties of the declared model: did its budget cover that."""
    alike = before.given_alpha0_deg == after.given_alpha0_deg
    if before.value is None or after.value is None or not before.standard_uncertainty or not alike:
        return ""
    moved = after.value - before.value
    if abs(moved) < _NEGLIGIBLE * before.standard_uncertainty:
        return "none"
    sign = "+" if moved > 0 else ""
    return f"{sign}{format_number(moved, after.unit, 2)} ({moved / before.standard_uncertainty:+.1f} u)"


def untold(loop: Loop) -> list[tuple[str, str]]:
    """Parameters that the augmented model does not tell, each with the reason."""
    return [(name, found.reason) for name, found in loop.augmented.parameters.items() if found.value is None]


def leaning(loop: Loop) -> str:
    """Which parameters rest on another one alone, and what would end that; empty where none do."""
    found = {name: parameter for name, parameter in loop.augmented.parameters.items() if parameter.rests_on}
    if not found:
        return ""
    first = next(iter(found.values()))
    names, verb = series(list(found)), "rest" if len(found) > 1 else "rests"
    settled = f"; a sweep in {series(first.settled_by, 'or')} would settle it" if first.settled_by else ""
    return f"{names} {verb} on {first.rests_on} alone: {first.remark}{settled}"


def findings_of(loop: Loop) -> list[Finding]:
    """The effects found, in the order of the evidence; of misread rows, which they are."""
    found = findings(loop.effects)
    text = misread_text(loop.misread)
    return [replace(each, coefficients=text) if each.name == MISREADING else each for each in found]
