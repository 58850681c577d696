"""What the numbers say of the parameters: significance, identifiability, dependence and correlation, in sentences."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Any

import numpy as np

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_correlation, format_interval, format_number
from tumble.calibrations.core.sentences import equals, series, significant_digits
from tumble.calibrations.methods.dividing_head.flips import FlipClosure
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.messages import Message

STRONG_CORRELATION = 0.9
"""Above this a parameter cannot be used without the one it is correlated with."""


class Kind(StrEnum):
    """What a statement is about."""

    SIGNIFICANCE = "significance"
    """Whether the 95% interval excludes zero, and how many digits the uncertainty supports."""
    NOT_IDENTIFIABLE = "not_identifiable"
    """Parameters without a value: why."""
    DEPENDENCE = "dependence"
    """On what the values rest."""
    CONDITION = "condition"
    """For which alpha0 the values stand."""
    CORRELATION = "correlation"
    """Which values are strongly correlated."""


@dataclass(frozen=True, kw_only=True)
class Statement:
    """One thing that can be said of one or several parameters."""

    about: tuple[str, ...]
    """Names of the parameters."""
    kind: Kind
    text: str
    """Whole sentences."""

    def as_json(self) -> dict[str, Any]:
        """The statement as plain data."""
        return {"about": list(self.about), "kind": self.kind.value, "text": self.text}


def statements(calibration: Calibration) -> tuple[Statement, ...]:
    """Whether each parameter differs from zero, to how many digits it is known, and on what that rests."""
    parameters = tuple(calibration.parameters.values())
    return (
        *_significances(parameters),
        *_not_identifiable(parameters),
        *_dependences(parameters),
        *_conditions(parameters),
        *_correlations(calibration),
    )


def closure_sentence(closure: FlipClosure) -> str:
    """Whether the flips agree on u0, by how much the worst two differ, and how likely that is."""
    names = series(list(closure.axes))
    if len(closure.axes) < 2:
        return Message("Only the {axis} flip is complete: there is nothing to compare its u0 with.", axis=names)
    if closure.worst is None or closure.p_value is None:
        return Message("The {axes} flips were not repeated, so that their difference cannot be judged.", axes=names)
    first, second, difference_v, sigmas = closure.worst
    agree = Message("The {axes} flips agree on u0", axes=names)
    disagree = Message("The {axes} flips do not agree on u0", axes=names)
    return Message(
        "{verdict}: the largest difference, {first} - {second}, is {difference}, or {sigmas:.1f} standard "
        "uncertainties of it (p {p_value} for all of them together).",
        verdict=disagree if closure.p_value < LACK_OF_FIT_P else agree,
        first=first,
        second=second,
        difference=format_number(difference_v, "V", 2),
        sigmas=sigmas,
        p_value=equals(closure.p_value),
    )


def _significances(parameters: Sequence[Parameter]) -> Iterator[Statement]:
    for parameter in parameters:
        if parameter.value is not None and parameter.interval_95 is not None:
            text = _significance(parameter, parameter.value, parameter.interval_95)
            yield Statement(about=(parameter.name,), kind=Kind.SIGNIFICANCE, text=text)


def _significance(parameter: Parameter, value: float, interval: tuple[float, float]) -> str:
    low, high = interval
    span = format_interval(low, high, parameter.unit)
    if not parameter.significant:
        return Message(
            "{name} does not differ significantly from zero: its 95% interval, {interval}, includes it.",
            name=parameter.name,
            interval=span,
        )
    if parameter.rests_on:
        return Message(
            "{name} differs from zero if there is no undeclared second-order term: its 95% interval, {interval}, "
            "excludes it then.",
            name=parameter.name,
            interval=span,
        )
    return Message(
        "{name} differs from zero: its 95% interval, {interval}, excludes it. {digits}",
        name=parameter.name,
        interval=span,
        digits=_digits(value, (high - low) / 2),
    )


def _digits(value: float, expanded: float) -> str:
    if not expanded > 0:
        return Message("No uncertainty is stated, so that its digits cannot be judged.")
    count, relative = significant_digits(value, expanded), _relative(expanded / abs(value))
    if not count:
        return Message(
            "The expanded uncertainty is {relative} of the value and supports its sign only.", relative=relative
        )
    return Message.counted(
        "The expanded uncertainty is {relative} of the value and supports {count} significant digit.",
        "The expanded uncertainty is {relative} of the value and supports {count} significant digits.",
        count=count,
        relative=relative,
    )


def _relative(ratio: float) -> str:
    """A ratio in per cent, or in ppm where that reads better."""
    return (
        f"{format_number(ratio * 100, digits=2)}%" if ratio >= 1e-3 else f"{format_number(ratio * 1e6, digits=2)} ppm"
    )


def _not_identifiable(parameters: Sequence[Parameter]) -> Iterator[Statement]:
    """One statement for all parameters that lack a value for the same reason."""
    lacking = [parameter for parameter in parameters if parameter.value is None]
    for reason, settled_by in dict.fromkeys((p.reason, p.settled_by) for p in lacking):
        names = tuple(p.name for p in lacking if (p.reason, p.settled_by) == (reason, settled_by))
        said = Message.counted(
            "{names} is not identifiable: {reason}.",
            "{names} are not identifiable: {reason}.",
            count=len(names),
            names=series(names),
            reason=reason,
        )
        yield Statement(about=names, kind=Kind.NOT_IDENTIFIABLE, text=_with_remedy(said, settled_by))


def _with_remedy(said: Message, mounts: Sequence[str]) -> Message:
    if not mounts:
        return said
    remedy = Message.counted(
        "One sweep in {mounts} would settle it.",
        "One sweep in any of {mounts} would settle it.",
        count=len(mounts),
        mounts=series(mounts, "or"),
    )
    return Message.joined(" ", [said, remedy])


def _dependences(parameters: Sequence[Parameter]) -> Iterator[Statement]:
    """One statement for all parameters that rest on the same thing."""
    resting = [parameter for parameter in parameters if parameter.value is not None and parameter.rests_on]
    for reason in dict.fromkeys((p.rests_on, p.remark, p.settled_by) for p in resting):
        names = tuple(p.name for p in resting if (p.rests_on, p.remark, p.settled_by) == reason)
        rests_on, remark, settled_by = reason
        said = Message.counted(
            "{names} rests on {other}: {remark}.",
            "{names} rest on {other}: {remark}.",
            count=len(names),
            names=series(names),
            other=rests_on,
            remark=remark,
        )
        yield Statement(about=names, kind=Kind.DEPENDENCE, text=_with_remedy(said, settled_by))


def _conditions(parameters: Sequence[Parameter]) -> Iterator[Statement]:
    for parameter in parameters:
        if parameter.value is not None and parameter.given and not parameter.rests_on:
            said = Message("{name} stands for alpha0 = 0 deg; {remark}.", name=parameter.name, remark=parameter.remark)
            text = _with_remedy(said, parameter.settled_by)
            yield Statement(about=(parameter.name,), kind=Kind.CONDITION, text=text)


def _correlations(calibration: Calibration) -> Iterator[Statement]:
    """One statement for every group of strongly correlated parameters, directly or through another."""
    names = list(calibration.parameters)
    size = np.nan_to_num(np.abs(calibration.correlation))
    np.fill_diagonal(size, 0.0)
    left = set(range(len(names)))
    while left:
        group = _reach(min(left), size)
        left -= group
        if len(group) > 1:
            yield _correlated(sorted(group), names, calibration)


def _reach(start: int, size: np.ndarray) -> set[int]:
    """Everything tied to `start` by a chain of strong correlations, itself included."""
    group, edge = {start}, [start]
    while edge:
        near = {int(i) for i in np.flatnonzero(size[edge.pop()] > STRONG_CORRELATION)} - group
        group |= near
        edge.extend(near)
    return group


def _correlated(group: list[int], names: list[str], calibration: Calibration) -> Statement:
    about = tuple(names[i] for i in group)
    block = calibration.correlation[np.ix_(group, group)][np.triu_indices(len(group), 1)]
    if len(block) == 1:
        how = f"r = {format_correlation(float(block[0]))}"
    else:
        ends = (float(np.min(np.abs(block))), float(np.max(np.abs(block))))
        low, high = map(format_correlation, ends)
        how = Message("|r| from {low} to {high}", low=low, high=high)
    text = Message(
        "{names} are strongly correlated ({correlation}): combinations of them are known better than each alone, "
        "and what is computed from several of them needs their correlation.",
        names=series(about),
        correlation=how,
    )
    return Statement(about=about, kind=Kind.CORRELATION, text=text)
