"""How a unit sits on a shaker or a centrifuge: where the axes of the table, and down, lie in the unit.

A unit has the axes i (input), o (output) and p (pendulous); a table drives along its x, moves sideways along its y, and
z is x × y. The text of a mounting, which is a condition of dwells: `x along i, y along o, p down`.
"""

import math
import re
from dataclasses import dataclass
from typing import Final, TypeAlias

import numpy as np
from numpy.typing import NDArray

from tumble.messages import Message

Vector: TypeAlias = tuple[float, float, float]
AXES: Final = "iop"
_TERM: Final = re.compile(r"([+-]?)(\d*\.?\d*)([iop])")
_MOUNTING: Final = re.compile(r"x along (\S+), y along (\S+), (\S+) down")
_SQUARE: Final = 1e-6


def direction_of(text: str) -> Vector:
    """A unit vector in the unit: `i`, `-o`, `i+o` (45° between both), `0.8i-0.6p`. Raises `ValueError`."""
    terms = _TERM.findall(text)
    if not terms or "".join("".join(term) for term in terms) != text:
        raise ValueError(Message("{text!r} is no direction in the unit, such as i, -o or i+p", text=text))
    vector = [0.0, 0.0, 0.0]
    for sign, size, axis in terms:
        vector[AXES.index(axis)] += float(f"{sign}{size or 1}")
    length = math.hypot(*vector)
    if length == 0.0:
        raise ValueError(Message("{text!r} is no direction in the unit, such as i, -o or i+p", text=text))
    return (vector[0] / length, vector[1] / length, vector[2] / length)


@dataclass(frozen=True, kw_only=True)
class Mounting:
    """Directions in the unit, as text. Raises `ValueError` where x and y are not square to each other."""

    x: str
    y: str
    down: str

    def __post_init__(self) -> None:
        direction_of(self.down)
        if abs(float(np.dot(direction_of(self.x), direction_of(self.y)))) > _SQUARE:
            raise ValueError(Message("x along {x} and y along {y} are not square to each other", x=self.x, y=self.y))

    @classmethod
    def of(cls, text: str) -> "Mounting":
        """From the text of the condition. Raises `ValueError`."""
        found = _MOUNTING.fullmatch(text)
        if found is None:
            raise ValueError(
                Message("{text!r} is no mounting, such as x along i, y along o, p down", text=text),
            )
        x, y, down = found.groups()
        return cls(x=x, y=y, down=down)

    @property
    def text(self) -> str:
        """The condition, which a reader is shown in words."""
        written = f"x along {self.x}, y along {self.y}, {self.down} down"
        Message.named(written, "x along {x}, y along {y}, {down} down", x=self.x, y=self.y, down=self.down)
        return written

    @property
    def table(self) -> NDArray[np.float64]:
        """Axes x, y, z of the table (rows) in the unit."""
        x, y = np.array(direction_of(self.x)), np.array(direction_of(self.y))
        return np.stack([x, y, np.cross(x, y)])

    @property
    def gravity_g(self) -> NDArray[np.float64]:
        """Gravity along the axes of the unit, +1 where one points down."""
        return np.array(direction_of(self.down))
