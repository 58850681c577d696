"""What closing the loop found, in words: the same for report and terminal."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_concise, format_number, format_probability
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.methods.dividing_head.loop.misreading import MISREADING, Misreading
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.calibrations.tracing.sentences import Finding, findings, unexplained_sentence
from tumble.messages import Message

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
    return Message.joined(" ", [*found, *withheld_sentences(loop), *_verdict(loop, bool(found))])


def found_sentences(loop: Loop) -> list[str]:
    """What was found; empty where nothing was."""
    names = [effect.name for effect in loop.effects if effect.name != MISREADING]
    sentences: list[str] = []
    if names:
        sentences.append(Message("What the declared model leaves was traced to {effects}.", effects=series(names)))
    if loop.unexplained:
        sentences.append(unexplained_sentence(loop.unexplained))
    if loop.misread:
        sentences.append(Message("Read or set wrong by a round amount: {rows}.", rows=misread_text(loop.misread)))
    return sentences


def _verdict(loop: Loop, found: bool) -> Iterator[str]:
    if loop.not_traced:
        yield Message("Nothing was traced: {why}.", why=loop.not_traced)
        yield from loop.still.sentences if loop.still else ()
        return
    few = loop.reach is not None and loop.reach.few
    yield from _agreement(loop, found, few)
    if loop.reach and few:
        yield Message("{limits}.", limits=loop.reach.limits)


def _agreement(loop: Loop, found: bool, few: bool) -> Iterator[str]:
    """Whether the poses agree with the model; that nothing is left only where there are enough settings to say so."""
    p_value = loop.augmented.lack_of_fit_p
    unfit = p_value is not None and p_value < LACK_OF_FIT_P
    if loop.unexplained and not loop.unexplained.shaped:
        return
    if p_value is not None and found:
        yield _with_what_was_found(p_value, unfit)
    elif p_value is not None and unfit:
        yield Message(
            "Neither an effect of the catalogue nor any other structure was found, yet the poses disagree with the "
            "declared model by more than the repeats explain (lack of fit: p {p_value}).",
            p_value=equals(p_value),
        )
    elif not (found or loop.withheld or few):
        yield Message(
            "Nothing is left that the scatter of the data does not explain: neither an effect of the catalogue nor any "
            "other structure stands out of it."
        )


def _with_what_was_found(p_value: float, unfit: bool) -> Message:
    p_text = equals(p_value)
    if unfit:
        return Message(
            "With that taken into account the poses still disagree with the model (lack of fit: p {p_value}).",
            p_value=p_text,
        )
    return Message(
        "With that taken into account the poses agree with the model (lack of fit: p {p_value}).", p_value=p_text
    )


def withheld_sentences(loop: Loop) -> list[str]:
    """What would fit the rows and is not stated, each with the reason."""
    return [
        Message("{effect} would fit these rows and is not stated: {reason}.", effect=each.name, reason=each.reason)
        for each in loop.withheld
    ]


def misread_text(misread: Sequence[Misreading]) -> str:
    """`row 17 by 10°, row 40 by -0.5°`."""
    listed = Message.joined(
        ", ",
        [
            Message("row {row} by {error_deg:.3g}°", row=entry.row, error_deg=entry.error_deg)
            for entry in misread[:_LISTED]
        ],
    )
    more = len(misread) - _LISTED
    return Message("{listed} and {more} more", listed=listed, more=more) if more > 0 else listed


def comparisons(loop: Loop) -> list[Comparison]:
    """Adequacy and parameters of the declared and of the augmented model; none where the two are one.

    Misread rows are in neither.
    """
    shaped = loop.unexplained is not None and loop.unexplained.shaped
    if not shaped and all(effect.name == MISREADING for effect in loop.effects):
        return []
    return [*_adequacy(loop.declared, loop.augmented), *_parameters(loop.declared, loop.augmented)]


def _adequacy(declared: Calibration, augmented: Calibration) -> Iterator[Comparison]:
    yield _scatter(Message("residual, r.m.s."), declared.residual_rms_v, augmented.residual_rms_v)
    yield _scatter(Message("held-out error, r.m.s."), declared.held_out_rms_v, augmented.held_out_rms_v)
    p_values = (declared.lack_of_fit_p, augmented.lack_of_fit_p)
    before, after = (Message("not tested") if p_value is None else format_probability(p_value) for p_value in p_values)
    yield Comparison(name=Message("lack of fit, p"), declared=before, augmented=after, change="")


def _scatter(name: str, before_v: float | None, after_v: float | None) -> Comparison:
    before, after = (
        Message("none") if value_v is None else format_number(value_v, "V") for value_v in (before_v, after_v)
    )
    change = f"× {after_v / before_v:.2g}" if before_v and after_v is not None else ""
    return Comparison(name=name, declared=before, augmented=after, change=change)


def _parameters(declared: Calibration, augmented: Calibration) -> Iterator[Comparison]:
    for name, before in declared.parameters.items():
        after = augmented.parameters[name]
        change = _moved(before, after)
        yield Comparison(name=name, declared=_parameter(before), augmented=_parameter(after), change=change)


def _parameter(parameter: Parameter) -> str:
    if parameter.value is None:
        return Message("not identifiable")
    text = format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)
    return Message("{value}, {condition}", value=text, condition=parameter.condition) if parameter.given else text


def _moved(before: Parameter, after: Parameter) -> str:
    """By how much a value moved, also in standard uncertainties of the declared model: did its budget cover that."""
    alike = before.given == after.given or after.rests_on_absence
    if before.value is None or after.value is None or not before.standard_uncertainty or not alike:
        return ""
    moved = after.value - before.value
    if abs(moved) < _NEGLIGIBLE * before.standard_uncertainty:
        return Message("none")
    sign = "+" if moved > 0 else ""
    return f"{sign}{format_number(moved, after.unit, 2)} ({moved / before.standard_uncertainty:+.1f} u)"


def not_identifiable(loop: Loop) -> list[tuple[str, str]]:
    """Parameters that are not identifiable in the augmented model, each with the reason."""
    return [(name, found.reason) for name, found in loop.augmented.parameters.items() if found.value is None]


def dependence(loop: Loop) -> str:
    """Which parameters rest on another one alone, or on the absence of an effect; empty where none do."""
    resting = {name: parameter for name, parameter in loop.augmented.parameters.items() if parameter.rests_on}
    on_absence = {name: parameter for name, parameter in resting.items() if parameter.rests_on_absence}
    on_another = {name: parameter for name, parameter in resting.items() if name not in on_absence}
    return Message.joined("; ", [said for said in (_on_another(on_another), _on_absence(on_absence)) if said])


def _on_absence(found: Mapping[str, Parameter]) -> str:
    if not found:
        return ""
    return Message.counted(
        "{names} holds if there is no {effects}, of which these rows could hide enough to move it far",
        "{names} hold if there is no {effects}, of which these rows could hide enough to move them far",
        count=len(found),
        names=series(list(found)),
        effects=series(list(dict.fromkeys(each.rests_on for each in found.values())), "or"),
    )


def _on_another(found: Mapping[str, Parameter]) -> str:
    if not found:
        return ""
    first = next(iter(found.values()))
    said = Message.counted(
        "{names} rests on {other} alone: {remark}",
        "{names} rest on {other} alone: {remark}",
        count=len(found),
        names=series(list(found)),
        other=first.rests_on,
        remark=first.remark,
    )
    if not first.settled_by:
        return said
    return Message("{said}; a sweep in {mounts} would settle it", said=said, mounts=series(first.settled_by, "or"))


def findings_of(loop: Loop) -> list[Finding]:
    """The effects found, in the order of the evidence; of misread rows, which they are."""
    found = findings(loop.effects)
    text = misread_text(loop.misread)
    return [replace(each, coefficients=text) if each.name == MISREADING else each for each in found]
