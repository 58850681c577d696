"""How far a form is from everything that the catalogue has, and along which variables it may be said to be.

Both by linear algebra on the rows of a table, the effects made by the simulated world: no line of the analysis is used.
"""

from collections.abc import Iterator, Sequence
from itertools import pairwise
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from benchmarks.triad.effects import STAND, UNIT
from benchmarks.triad.world import ARCSEC, Array, Dwells, Made

NOT_PARTED: Final = 4.8
"""Noise units: what leaves less of a form is not parted from it by the rows."""
_TIMES: Final = np.geomspace(0.02, 1.0, 16)
_PERIODS: Final = np.arange(1.0, 8.01, 0.25)
_GAP_V: Final = 1e-3
"""Outputs that are closer are one to a step of the range."""
_STEP_ARCSEC: Final = 1.0
_NOTHING: Final = 1e-6
_DWELLS_EACH: Final = 3
"""So many dwells each value, or each piece of the line, has in the mean."""


class Seen:
    """The rows of a table of nominal geometry, each over its noise, beside the declared model."""

    def __init__(self, made: Made) -> None:
        self._weight = 1.0 / np.tile(made.noise_v, len(made.clean_v))
        columns = made.columns
        self._columns, self._clean_v = columns, made.clean_v
        self._gravity = self._dwells().gravity()
        declared = np.column_stack([self._white(each) for each in self._parameters()])
        self._declared = _span(declared / np.linalg.norm(declared, axis=0))
        self.effect = self._beside(self._white(made.effect_v))

    def left_by_two(self) -> float:
        """What the nearest one or two effects of the catalogue leave of what was put in, in noise units.

        All nonlinearities of a channel count as one.
        """
        forms = [self._shown(form) for form in self._catalogue()]
        best = float(np.linalg.norm(self.effect))
        stacked = np.column_stack(forms)
        ends = np.cumsum([0, *(form.shape[1] for form in forms)])
        for form in forms:
            left = self.effect - form @ (form.T @ self.effect)
            further = stacked - form @ (form.T @ stacked)
            for start, stop in pairwise(ends.tolist()):
                second = _span(further[:, start:stop])
                best = min(best, float(np.linalg.norm(left - second @ (second.T @ left))))
        return best

    def variables(self, true: str) -> frozenset[str]:
        """The variable along which a form was put in, and those along which some course leaves nothing to see of it."""
        as_well = (name for name, values, gain in self._channels() if self._left_by(values, gain) < NOT_PARTED)
        return frozenset((true, *as_well))

    def _dwells(self) -> Dwells:
        columns = self._columns
        warmth = columns["temperature_degC"] - 23.0
        return Dwells(
            outer_deg=columns["outer_deg"],
            inner_deg=columns["inner_deg"],
            time_s=columns["time_s"],
            realisation=columns["realisation"],
            outer_direction=columns["outer_direction"],
            inner_direction=columns["inner_direction"],
            temperature_k=np.repeat(warmth[:, None], 3, axis=1),
        )

    def _white(self, values: Array) -> Array:
        return np.asarray(values.ravel() * self._weight)

    def _beside(self, columns: Array) -> Array:
        return np.asarray(columns - self._declared @ (self._declared.T @ columns))

    def _shown(self, columns: Sequence[Array]) -> Array:
        """Orthonormal directions of columns, shape (dwells, 3) each, beside the declared model."""
        white = np.column_stack([self._white(each) for each in columns])
        length = np.linalg.norm(white, axis=0)
        return _span(self._beside(white[:, length > 0.0] / length[length > 0.0]))

    def _parameters(self) -> Iterator[Array]:
        """What each of the fourteen declared parameters adds, shape (dwells, 3)."""
        for channel in range(3):
            yield from self._in_channel(channel, np.column_stack([np.ones(len(self._gravity)), self._gravity]))
        for name in ("level_x", "level_y"):
            yield self._turned(lambda dwells, name=name: setattr(dwells, name, getattr(dwells, name) + _STEP_ARCSEC))

    def _in_channel(self, channel: int, columns: Array) -> Iterator[Array]:
        for column in columns.T:
            out = np.zeros((len(column), 3))
            out[:, channel] = column
            yield out

    def _turned(self, change: Any) -> Array:
        """What a change of the stand adds to the outputs of an ideal unit."""
        dwells = self._dwells()
        change(dwells)
        return np.asarray((dwells.gravity() - self._gravity) / ARCSEC)

    def _catalogue(self) -> Iterator[list[Array]]:
        """Columns of each form of each effect, shape (dwells, 3) each."""
        dwells, gravity, output_v = self._dwells(), self._gravity, self._clean_v
        part = (dwells.time_s - dwells.time_s[0]) / np.ptp(dwells.time_s)
        alone = {name: unit(dwells, gravity, output_v, 1.0) for name, unit in UNIT.items()}
        yield [alone["settling"]]
        for channel in "xyz":
            yield [values for name, values in alone.items() if name.startswith(f"{channel}.")]
        for slow in (part, dwells.temperature_k[:, 0]):
            yield self._in_each(slow[:, None] * np.ones(3))
            yield self._in_each(slow[:, None] * gravity)
        for time in _TIMES:
            yield self._in_each(np.exp(-part / time)[:, None] * np.ones(3))
        levels = dwells.realisation[:, None] == np.unique(dwells.realisation)
        yield [each for level in levels.T for each in self._in_each(level[:, None] * np.ones(3))]
        for period in np.ptp(output_v) / _PERIODS:
            yield [np.sin(2 * np.pi * output_v / period), np.cos(2 * np.pi * output_v / period)]
        ordered_v = np.sort(output_v.ravel())
        for gap in np.flatnonzero(np.diff(ordered_v) > _GAP_V):
            yield [(output_v > ordered_v[gap : gap + 2].mean()).astype(float)]
        yield from self._of_the_stand()

    def _of_the_stand(self) -> Iterator[list[Array]]:
        for name in ("axes_orthogonality", "outer_backlash", "inner_backlash"):
            yield [self._turned(lambda dwells, name=name: STAND[name](dwells, _STEP_ARCSEC))]
        for order in (1, 2):
            for axis in ("outer", "inner"):
                yield [self._turned(_wave(axis, order, phase)) for phase in (0.0, np.pi / 2)]
        for change in (_wobble, _nod):
            yield [self._turned(change(phase)) for phase in (0.0, np.pi / 2)]
        hours = self._columns["time_s"] / 3600.0
        yield [
            self._turned(lambda dwells, name=name: setattr(dwells, name, getattr(dwells, name) + hours))
            for name in ("level_x", "level_y")
        ]

    def _in_each(self, values: Array) -> list[Array]:
        return [next(self._in_channel(channel, values[:, [channel]])) for channel in range(3)]

    def _channels(self) -> Iterator[tuple[str, NDArray[Any], Array]]:
        """Each variable with each channel that may follow it: a value for each dwell, and a gain, (dwells, 3)."""
        columns = self._columns
        of_the_unit: dict[str, list[NDArray[Any]]] = {
            "time": [columns["time_s"]],
            "temperature": [columns["temperature_degC"]],
            "direction": [columns["outer_direction"], columns["inner_direction"]],
            "realisation": [columns["realisation"]],
        }
        for channel in range(3):
            felt = self._gravity[:, channel]
            offset, scale = (
                next(self._in_channel(channel, np.ones((len(felt), 1)))),
                self._in_each(self._gravity)[channel],
            )
            yield "acceleration", np.round(felt, 3), offset
            for name, listed in of_the_unit.items():
                for values in listed:
                    yield name, values, offset
                    yield name, values, scale
        for axis in ("outer", "inner"):
            error = self._turned(lambda dwells, axis=axis: _turn(dwells, axis, np.array(_STEP_ARCSEC)))
            yield "angle", columns[f"{axis}_deg"] % 360.0, error
            yield "time", columns["time_s"], error

    def _left_by(self, values: NDArray[Any], gain: Array) -> float:
        """What any course along a variable leaves of the form: a level for each value, of many values a broken line."""
        distinct, number = np.unique(values, return_inverse=True)
        if len(distinct) <= len(values) // _DWELLS_EACH:
            levels = (number[:, None] == np.arange(len(distinct))).astype(float)
        else:
            knots = np.quantile(values, np.linspace(0.0, 1.0, len(values) // _DWELLS_EACH))
            levels = np.column_stack([np.interp(values, knots, at) for at in np.eye(len(knots))])
        course = self._shown([gain * level[:, None] for level in levels.T])
        return float(np.linalg.norm(self.effect - course @ (course.T @ self.effect)))


def _turn(dwells: Dwells, axis: str, error_arcsec: Array) -> None:
    setattr(dwells, f"{axis}_error", getattr(dwells, f"{axis}_error") + error_arcsec)


def _wave(axis: str, order: int, phase: float) -> Any:
    return lambda dwells: _turn(dwells, axis, np.sin(order * np.deg2rad(getattr(dwells, f"{axis}_deg")) + phase))


def _wobble(phase: float) -> Any:
    def change(dwells: Dwells) -> None:
        dwells.level_y = dwells.level_y + np.sin(2 * np.deg2rad(dwells.outer_deg) + phase)

    return change


def _nod(phase: float) -> Any:
    def change(dwells: Dwells) -> None:
        angle = 2 * np.deg2rad(dwells.inner_deg) + phase
        dwells.arm = dwells.arm + np.column_stack([np.cos(angle), np.sin(angle), np.zeros_like(angle)])

    return change


def _span(columns: Array) -> Array:
    """Orthonormal directions of columns that were of length one; none of what vanishes."""
    kept = columns[:, np.linalg.norm(columns, axis=0) > _NOTHING]
    if not kept.shape[1]:
        return np.empty((len(columns), 0))
    left, sizes, _ = np.linalg.svd(kept / np.linalg.norm(kept, axis=0), full_matrices=False)
    return np.asarray(left[:, sizes > _NOTHING])
