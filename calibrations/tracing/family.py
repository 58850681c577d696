"""A channel along a variable, in every shape that it could take."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property, partial
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.changes import Change, Changes
from tumble.calibrations.tracing.components import COURSES, Axis, Component
from tumble.calibrations.tracing.coordinate import IntArray
from tumble.calibrations.tracing.gains import Beside, Gained, best_column, gains, gains_of_pairs
from tumble.calibrations.tracing.overtones import candidates, gained, overtones, periods
from tumble.calibrations.tracing.penalties import WALKS, of_variance
from tumble.calibrations.tracing.spectrum import wave_squares, wave_sums
from tumble.calibrations.tracing.wandering import PULLED_BACK, wandering
from tumble.messages import Message

_EACH_TURN: Final = 8
"""Parts of a turn by which waves with overtones are told apart."""
_FEWEST_PLACES: Final = 10
"""With fewer values, a step between them is any difference between them."""


_Placed = tuple[Gained, tuple[int, ...]]
"""What is gained, and numbers of places."""


@dataclass(frozen=True, kw_only=True)
class Proposal:
    """A component that the table shows."""

    axis: Axis
    shape: str
    described: Message
    """The shape, for a reader."""
    columns: Callable[[], FloatArray]
    """For a channel of one, shape (rows, n)."""
    penalty: float
    """By how much -2 ln L must fall for it to be believed, everything that is tried counted."""
    gain: float
    """Fall of -2 ln L."""
    variance: float
    """Mean variance of a row by it, in units of the variance of a dwell."""
    whole: Callable[[], FloatArray] | None = None
    """The same as `columns` with what the declared model could as well be in it; None where that is all."""

    @property
    def worth(self) -> float:
        """The gain beyond the penalty."""
        return self.gain - self.penalty

    @cached_property
    def component(self) -> Component:
        """The component itself."""
        channel, coordinate = self.axis.channel, self.axis.coordinate
        return Component(
            axis=self.axis,
            shape=self.shape,
            columns=self.columns() * channel.gain[:, None],
            whole=(self.whole or self.columns)() * channel.gain[:, None],
            penalty=self.penalty,
            described=Message(
                "{channel} {follows}, {shape}", channel=channel.phrase, follows=coordinate.phrase, shape=self.described
            ),
        )


class Family:
    """A channel along a variable, in every shape."""

    def __init__(self, axis: Axis, chance: float) -> None:
        self._axis, self._chance = axis, chance
        bins = axis.coordinate.bins
        self._order = np.argsort(bins, kind="stable")
        self._starts = np.flatnonzero(np.diff(bins[self._order], prepend=-1))

    def best(self, seen: Beside, rows: int) -> Proposal | None:
        """The shape that gains most beyond its penalty; None where none gains anything."""
        return max(self._tried(seen, rows), key=lambda proposal: proposal.worth, default=None)

    def best_course(self, seen: Beside, rows: int) -> Proposal:
        """The same among courses that have no shape."""
        return max(self._courses(seen, rows), key=lambda proposal: proposal.worth)

    def _tried(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        yield from self._courses(seen, rows)
        if self._axis.coordinate.waves and len(self._axis.coordinate.turns):
            yield from self._wave(seen, rows)
        if self._axis.coordinate.bends_tried:
            yield from self._bend(seen, rows)
        if self._axis.coordinate.values.ndim > 1:
            yield from self._spot(seen, rows)
        if self._axis.coordinate.bumps:
            yield from self._bump(seen, rows)
        if self._axis.coordinate.steps:
            yield from self._step(seen, rows)
        yield from self._changes(seen)
        if self._axis.coordinate.overtones:
            yield from self._period(seen, rows)

    def _period(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Waves with overtones: of a circle, whole numbers of them on it."""
        coordinate, level = self._axis.coordinate, self._axis.channel.gain * seen.root
        limit, places = coordinate.nyquist_turns, len(np.unique(np.round(coordinate.part_of_cycle, 6)))
        if coordinate.period is not None:
            tried = [float(turns) for turns in range(1, int(limit / 2.0) + 1)]
        elif len(coordinate.turns):
            tried = list(candidates(self._coarse_waves(seen, rows)[0], coordinate.turns, limit))
        else:
            tried = []
        told = [
            (gained(overtones(coordinate.part_of_cycle, turns), level, seen), turns)
            for turns in periods(tried, limit, places)
        ]
        if not told:
            return
        best, turns = max(told, key=lambda each: each[0])
        shown = coordinate.shown(float(coordinate.cycle / turns[0]))
        yield self._proposed(
            f"period {turns[0]:.4g} {len(turns)}",
            Message("in waves of {period} with overtones", period=shown),
            partial(overtones, coordinate.part_of_cycle, turns),
            best,
            int(limit) * (_EACH_TURN if coordinate.period is None else 1),
        )

    def _changes(self, seen: Beside) -> Iterator[Proposal]:
        """Ramps, onsets, and levels that change several times."""
        coordinate = self._axis.coordinate
        if not coordinate.kinks or len(coordinate.places) < _FEWEST_PLACES:
            return
        changes = Changes(coordinate, self._axis.channel.gain, seen)
        for ramp in changes.ramps():
            ends = [coordinate.shown(float(value)) for value in coordinate.low + coordinate.range * ramp.places]
            yield self._changed("ramp", _ramped(*ends), ramp)
        if coordinate.onsets:
            yield from self._wandering(seen)
            onset = changes.onset()
            start, time = (
                coordinate.shown(float(each))
                for each in (coordinate.low + coordinate.range * onset.places[0], coordinate.range * onset.places[1])
            )
            yield self._changed(
                "onset", Message("from {start} on, settling within {time}", start=start, time=time), onset
            )
            levels = changes.levels()
            yield self._changed("changes", Message("in {count} steps", count=len(levels.places)), levels)

    def _changed(self, word: str, said: Message, change: Change) -> Proposal:
        shape = " ".join([word, *(f"{place:.4g}" for place in change.places)])
        return self._proposed(shape, said, change.columns, change.gained, change.tried)

    def _courses(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Gaussian processes of every length."""
        coordinate, level = self._axis.coordinate, self._axis.channel.gain * seen.root
        weighted = np.column_stack([seen.taken, seen.left]) * level[:, None]
        sums = np.add.reduceat(weighted[self._order], self._starts, axis=0)
        power = np.bincount(coordinate.bins, level**2)
        gram, with_output = np.diag(power) - sums[:, :-1] @ sums[:, :-1].T, sums[:, -1]
        for shape, root in coordinate.courses:
            values, vectors = np.linalg.eigh(root.T @ gram @ root)
            scale = float(power @ np.sum(root**2, axis=1)) / rows
            power_along = (vectors.T @ (root.T @ with_output)) ** 2
            (gain,), (variance,) = gains(values[None] / scale, power_along[None] / scale, seen.squares, rows)
            yield self._proposed(
                shape,
                COURSES[shape.split()[0]],
                partial(_of_rows, root, coordinate.bins),
                (gain, variance),
                len(coordinate.courses),
            )

    def _wandering(self, seen: Beside) -> Iterator[Proposal]:
        """Processes that are pulled back to their mean, with more places than a course has.

        Where one is expected, it has the chance of a random walk.
        """
        coordinate, level = self._axis.coordinate, self._axis.channel.gain * seen.root
        for length in PULLED_BACK:
            columns = partial(wandering, coordinate.part, length)
            found = gained(columns(), level, seen)
            proposed = self._proposed(f"wandering {length:g}", COURSES["wandering"], columns, found, len(PULLED_BACK))
            expected = of_variance(WALKS / len(PULLED_BACK))
            yield replace(proposed, penalty=expected) if self._axis.expected else proposed

    def _wave(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Waves of any phase, up to the Nyquist limit."""
        coordinate = self._axis.coordinate
        falls, _ = self._coarse_waves(seen, rows)
        finer = coordinate.turns[np.argmax(falls)] + np.linspace(-0.5, 0.5, 11) * coordinate.turns[0]
        swing = coordinate.swung(finer)
        falls, variances = self._pairs(seen, rows, swing)
        best = int(np.argmax(falls))
        yield self._proposed(
            f"wave {finer[best]:.4g}",
            Message("in waves of {period}", period=coordinate.shown(float(coordinate.range / finer[best]))),
            partial(_columns, swing, best),
            (falls[best], variances[best]),
            len(coordinate.turns),
        )

    def _bump(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Bumps, with their slope, so that they may stand between two of their places."""
        coordinate = self._axis.coordinate
        tried = coordinate.bumps_tried
        if not len(tried):
            return
        falls, _ = self._pairs(seen, rows, coordinate.bells_tried)
        finer = coordinate.bumps_near(*tried[np.argmax(falls)].tolist())
        bells = coordinate.bells(finer)
        falls, variances = self._pairs(seen, rows, bells)
        best = int(np.argmax(falls))
        centre, width = finer[best].tolist()
        yield self._proposed(
            f"bump {centre:.4g} {width:.4g}",
            Message("near {place}, within some {width}", place=coordinate.shown(centre), width=coordinate.shown(width)),
            partial(_columns, bells, best),
            (falls[best], variances[best]),
            len(tried),
        )

    def _spot(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Spots in space."""
        coordinate = self._axis.coordinate
        tried = coordinate.spots_tried
        if not len(tried):
            return
        columns = coordinate.spots(tried) * (self._axis.channel.gain * seen.root)[:, None]
        whole = np.sum(columns**2, axis=0)
        left = whole - np.sum((seen.taken.T @ columns) ** 2, axis=0)
        best, gained = best_column(left, whole, (seen.left @ columns) ** 2, seen.squares, rows)
        place = ", ".join(coordinate.shown(value) for value in tried[best, :-1].tolist())
        width = coordinate.shown(float(tried[best, -1]))
        yield self._proposed(
            " ".join(["spot", *(f"{number:.4g}" for number in tried[best])]),
            Message("near {place}, within some {width}", place=place, width=width),
            partial(coordinate.spots, tried[[best]]),
            gained,
            len(tried),
        )

    def _bend(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """Polynomials of low order."""
        bends = self._axis.coordinate.bends
        columns = bends * (self._axis.channel.gain * seen.root)[:, None]
        whole = np.sum(columns**2, axis=0)
        left = whole - np.sum((seen.taken.T @ columns) ** 2, axis=0)
        best, gained = best_column(left, whole, (seen.left @ columns) ** 2, seen.squares, rows)
        said = Message("in a bend")
        bend = self._proposed(f"bend {best}", said, partial(_columns, [bends], best), gained, bends.shape[1])
        yield replace(bend, whole=lambda: self._axis.coordinate.polynomials)

    def _coarse_waves(self, seen: Beside, rows: int) -> tuple[FloatArray, FloatArray]:
        """Gains and variances of all waves."""
        coordinate, level = self._axis.coordinate, self._axis.channel.gain * seen.root
        weighted, waves = np.column_stack([seen.taken, seen.left]) * level[:, None], len(coordinate.turns)
        sums = wave_sums(coordinate.part, waves, weighted)
        return gains_of_pairs(seen.squares, rows, sums, wave_squares(coordinate.part, waves, level**2))

    def _pairs(self, seen: Beside, rows: int, pair: tuple[FloatArray, FloatArray]) -> tuple[FloatArray, FloatArray]:
        """Gains and variances of shapes of two columns each, given as all the first and all the second ones."""
        level = self._axis.channel.gain * seen.root
        weighted, square = (np.column_stack([seen.taken, seen.left]) * level[:, None]).T, level**2
        first, second = pair
        products = (square @ first**2, square @ second**2, square @ (first * second))
        return gains_of_pairs(seen.squares, rows, (weighted @ first, weighted @ second), products)

    def _step(self, seen: Beside, rows: int) -> Iterator[Proposal]:
        """A step at any place, or a pulse between any two."""
        coordinate = self._axis.coordinate
        places = coordinate.places
        if len(places) < _FEWEST_PLACES:
            return
        square = (self._axis.channel.gain * seen.root) ** 2
        coarse = self._steps(seen, rows, places)
        for number, (name, kind) in enumerate((("step", 1), ("pulse", 2))):
            _, ends = coarse[number]
            finer = np.unique(np.concatenate([coordinate.nearby(float(places[end])) for end in ends]))
            gained, ends = self._steps(seen, rows, finer)[number]
            between = coordinate.between(finer[list(ends)])
            at, column = coordinate.on_the_shorter_arc(finer[list(ends)], between)
            yield self._proposed(
                " ".join([name, *(f"{place:.4g}" for place in at)]),
                _stepped(*(coordinate.shown(float(value)) for value in coordinate.low + coordinate.range * at)),
                partial(_columns, [column[:, None]], 0),
                (gained[0], gained[1] * float(square @ column) / float(square @ between)),
                len(places) ** kind // kind,
            )

    def _steps(self, seen: Beside, rows: int, places: FloatArray) -> tuple[_Placed, _Placed]:
        """The best step, and the best pulse: gain and variance, and the numbers of the places."""
        level = self._axis.channel.gain * seen.root
        stepped = self._axis.coordinate.stepped(places)
        columns = stepped * level[:, None]
        taken, along = seen.taken.T @ columns, seen.left @ columns
        whole, first, last = columns.T @ columns, *np.triu_indices(len(places), 1)
        gram = whole - taken.T @ taken
        steps = best_column(np.diag(gram), np.diag(whole), along**2, seen.squares, rows)
        long = np.diff(np.sum(stepped, axis=0)[np.array([last, first])], axis=0)[0] >= self._axis.coordinate.fewest_rows
        between = (_between(gram, first, last) * long, _between(whole, first, last))
        pulses = best_column(*between, (along[first] - along[last]) ** 2, seen.squares, rows)
        return (steps[1], (steps[0],)), (pulses[1], (int(first[pulses[0]]), int(last[pulses[0]])))

    def _proposed(
        self,
        shape: str,
        described: Message,
        columns: Callable[[], FloatArray],
        gained: Gained,
        tried: float,
    ) -> Proposal:
        """A shape with its gain and variance, one of so many of its kind; kinds share the chance of the axis."""
        coordinate = self._axis.coordinate
        several = coordinate.waves + 2 * coordinate.steps + 2 * coordinate.kinks + 3 * coordinate.onsets
        kinds = (
            1
            + coordinate.bends_tried
            + coordinate.bumps
            + (coordinate.values.ndim > 1)
            + coordinate.overtones
            + several
        )
        return Proposal(
            axis=self._axis,
            shape=shape,
            described=described,
            columns=columns,
            penalty=of_variance(self._chance / kinds / tried),
            gain=float(gained[0]),
            variance=float(gained[1]),
        )


def _stepped(start: str, stop: str = "") -> Message:
    """A step, or a pulse, where it is."""
    if stop:
        return Message("from {start} to {stop}", start=start, stop=stop)
    return Message("in a step at {start}", start=start)


def _ramped(start: str, stop: str = "") -> Message:
    """A slope from a place on, or between two."""
    if stop:
        return Message("in a slope from {start} to {stop}", start=start, stop=stop)
    return Message("in a slope from {start} on", start=start)


def _of_rows(bins: FloatArray, number: IntArray) -> FloatArray:
    """What rows have of the values of bins."""
    return np.asarray(bins[number])


def _columns(sides: Sequence[FloatArray], number: int) -> FloatArray:
    """The column of that number of each side."""
    return np.column_stack([side[:, number] for side in sides])


def _between(gram: FloatArray, first: IntArray, last: IntArray) -> FloatArray:
    """Squares of the differences of columns, from their Gram matrix."""
    length = np.diag(gram)
    return np.asarray(length[first] + length[last] - 2.0 * gram[first, last])
