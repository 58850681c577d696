"""What is known of a table at a stage: what was found, and every explanation that is near."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from typing import Any, Generic, Protocol, TypeVar

from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.tracing.explained import Explained
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.places import places
from tumble.calibrations.tracing.rivals import rivals


class ClosedLoop(Protocol):
    """What a chain needs to know of a loop that was closed on a table."""

    @property
    def effects(self) -> tuple[EffectFound, ...]:
        """What was found."""
        ...

    @property
    def held_out_rms(self) -> float | None:
        """Error of rows that are held out, in the unit of the output; None where none can be."""
        ...

    @property
    def unit(self) -> str:
        """Of the output."""
        ...


L = TypeVar("L", bound=ClosedLoop)
"""The loop of a method."""


@dataclass(frozen=True, kw_only=True)
class Stage(Generic[L]):
    """The loop closed on everything that was measured so far."""

    loop: L
    behind: Mapping[str, float]
    """How far each explanation lies behind the best in -2 ln L, 0 for what was found."""
    places: tuple[str, ...] = ()
    """Where structure without a name may live, the nearest first; empty where there is none."""

    @property
    def explanations(self) -> tuple[tuple[str, ...], ...]:
        """For everything that was found, its name and those of its rivals."""
        named = tuple((effect.name, *effect.also_possible) for effect in self.loop.effects)
        return (*named, self.places) if self.places else named

    @property
    def disputed(self) -> tuple[tuple[str, ...], ...]:
        """The same for what has rivals."""
        return tuple(names for names in self.explanations if len(names) > 1)


@one_blas_thread
def stage_of(loop: L, explained: Explained[Any, Any] | None, asked: Collection[str] = ()) -> Stage[L]:
    """What a table says, with every explanation that is near, and those that are `asked` for."""
    behind: dict[str, float] = {}
    if explained is not None:
        for name in explained.trace.names:
            for rival in rivals(explained.tracer, explained.trace, name, asked):
                further = rival.trace.deviance - explained.trace.deviance
                behind[rival.name] = min(further, behind.get(rival.name, further))
        behind |= dict.fromkeys(explained.trace.names, 0.0)
        return Stage(loop=loop, behind=behind, places=places(explained.trace, explained.alike))
    return Stage(loop=loop, behind=behind)
