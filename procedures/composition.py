"""How the parts of a programme become one procedure."""

from collections.abc import Callable, Generator, Iterable
from typing import Protocol, TypeAlias, TypeVar

from tumble.procedures.errors import ProcedureError
from tumble.procedures.steps import Ask, Dwell, Point, Procedure, Reply, Step

Dwells: TypeAlias = Generator[Dwell, Point, None]
"""Yields dwells, is sent the point of each, and leaves it to others to ask the operator."""

Yielded = TypeVar("Yielded")
Sent = TypeVar("Sent")


class Part(Protocol):
    """One procedure of a programme."""

    def dwells(self, realisation: int) -> Dwells:
        """Carry it out once; `realisation` counts from 1."""
        ...


def compose(parts: Iterable[Part], realisations: int, ask: Callable[[str, str], Ask]) -> Procedure:
    """Carry out all `parts` in order, `realisations` times.

    What a dwell needs and the one before it did not is asked for, by the step that `ask` makes of condition and value.
    """
    repeated = tuple(parts)
    standing: dict[str, str] = {}
    for realisation in range(1, realisations + 1):
        for part in repeated:
            yield from _with_requests(part.dwells(realisation), standing, ask)


def _with_requests(
    dwells: Dwells, standing: dict[str, str], ask: Callable[[str, str], Ask]
) -> Generator[Step, Reply, None]:
    """Pass on `dwells`, each after the requests that it may need; `standing` is kept up to date."""
    dwell = next(dwells, None)
    while dwell is not None:
        for condition, value in dwell.conditions.items():
            if standing.get(condition) != value:
                yield ask(condition, value)
                standing[condition] = value
        dwell = advance(dwells, _require_point((yield dwell)))


def advance(steps: Generator[Yielded, Sent, None], reply: Sent) -> Yielded | None:
    """Send `reply` and return the next step; None after the last."""
    try:
        return steps.send(reply)
    except StopIteration:
        return None


def _require_point(reply: Reply) -> Point:
    """Return a reply that can only be a point. Raises `ProcedureError` where it is not."""
    if not isinstance(reply, Point):
        raise ProcedureError(f"a dwell was answered with {reply!r} in place of a point")
    return reply
