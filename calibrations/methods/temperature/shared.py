"""Causes that several parameters share: breaks at one temperature."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from scipy.special import chdtrc

from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.temperature.effects import BREAK
from tumble.calibrations.methods.temperature.settled import RunTable
from tumble.calibrations.tracing.effect import Form
from tumble.calibrations.tracing.fitting_noise import golden_section
from tumble.calibrations.tracing.linear_loop import LinearExplained
from tumble.calibrations.tracing.trace import Found
from tumble.messages import Message

_AGREE = 0.01
"""Chance above which breaks of several parameters may lie at one temperature."""


@dataclass(frozen=True, kw_only=True)
class SharedCause:
    """A break of several parameters that may have one cause."""

    at_degc: float
    """Where it lies if it is one."""
    between_degc: tuple[float, float]
    """The runs between which it lies."""
    parameters: tuple[str, ...]
    p_value: float
    """That breaks which lie at one temperature come out as far apart."""

    @property
    def one(self) -> bool:
        """Whether the fits agree on one temperature; else it is only the gap between the runs that they share."""
        return self.p_value > _AGREE


@dataclass(frozen=True, kw_only=True)
class _Break:
    """The break of one parameter."""

    name: str
    explained: LinearExplained[RunTable]
    found: Found

    @property
    def at_degc(self) -> float:
        return self.found.form.scanned["at_degC"]

    def deviance(self, at_degc: float) -> float:
        """-2 ln L of the parameter with its break elsewhere."""
        at = self.found.effect.at
        assert at is not None, "a break has a place"
        others: list[Form] = [item.form for item in self.explained.trace.found if item is not self.found]
        table, noise = self.explained.table, self.explained.trace.noise
        return table.deviance([*others, at(table.scene, at_degc)], noise)


def shared_causes(explained: Mapping[str, LinearExplained[RunTable]]) -> tuple[SharedCause, ...]:
    """Breaks that several parameters may share: in one gap between runs, or at one temperature by their fits."""
    breaks = [
        _Break(name=name, explained=one, found=item)
        for name, one in explained.items()
        for item in one.trace.found
        if item.effect.name == BREAK
    ]
    groups: list[list[_Break]] = []
    for one in sorted(breaks, key=lambda each: each.at_degc):
        if groups and _together([*groups[-1], one]):
            groups[-1].append(one)
        else:
            groups.append([one])
    return tuple(_cause(group) for group in groups if len(group) > 1)


def _together(group: Sequence[_Break]) -> bool:
    gaps = {_gap(group[0], one.at_degc) for one in group}
    return len(gaps) == 1 or _cause(group).one


def _cause(group: Sequence[_Break]) -> SharedCause:
    """The temperature at which all of them are worst off least, and what that costs them."""
    places = [one.at_degc for one in group]

    def deviance(at_degc: float) -> float:
        return sum(one.deviance(at_degc) for one in group)

    at_degc = golden_section(deviance, min(places) - 1e-6, max(places) + 1e-6, steps=20)
    worse = deviance(at_degc) - sum(one.deviance(one.at_degc) for one in group)
    return SharedCause(
        at_degc=at_degc,
        between_degc=_gap(group[0], at_degc),
        parameters=tuple(one.name for one in group),
        p_value=float(chdtrc(len(group) - 1, max(worse, 0.0))),
    )


def _gap(one: _Break, at_degc: float) -> tuple[float, float]:
    """The runs between which a temperature lies."""
    known = one.explained.table.runs.known_degc
    place = int(np.clip(np.searchsorted(known, at_degc), 1, len(known) - 1))
    return float(known[place - 1]), float(known[place])


def shared_sentence(cause: SharedCause) -> str:
    """Which parameters break together."""
    low, high = cause.between_degc
    agreement = (
        Message("their fits agree on one temperature") if cause.one else Message("they share the gap between two runs")
    )
    return Message(
        "{parameters} break between {low:.0f} and {high:.0f} °C, near {at:.1f} °C: {agreement} (p {p_value}), and may "
        "have one cause.",
        parameters=series(cause.parameters),
        low=low,
        high=high,
        at=cause.at_degc,
        agreement=agreement,
        p_value=equals(cause.p_value),
    )
