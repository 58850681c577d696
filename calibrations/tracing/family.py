"""A channel along a variable, in every shape that it could take."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.components import Axis, Component
from tumble.calibrations.tracing.gains import Beside
from tumble.calibrations.tracing.penalties import of_variance
from tumble.calibrations.tracing.shapes.along import Along, Shape
from tumble.calibrations.tracing.shapes.bells import bumps, bumps_about, spots
from tumble.calibrations.tracing.shapes.changes import changes
from tumble.calibrations.tracing.shapes.courses import bends, courses, pulled_back
from tumble.calibrations.tracing.shapes.jumping import jumping_waves
from tumble.calibrations.tracing.shapes.onsets import onsets, transients
from tumble.calibrations.tracing.shapes.ramps import ramps
from tumble.calibrations.tracing.shapes.steps import steps
from tumble.calibrations.tracing.shapes.waves import waves, waves_with_overtones
from tumble.messages import Message

_Tried = Callable[[Along], Iterator[Shape]]
"""The best shapes of a kind."""


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

    def glance(self, seen: Beside) -> "Glance":
        """The family beside something, with courses and waves tried, which take little time."""
        along = Along(axis=self._axis, seen=seen)
        tried = [shapes for shapes in self._tried() if shapes in (courses, waves)]
        return Glance(
            family=self, along=along, tried=[self._proposed(shape) for each in tried for shape in each(along)]
        )

    def further(self, along: Along) -> Iterator[Proposal]:
        """What a glance leaves out."""
        rest = (shapes for shapes in self._tried() if shapes not in (courses, waves))
        return (self._proposed(shape) for shapes in rest for shape in shapes(along))

    def best_course(self, seen: Beside) -> Proposal:
        """The same among courses that have no shape."""
        along = Along(axis=self._axis, seen=seen)
        return max((self._proposed(shape) for shape in courses(along)), key=lambda proposal: proposal.worth)

    def every(self, seen: Beside) -> Iterator[Proposal]:
        """The best of each kind; of bumps, those about the best one of each width too."""
        along = Along(axis=self._axis, seen=seen)
        tried = self._tried()
        for shapes in (*tried, *((bumps_about,) if bumps in tried else ())):
            yield from map(self._proposed, shapes(along))

    def _tried(self) -> list[_Tried]:
        """What makes sense along the variable."""
        coordinate = self._axis.coordinate
        wanted: list[tuple[bool, tuple[_Tried, ...]]] = [
            (True, (courses,)),
            (coordinate.waves, (waves,)),
            (coordinate.bends_tried, (bends,)),
            (coordinate.values.ndim > 1, (spots,)),
            (coordinate.bumps, (bumps,)),
            (coordinate.steps, (steps,)),
            (coordinate.kinks, (ramps,)),
            (coordinate.onsets, (pulled_back, onsets, transients, changes)),
            (coordinate.overtones, (waves_with_overtones, jumping_waves)),
        ]
        return [shapes for there, several in wanted if there for shapes in several]

    @property
    def _kinds(self) -> int:
        """So many share the chance of the axis: a step and a pulse are two, so are slopes with one end and two."""
        return len(self._tried()) + self._axis.coordinate.steps + self._axis.coordinate.kinks

    def _proposed(self, shape: Shape) -> Proposal:
        """A shape, one of so many of its kind."""
        chance = self._chance / self._kinds if shape.chance is None else shape.chance
        return Proposal(
            axis=self._axis,
            shape=shape.name,
            described=shape.described,
            columns=shape.columns,
            whole=shape.whole,
            penalty=of_variance(chance / shape.tried),
            gain=float(shape.gained[0]),
            variance=float(shape.gained[1]),
        )


@dataclass(frozen=True, kw_only=True)
class Glance:
    """A family beside something, of which the quick shapes were tried."""

    family: Family
    along: Along
    tried: Sequence[Proposal]

    @property
    def gain(self) -> float:
        """About how much structure along the axis would gain."""
        return max(proposal.gain for proposal in self.tried)

    def best(self) -> Proposal | None:
        """Of all shapes that which gains most beyond its penalty; None where none gains anything."""
        proposals = (*self.tried, *self.family.further(self.along))
        best = max(proposals, key=lambda proposal: proposal.worth, default=None)
        return best if best is not None and best.gain > 0.0 else None
