"""What changed between two tables of one head and its reference: before and after a repair, say."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from calibrations.effects.effect import Quantity
from calibrations.reference.loop import ReferenceLoop
from calibrations.tracing.findings import EffectFound

_CHANGED = 5.0
"""A coefficient that moved by so many standard uncertainties, and by a part of itself, has changed."""
_PART = 0.2


@dataclass(frozen=True, kw_only=True)
class Change:
    """An effect that is not the same in both tables."""

    name: str
    order: int | None
    """Periods a turn of a graduation."""
    unit: str
    before: float
    """Size; 0 where it was not found."""
    after: float
    standard_uncertainty: float
    """Of the difference of the sizes."""


def changes(before: ReferenceLoop, after: ReferenceLoop) -> tuple[Change, ...]:
    """Effects whose size differs by more than its uncertainty, the one that changed most first."""
    first, second = _sizes(before.effects), _sizes(after.effects)
    listed = [_change(key, first.get(key), second.get(key)) for key in dict.fromkeys((*first, *second))]
    changed = [change for change in listed if _differs(change)]
    return tuple(sorted(changed, key=lambda change: (change.unit != "deg", -abs(change.after - change.before))))


def _sizes(effects: Sequence[EffectFound]) -> dict[tuple[str, int | None], Quantity]:
    """The coefficient that says how large each effect is."""
    sizes = {}
    for effect in effects:
        order = effect.coefficients.get("order")
        size = effect.coefficients.get("amplitude_deg") or next(iter(effect.coefficients.values()))
        sizes[effect.name, None if order is None else round(order.value)] = size
    return sizes


def _change(key: tuple[str, int | None], first: Quantity | None, second: Quantity | None) -> Change:
    known = [quantity for quantity in (first, second) if quantity is not None]
    uncertainty = float(np.sqrt(sum((quantity.standard_uncertainty or 0.0) ** 2 for quantity in known)))
    return Change(
        name=key[0],
        order=key[1],
        unit=known[0].unit,
        before=first.value if first else 0.0,
        after=second.value if second else 0.0,
        standard_uncertainty=uncertainty,
    )


def _differs(change: Change) -> bool:
    moved = abs(change.after - change.before)
    largest = max(abs(change.before), abs(change.after))
    return moved > max(_CHANGED * change.standard_uncertainty, _PART * largest)


def changes_json(listed: Sequence[Change]) -> list[Mapping[str, object]]:
    """As plain data."""
    return [vars(change) for change in listed]
