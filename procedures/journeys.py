"""Moves that are under way at the same time."""

from collections.abc import Callable, Generator, Sequence
from typing import Final, TypeAlias

from tumble.drivers.clock import Clock
from tumble.drivers.protocols import PositionerStatus

POLL_S: Final = 0.05
"""Time between two looks at the positioners or at the operator."""

Journey: TypeAlias = Generator[None, bool | None, PositionerStatus]
"""A move under way: each time it yields the clock may go on; it is sent whether the positioner was braked meanwhile,
and then sets out again. It returns what the positioner reports at its end."""


def together(journeys: Sequence[Journey], clock: Clock, checkpoint: Callable[[], bool]) -> list[PositionerStatus]:
    """Make journeys at the same time; returns how each positioner stands at its end, in their order.

    `checkpoint` is called between two looks; it may raise, and returns true where it braked all of them.
    """
    under_way = dict(enumerate(journeys))
    arrived: dict[int, PositionerStatus] = {}
    braked: bool | None = None  # a generator that begins is sent nothing
    while True:
        for number, journey in list(under_way.items()):
            try:
                journey.send(braked)
            except StopIteration as ended:
                arrived[number] = ended.value
                del under_way[number]
        if not under_way:
            return [arrived[number] for number in range(len(journeys))]
        clock.sleep(POLL_S)
        braked = checkpoint()
