"""The person who reads a positioner that has no motor, as the engine sees them."""

from collections.abc import Callable, Sequence
from typing import Protocol

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
