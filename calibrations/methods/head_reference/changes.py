"""What changed between two tables of one head and its reference: before and after a repair, say."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np

from tumble.calibrations.methods.head_reference.explanation import explain_steady
from tumble.calibrations.methods.head_reference.limits import SHORT_DEG, confounded
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.methods.head_reference.map_difference import Difference, Part, map_difference, parts
from tumble.calibrations.methods.head_reference.observations import HeadObservations
from tumble.calibrations.methods.head_reference.rows import as_they_are
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.methods.head_reference.table import HeadTable, head_table, without_time
from tumble.calibrations.tracing.effect import Quantity
from tumble.calibrations.tracing.findings import EffectFound, Unexplained


@dataclass(frozen=True, kw_only=True)
class Change:
    """An effect that the difference of two maps shows."""

    name: str
    order: int | None
    """Periods a turn of a graduation."""
    unit: str
    before: float
    """Size in the first table alone; 0 where it was not found there."""
    after: float
    difference: float
    """Size in the difference of the maps: of waves, of that between them, their phases known."""
    standard_uncertainty: float
    also_possible: tuple[str, ...] = ()
    """What else the difference could be."""


@dataclass(frozen=True, kw_only=True)
class Comparison:
    """Two tables of one head as maps."""

    difference: Difference | None
    """None where they share too little, or one of them states nothing."""
    parts: tuple[Part, ...]
    changes: tuple[Change, ...]
    """Effects that the difference shows, by size."""
    unexplained: tuple[Unexplained, ...]
    limits: tuple[str, ...]
    """What they cannot tell, in sentences."""
    slopes: tuple[tuple[float, float], tuple[float, float]] | None
    """Slope of the error with the angle of each alone, with its standard uncertainty, in degrees per degree."""

    whole_turn: bool = False
    """Whether the common arc is most of a turn."""

    @property
    def changed(self) -> bool:
        """Whether the head changed, the set-up apart."""
        return bool(self.difference and (self.difference.varies or self.changes))


def compare(before: ReferenceLoop, after: ReferenceLoop) -> Comparison:
    """The second table minus the first, as maps, and to what the difference is traced."""
    difference = map_difference(before, after)
    if difference is None:
        return Comparison(difference=None, parts=(), changes=(), unexplained=(), limits=(), slopes=None)
    streamed = before.explained.table.streamed or after.explained.table.streamed
    table = replace(_table(difference), streamed=streamed)
    explained = explain_steady(table)
    found = explained.effects(explained.best)
    first, second = _sizes(before), _sizes(after)
    listed = [_change(effect, first, second) for effect in found]
    return Comparison(
        difference=difference,
        parts=parts(difference),
        changes=tuple(sorted(listed, key=lambda change: (change.unit != "deg", -change.difference))),
        unexplained=explained.unexplained,
        limits=confounded(table.scene),
        slopes=(_slope(before), _slope(after)),
        whole_turn=table.scene.arc_deg >= SHORT_DEG,
    )


def _table(difference: Difference) -> HeadTable:
    """The difference as the table of a head."""
    rows = HeadObservations(
        row=np.arange(1, len(difference) + 1),
        angle_deg=difference.angle_deg,
        reference_deg=difference.angle_deg + difference.difference_deg,
        direction=difference.direction,
    )
    weights = difference.uncertainty_deg**-2.0
    table = without_time(head_table(HeadScene(dwells=as_they_are(rows))))
    return replace(table, weights=weights / weights.mean(), counted="settings")


def _slope(loop: ReferenceLoop) -> tuple[float, float]:
    """Of the error with the angle, by its settings, in degrees per degree."""
    table = loop.explained.table
    columns = np.column_stack([np.ones(table.rows), table.scene.angle_deg])
    theta = np.linalg.lstsq(columns, table.output, rcond=None)[0]
    left = table.output - columns @ theta
    variance = float(left @ left) / max(table.rows - 2, 1) * np.linalg.pinv(columns.T @ columns)
    return float(theta[1]), float(np.sqrt(variance[1, 1]))


def _sizes(loop: ReferenceLoop) -> dict[tuple[str, int | None], float]:
    """Effects of one table alone."""
    return {_key(effect): _size(effect.coefficients)[0] for effect in loop.effects}


def _key(effect: EffectFound) -> tuple[str, int | None]:
    order = effect.coefficients.get("order")
    return effect.name, None if order is None else round(order.value)


def _size(coefficients: Mapping[str, Quantity]) -> tuple[float, float, str]:
    """Of a wave the amplitude with its uncertainty, of anything else its only coefficient; and the unit."""
    size = coefficients.get("amplitude_deg") or next(iter(coefficients.values()))
    return size.value, size.standard_uncertainty or 0.0, size.unit


def _change(
    effect: EffectFound, first: Mapping[tuple[str, int | None], float], second: Mapping[tuple[str, int | None], float]
) -> Change:
    key = _key(effect)
    size, uncertainty, unit = _size(effect.coefficients)
    return Change(
        name=key[0],
        order=key[1],
        unit=unit,
        before=first.get(key, 0.0),
        after=second.get(key, 0.0),
        difference=abs(size),
        standard_uncertainty=uncertainty,
        also_possible=effect.also_possible,
    )
