"""How the parts of a programme become one procedure."""

from collections.abc import Generator, Iterable
from typing import Protocol, TypeAlias, TypeVar

from tumble.procedures.errors import ProcedureError
from tumble.procedures.steps import Dwell, Mounting, Point, Procedure, Reply, Step

Dwells: TypeAlias = Generator[Dwell, Point, None]
"""Yields dwells, is sent the point of each, and leaves it to others to have the unit seated."""

Yielded = TypeVar("Yielded")
Sent = TypeVar("Sent")


class Part(Protocol):
    """One procedure of a programme."""

    def dwells(self, realisation: int) -> Dwells:
        """Carry it out once; `realisation` counts from 1."""
        ...


def compose(parts: Iterable[Part], realisations: int) -> Procedure:
    """Carry out all `parts` in order, `realisations` times.

    A mounting is asked for where a dwell needs another mount than the one before it, and before the first dwell.
    """
    repeated = tuple(parts)
    seated: str | None = None
    for realisation in range(1, realisations + 1):
        for part in repeated:
            seated = yield from _with_mountings(part.dwells(realisation), seated)


def _with_mountings(dwells: Dwells, seated: str | None) -> Generator[Step, Reply, str | None]:
    """Pass on `dwells`, each after the mounting that it may need; return the mount of the last."""
    dwell = next(dwells, None)
    while dwell is not None:
        if dwell.mount != seated:
            yield Mounting(mount=dwell.mount)
            seated = dwell.mount
        dwell = advance(dwells, _require_point((yield dwell)))
    return seated


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
