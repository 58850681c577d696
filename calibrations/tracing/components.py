"""Structure without a name as variance components: a channel of the model that follows a variable along no given shape.

A component is c(row) · f(v(row)): c is what a unit of the channel adds to the output, v the variable, and f a zero-mean
Gaussian process over the distinct values of v (Rasmussen and Williams, Gaussian Processes for Machine Learning, 4.2), a
wave of any phase, or a step. All are the same thing to a fit: columns whose coefficients are independent draws of one
variance. The method declares its channels and variables; which of them a table shows is found in `scan`.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.calibrations.tracing.effect import Variable
from tumble.messages import Message

COURSES: Final = {
    "smooth": Message("in a smooth course"),
    "broken": Message("in a broken course"),
    "levels": Message("a level for each"),
    "wandering": Message("in a wandering that is pulled back to its mean"),
}
"""What the first word of the shape of a process stands for."""
MARK: Final = "?"
"""With it begins the name of what is noise to a fit and no effect: levels of settings, components."""


@dataclass(frozen=True, kw_only=True)
class Channel:
    """What of the model changes."""

    word: str
    """What a method calls it: offset, scale, angle."""
    gain: FloatArray
    """What one unit of it adds to the output, shape (rows,)."""
    phrase: Message
    """What changes, for a reader: `an offset of the output`."""
    unit: str = ""
    """Of what changes: that of the output over that of the gain."""
    detail: str = ""
    """Which of several channels of the same word it is: `x` of the offsets of three outputs."""

    @property
    def called(self) -> str:
        """No other channel of a table is called so."""
        return f"{self.word} {self.detail}".rstrip()


@dataclass(frozen=True, kw_only=True)
class Axis:
    """A channel and a variable that it may follow."""

    channel: Channel
    coordinate: Coordinate
    expected: bool = False
    """Whether something of the kind is there more often than not."""

    @property
    def name(self) -> str:
        """No other axis of a table has it."""
        return f"{self.channel.called} {self.coordinate.phrase}"

    @property
    def place(self) -> tuple[str, str]:
        """Channel and variable, as the contract calls them."""
        return self.channel.word, self.coordinate.word

    @property
    def key(self) -> tuple[str, str, str]:
        """The same with which of several variables of one word it is: the same in every table of a method."""
        return self.channel.called, self.coordinate.word, self.coordinate.detail


@dataclass(frozen=True, kw_only=True, eq=False)
class Component:
    """Structure without a name: its columns have independent coefficients of one variance."""

    axis: Axis
    shape: str
    columns: FloatArray
    """Shape (rows, n)."""
    whole: FloatArray
    """The same with what the declared model could as well be in it: a bend has a slope and a mean that no row shows."""
    penalty: float
    """By how much -2 ln L must fall for it to be believed, everything that is tried counted."""
    described: Message
    """What it is, for a reader."""

    @property
    def name(self) -> str:
        """No other component of a table has it."""
        return f"{MARK}{self.axis.name} {self.shape}"

    @property
    def place(self) -> tuple[str, str]:
        """Channel and variable, as the contract calls them."""
        return self.axis.place

    @property
    def is_course(self) -> bool:
        """Whether it is a process, which has no shape."""
        return self.shape.split()[0] in COURSES

    @property
    def depends_on(self) -> Variable:
        """What it depends on."""
        return self.axis.coordinate.depends_on


def carried(component: Component, part: FloatArray, axis: Axis) -> FloatArray:
    """What a component adds to other rows of the same table, shape (rows,), along its axis there.

    `part` is what it adds to its own rows. Each other row has what the nearest of those has in the variable.
    """
    from scipy.spatial import KDTree  # takes a tenth of a second, in which a window is half up

    own, gain = component.axis.coordinate, component.axis.channel.gain
    course = part / np.where(gain == 0.0, 1.0, gain)
    tree = KDTree(own.values.reshape(len(own.values), -1)[gain != 0.0])
    _, nearest = tree.query(axis.coordinate.values.reshape(len(axis.coordinate.values), -1))
    return np.asarray(course[gain != 0.0][nearest] * axis.channel.gain)


def axes(
    *pairs: tuple[Channel, tuple[Coordinate, ...]], expected: tuple[tuple[str, str], ...] = ()
) -> tuple[Axis, ...]:
    """Every channel with every variable of its list that varies in the table; some are expected."""
    return tuple(
        Axis(channel=channel, coordinate=coordinate, expected=(channel.word, coordinate.word) in expected)
        for channel, coordinates in pairs
        for coordinate in coordinates
        if coordinate.varies and channel.gain.any()
    )
