"""Which effects could stand in the place of a found one, by refits of their own.

Only the forms of the catalogue are shared with `calibrations`. The rule is the contract's: an effect that is worse by
less than 3.84 in -2 ln L, with 2 added for each coefficient it has more, is a rival; order, period, time constant,
threshold and reach each count as a coefficient.

Noise is taken as white. Tables in which something was found that is noise itself (realisation_bias, seating,
bias_random_walk) or structure without a name are therefore left out, and as rivals these effects are not judged either.
An effect that was found may take further forms of its own, where chance would do that to one table in fifty; a rival
has one form.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import chdtri

from benchmarks.bank.geometry import FloatArray
from benchmarks.loop.refit import Table
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.loop.loop import Loop
from tumble.calibrations.tracing.effect import Effect, Form

CLOSE, MARGIN = 3.84, 0.3
"""The contract's threshold, and how near to it neither answer is held against a list."""
_JUDGED: Final = {effect.name: effect for effect in CATALOGUE if not effect.random}
_MOST_FORMS, _BY_CHANCE = 3, 0.02
_WORTH_REFINING = 40.0
_STEPS = 12
_PROMISING = 4
"""Forms of an effect that are fitted, after all were tried with alpha0 linearised."""


@dataclass(frozen=True, kw_only=True)
class Part:
    """An effect in one of its forms."""

    effect: Effect
    form: Form
    scanned: int
    """How many values were chosen among others; the fixed order of a named harmonic is none."""

    @property
    def size(self) -> int:
        """How many coefficients it has."""
        return int(self.form.columns.shape[1]) + self.scanned


@dataclass(frozen=True, kw_only=True)
class Refitting:
    """A table as the effects of the catalogue see it."""

    table: Table
    scene: Scene
    near_deg: float | None
    """Where alpha0 is looked for first; None: everywhere."""

    def deviance(self, parts: Sequence[Part]) -> float:
        """Of the best fit with these parts."""
        return self.table.fit(self._columns(parts), self.near_deg).deviance

    def best_form(self, effect: Effect, others: Sequence[Part]) -> Part | None:
        """The form of an effect that fits best beside the others; None where the table cannot show it."""
        forms = list(effect.forms(self.scene))
        if not forms:
            return None
        falls_v2 = self.table.falls_v2(self.scene, self._columns(others), [form.columns for form in forms])
        promising = np.argsort(falls_v2)[::-1][:_PROMISING].tolist()
        scanned = len(forms[0].scanned) if len(forms) > 1 else 0
        parts = {place: Part(effect=effect, form=forms[place], scanned=scanned) for place in promising}
        deviances = {place: self.deviance([*others, part]) for place, part in parts.items()}
        best = min(promising, key=lambda place: deviances[place])
        return self._between(parts[best], sorted(map(_value, forms)), others, deviances[best])

    def _columns(self, parts: Sequence[Part]) -> FloatArray:
        return self.table.side_by_side([part.form.columns for part in parts])

    def _between(self, coarse: Part, values: Sequence[float], others: Sequence[Part], reached: float) -> Part:
        """The best form among all values between the neighbours of the best one tried: in small steps, then anyhow."""
        at = coarse.effect.at
        if at is None:
            return coarse
        place = values.index(_value(coarse.form))
        low, high = values[max(place - 1, 0)], values[min(place + 1, len(values) - 1)]

        def deviance(value: float) -> float:
            return self.deviance([*others, replace(coarse, form=at(self.scene, value))])

        steps = np.linspace(low, high, _STEPS).tolist()
        tried = {value: deviance(value) for value in steps} | {_value(coarse.form): reached}
        least = steps.index(min(steps, key=lambda value: tried[value]))
        ends = steps[max(least - 1, 0)], steps[min(least + 1, _STEPS - 1)]
        found = minimize_scalar(deviance, bounds=ends, method="bounded", options={"maxiter": 20})
        tried[float(found.x)] = float(found.fun)
        return replace(coarse, form=at(self.scene, min(tried, key=lambda value: tried[value])))


