"""The catalogue of the contract (effects.md, version 1): how each effect is drawn, and what a stated one does."""

from collections.abc import Mapping
from typing import Any, Final

from benchmarks.blind.named import daq, stand, unit
from benchmarks.blind.sizing import Draw
from benchmarks.blind.world import Effect

_PARTS: Final = (
    (unit.DRAWS, unit.stated),
    (stand.DRAWS, stand.stated),
    (daq.DRAWS, daq.stated),
)

CATALOGUE: Final[Mapping[str, Draw]] = {**unit.DRAWS, **stand.DRAWS, **daq.DRAWS}

OF_NO_SIZE: Final = frozenset({"misreading"})
"""Effects that are as large as they are: a round angle."""

FORMS: Final = unit.FORMS


def stated(name: str, values: Mapping[str, Any]) -> Effect | None:
    """Return the effect that a result states, from its coefficients; None where they do not fix its course."""
    return next(say for draws, say in _PARTS if name in draws)(name, values)


__all__ = ["CATALOGUE", "FORMS", "OF_NO_SIZE", "stated"]
