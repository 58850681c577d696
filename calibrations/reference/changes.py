"""What changed between two tables of one head and its reference: before and after a repair, say."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass

import numpy as np

from calibrations.effects.effect import Quantity
from calibrations.reference.loop import ReferenceLoop

_CHANGED = 5.0
"""What differs by so many standard uncertainties has changed."""


@dataclass(frozen=True, kw_only=True)
class Change:
    """Something that is not the same in both tables: an effect, or the offset."""

    name: str
    order: int | None
    """Periods a turn of a graduation."""
    unit: str
    before: float
    """Size; 0 where it was not found."""
    after: float
    difference: float
    """Size of the difference: of waves, of that between them, their phases known."""
    standard_uncertainty: float
    """Of the difference; of what was not found nothing is known, and it is that of the other table."""


@dataclass(frozen=True, kw_only=True)
class _Size:
    """A coefficient as a complex number: of a wave, amplitude and phase."""

    value: complex
    standard_uncertainty: float
    unit: str


def changes(before: ReferenceLoop, after: ReferenceLoop) -> tuple[Change, ...]:
    """Effects and offset that differ by more than `_CHANGED` standard uncertainties; angles first, by size."""
    first, second = _sizes(before), _sizes(after)
    listed = [_change(key, first.get(key), second.get(key)) for key in dict.fromkeys((*first, *second))]
    changed = [change for change in listed if change.difference > _CHANGED * change.standard_uncertainty]
    return tuple(sorted(changed, key=lambda change: (change.unit != "deg", -change.difference)))


def _sizes(loop: ReferenceLoop) -> dict[tuple[str, int | None], _Size]:
    sizes: dict[tuple[str, int | None], _Size] = {}
    for effect in loop.effects:
        order = effect.coefficients.get("order")
        sizes[effect.name, None if order is None else round(order.value)] = _size(effect.coefficients)
    offset = loop.augmented.parameters["offset"]
    if offset.value is not None:
        sizes["offset", None] = _Size(
            value=offset.value, standard_uncertainty=offset.standard_uncertainty or 0.0, unit=offset.unit
        )
    return sizes


def _size(coefficients: Mapping[str, Quantity]) -> _Size:
    """Of a wave the amplitude with its phase, of anything else its only coefficient."""
    amplitude, phase = coefficients.get("amplitude_deg"), coefficients.get("phase_deg")
    if amplitude is None or phase is None:
        (only,) = coefficients.values()
        return _Size(value=only.value, standard_uncertainty=only.standard_uncertainty or 0.0, unit=only.unit)
    across = amplitude.value * np.deg2rad(phase.standard_uncertainty or 0.0)
    return _Size(
        value=complex(amplitude.value * np.exp(1j * np.deg2rad(phase.value))),
        standard_uncertainty=float(np.hypot(amplitude.standard_uncertainty or 0.0, across)),
        unit=amplitude.unit,
    )


def _change(key: tuple[str, int | None], first: _Size | None, second: _Size | None) -> Change:
    known = [size for size in (first, second) if size is not None]
    before, after = (size.value if size else 0.0 for size in (first, second))
    wave = isinstance(before, complex) or isinstance(after, complex)
    return Change(
        name=key[0],
        order=key[1],
        unit=known[0].unit,
        before=abs(before) if wave else float(np.real(before)),
        after=abs(after) if wave else float(np.real(after)),
        difference=abs(after - before),
        standard_uncertainty=float(np.sqrt(sum(size.standard_uncertainty**2 for size in known))),
    )


def changes_json(listed: Sequence[Change]) -> list[dict[str, object]]:
    """As plain data."""
    return [asdict(change) for change in listed]