def _value(form: Form) -> float:
    """What was scanned; 0 where nothing was."""
    return next(iter(form.scanned.values()), 0.0)


@dataclass(frozen=True, kw_only=True)
class Judged:
    """One effect in the place of another."""

    name: str
    rival: str
    listed: bool
    behind: float


def judged_rivals(loop: Loop) -> list[Judged]:
    """Refit a table with every other effect in the place of each that was found; empty where noise is not white."""
    found = [effect for effect in loop.effects if effect.name != "misreading"]
    if loop.unexplained or not found or any(effect.name not in _JUDGED for effect in found):
        return []
    refitting, parts = _settled(loop, [effect.name for effect in found])
    whole = refitting.deviance(parts)
    return [
        Judged(name=effect.name, rival=rival, listed=rival in effect.also_possible, behind=behind)
        for effect in found
        for rival, behind in _in_place(refitting, parts, whole, effect.name)
    ]


def _settled(loop: Loop, names: Sequence[str]) -> tuple[Refitting, list[Part]]:
    """The found effects in their best forms, seen from the alpha0 that follows."""
    table = Table(observations=loop.augmented.observations, weights=loop.augmented.weights)
    columns: FloatArray = table.side_by_side([])
    parts: list[Part] = []
    for _ in range(2):
        scene = table.scene(columns)
        sharp = abs(table.fit(columns).alpha0_deg - scene.alpha0_deg) < 1e-9
        refitting = Refitting(table=table, scene=scene, near_deg=scene.alpha0_deg if sharp else None)
        parts = _best_together(refitting, names)
        columns = table.side_by_side([part.form.columns for part in parts])
    return refitting, _with_further_forms(refitting, parts)


def _best_together(refitting: Refitting, names: Sequence[str]) -> list[Part]:
    """One form for each effect, by turns."""
    chosen: dict[str, Part] = {}
    for _ in range(1 if len(names) == 1 else 2):
        for name in names:
            others = [part for other, part in chosen.items() if other != name]
            part = refitting.best_form(_JUDGED[name], others)
            if part is not None:
                chosen[name] = part
    return list(chosen.values())


def _with_further_forms(refitting: Refitting, parts: list[Part]) -> list[Part]:
    """Give effects that have several forms more of them, where chance would hardly do that."""
    for effect in [part.effect for part in parts]:
        forms = len(effect.forms(refitting.scene))
        for _ in range(_MOST_FORMS - 1 if forms > 1 else 0):
            more = refitting.best_form(effect, parts)
            if more is None:
                break
            width = more.form.columns.shape[1]
            gain = refitting.deviance(parts) - refitting.deviance([*parts, more])
            if gain < chdtri(width, _BY_CHANCE / forms):
                break
            parts = [*parts, more]
    return parts


def _in_place(refitting: Refitting, parts: Sequence[Part], whole: float, name: str) -> Iterator[tuple[str, float]]:
    """Every other effect with how far it is behind."""
    rest = [part for part in parts if part.effect.name != name]
    size = sum(part.size for part in parts if part.effect.name == name)
    for effect in _JUDGED.values():
        if any(part.effect.name == effect.name for part in parts):
            continue
        rival = refitting.best_form(effect, rest)
        if rival is None:
            continue
        behind = refitting.deviance([*rest, rival]) - whole + 2.0 * (rival.size - size)
        if behind < _WORTH_REFINING:
            with_rest = _best_again(replace(refitting, near_deg=None), rest, rival)
            behind = min(behind, with_rest - whole + 2.0 * (rival.size - size))
        yield effect.name, behind


def _best_again(refitting: Refitting, rest: Sequence[Part], rival: Part) -> float:
    """Deviance once the rest has taken its best forms beside the rival, alpha0 being looked for everywhere."""
    settled = list(rest)
    for place, part in enumerate(settled):
        if part.effect.at is not None:
            others = [*settled[:place], *settled[place + 1 :], rival]
            settled[place] = refitting.best_form(part.effect, others) or part
    return refitting.deviance([*settled, rival])
