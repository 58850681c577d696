"""What an experiment could support: sentences that follow from the numbers, for report, terminal and JSON."""

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

STRONG_CORRELATION = 0.9
"""Above this a parameter cannot be used without the one it hangs together with."""


class Kind(StrEnum):
    """What a statement is about."""

    SIGNIFICANCE = "significance"
    """Whether the 95% interval excludes zero, and how many digits the uncertainty supports."""
    UNTOLD = "untold"
    """Parameters without a value: why."""
    DEPENDENCE = "dependence"
    """On what the values rest."""
    CONDITION = "condition"
    """For which alpha0 the values stand."""
    CORRELATION = "correlation"
    """Which values hang together."""


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


def support(calibration: Calibration) -> tuple[Statement, ...]:
    """Say of every parameter whether it differs from zero, to how many digits it is known and on what that rests."""
    parameters = tuple(calibration.parameters.values())
    return (
        *_significances(parameters),
        *_untold(parameters),
        *_dependences(parameters),
        *_conditions(parameters),
        *_correlations(calibration),
    )


def closure_sentence(closure: FlipClosure) -> str:
    """Whether the flips agree on u0, by how much the worst two differ, and how likely that is."""
    names = series(list(closure.axes))
    if len(closure.axes) < 2:
        return f"Only the {names} flip is complete: there is nothing to compare its u0 with."
    if closure.worst is None or closure.p_value is None:
        return f"The {names} flips were not repeated, so that their difference cannot be judged."
    first, second, difference_v, sigmas = closure.worst
    verdict = "do not agree" if closure.p_value < LACK_OF_FIT_P else "agree"
    return (
        f"The {names} flips {verdict} on u0: the largest difference, {first} - {second}, is "
        f"{format_number(difference_v, 'V', 2)}, or {sigmas:.1f} standard uncertainties of it "
        f"(p {equals(closure.p_value)} for all of them together)."
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
        return f"{parameter.name} cannot be told from zero: its 95% interval, {span}, includes it."
    if parameter.rests_on:
        return (
            f"{parameter.name} differs from zero if there is no undeclared second-order term: its 95% interval, "
            f"{span}, excludes it then."
        )
    return (
        f"{parameter.name} differs from zero: its 95% interval, {span}, excludes it. {_digits(value, (high - low) / 2)}"
    )


def _digits(value: float, expanded: float) -> str:
    if not expanded > 0:
        return "No uncertainty is stated, so that its digits cannot be judged."
    count = significant_digits(value, expanded)
    relative = f"The expanded uncertainty is {_relative(expanded / abs(value))} of the value and supports"
    return f"{relative} {count} significant digit{'s' if count > 1 else ''}." if count else f"{relative} its sign only."


def _relative(ratio: float) -> str:
    """A ratio in per cent, or in ppm where that reads better."""
    return (
        f"{format_number(ratio * 100, digits=2)}%" if ratio >= 1e-3 else f"{format_number(ratio * 1e6, digits=2)} ppm"
    )


def _untold(parameters: Sequence[Parameter]) -> Iterator[Statement]:
    """One statement for all parameters that lack a value for the same reason."""
    untold = [parameter for parameter in parameters if parameter.value is None]
    for reason, settled_by in dict.fromkeys((p.reason, p.settled_by) for p in untold):
        names = tuple(p.name for p in untold if (p.reason, p.settled_by) == (reason, settled_by))
        text = f"{series(names)} cannot be told: {reason}.{_remedy(settled_by)}"
        yield Statement(about=names, kind=Kind.UNTOLD, text=text)


def _remedy(mounts: Sequence[str]) -> str:
    if not mounts:
        return ""
    return f" {'One sweep in' if len(mounts) == 1 else 'One sweep in any of'} {series(mounts, 'or')} would settle it."


def _dependences(parameters: Sequence[Parameter]) -> Iterator[Statement]:
    """One statement for all parameters that rest on the same thing."""
    resting = [parameter for parameter in parameters if parameter.value is not None and parameter.rests_on]
    for reason in dict.fromkeys((p.rests_on, p.remark, p.settled_by) for p in resting):
        names = tuple(p.name for p in resting if (p.rests_on, p.remark, p.settled_by) == reason)
        rests_on, remark, settled_by = reason
        text = f"{series(names)} rest{'s' if len(names) == 1 else ''} on {rests_on}: {remark}.{_remedy(settled_by)}"
        yield Statement(about=names, kind=Kind.DEPENDENCE, text=text)


def _conditions(parameters: Sequence[Parameter]) -> Iterator[Statement]:
    for parameter in parameters:
        if parameter.value is not None and parameter.given_alpha0_deg is not None:
            text = f"{parameter.name} {parameter.remark} {parameter.unit}.{_remedy(parameter.settled_by)}"
            yield Statement(about=(parameter.name,), kind=Kind.CONDITION, text=text)


def _correlations(calibration: Calibration) -> Iterator[Statement]:
    """One statement for every group of parameters that hang together, directly or through another."""
    names = list(calibration.parameters)
    size = np.nan_to_num(np.abs(calibration.correlation))
    np.fill_diagonal(size, 0.0)
    left = set(range(len(names)))
    while left:
        group = _reach(min(left), size)
        left -= group
        if len(group) > 1:
            yield _hanging_together(sorted(group), names, calibration)


def _reach(start: int, size: np.ndarray) -> set[int]:
    """Everything tied to `start` by a chain of strong correlations, itself included."""
    group, edge = {start}, [start]
    while edge:
        near = {int(i) for i in np.flatnonzero(size[edge.pop()] > STRONG_CORRELATION)} - group
        group |= near
        edge.extend(near)
    return group


def _hanging_together(group: list[int], names: list[str], calibration: Calibration) -> Statement:
    about = tuple(names[i] for i in group)
    block = calibration.correlation[np.ix_(group, group)][np.triu_indices(len(group), 1)]
    if len(block) == 1:
        how = f"r = {format_correlation(float(block[0]))}"
    else:
        ends = (float(np.min(np.abs(block))), float(np.max(np.abs(block))))
        how = f"|r| from {format_correlation(ends[0])} to {format_correlation(ends[1])}"
    text = (
        f"{series(about)} hang together ({how}): combinations of them are known better than each alone, "
        "and what is computed from several of them needs their correlation."
    )
    return Statement(about=about, kind=Kind.CORRELATION, text=text)
