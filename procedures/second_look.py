"""The person who reads a positioner that has no motor, as the engine sees them."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Protocol, TypeAlias

from tumble.procedures.events import Event
from tumble.procedures.steps import Point


class SecondLook(Protocol):
    """Reads by eye, and looks again where what was measured contradicts a reading."""

    def attach(self, announce: Callable[[Event], None]) -> None:
        """Have everything that is asked and answered passed to `announce`."""
        ...

    def reconsidered(self, point: Point, points: Sequence[Point], check: Callable[[], object]) -> Point:
        """The point, at the position that is read when it was looked at again; `points` are those before it.

        `check` is called while an answer is awaited. Raises `UnansweredError` where nobody answers.
        """
        ...


@dataclass(frozen=True, kw_only=True)
class Contradiction:
    """What speaks against the position that was read at a point."""

    positioner: str
    """Whose reading is in doubt."""
    prompt: str
    """What the person is told and asked."""


Contradicted: TypeAlias = Callable[[Point, Sequence[Point]], Contradiction | None]
"""What speaks against the reading of a point, by those before it; None where nothing does. A method knows that."""


def nothing_contradicts(_point: Point, _points: Sequence[Point]) -> Contradiction | None:
    """For a method whose readings nothing speaks against."""
    return None


class Reader(Protocol):
    """The person at the positioner."""

    def attach(self, announce: Callable[[Event], None]) -> None:
        """Have everything that is asked and answered passed to `announce`."""
        ...

    def read_again(self, angle_deg: float, prompt: str, check: Callable[[], object]) -> float:
        """What the person reads, in degrees, when told what speaks against `angle_deg`; see `SecondLook`."""
        ...


@dataclass(frozen=True)
class ReadAgain:
    """Has a person read again what a method doubts. Fits `SecondLook`."""

    readers: Mapping[str, Reader]
    """By positioner."""
    contradicted: Contradicted

    def attach(self, announce: Callable[[Event], None]) -> None:
        """Pass on whom to tell."""
        for reader in self.readers.values():
            reader.attach(announce)

    def reconsidered(self, point: Point, points: Sequence[Point], check: Callable[[], object]) -> Point:
        """The point, at the position that is read when it was looked at again. Raises `UnansweredError`."""
        found = self.contradicted(point, points)
        if found is None:
            return point
        reader = self.readers[found.positioner]
        angle_deg = reader.read_again(point.positions_deg[found.positioner], found.prompt, check)
        return replace(point, positions_deg={**point.positions_deg, found.positioner: angle_deg})
