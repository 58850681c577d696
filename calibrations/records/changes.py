"""How far the values of a unit have moved since it was calibrated before."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Final

from tumble.calibrations.core.quantities import format_number, rounded
from tumble.calibrations.records.compare import Difference, compare
from tumble.calibrations.records.record import Record

LOOKED_AT: Final = 20
"""Earlier records of a unit, at most, in which a value is looked for."""


@dataclass(frozen=True, kw_only=True)
class Change:
    """One value against that of the last record before it that has one of the same definition."""

    difference: float
    """This value minus the earlier one, in `unit`."""
    expanded_uncertainty: float
    """Of the difference, for a coverage probability of 95%, in `unit`; 0 where neither value has an uncertainty."""
    unit: str
    since: str
    """When the earlier one was measured, ISO 8601, or recorded where nothing says so."""
    record_id: str
    """Of the earlier one."""

    @property
    def text(self) -> str:
        """`(+0.12 ± 0.36) mV/g`."""
        sign, size = "-" if self.difference < 0 else "+", abs(self.difference)
        told = rounded(size, self.expanded_uncertainty, self.unit)
        if not told.uncertainty:
            return sign + format_number(size, self.unit)
        return f"({sign}{told.value} ± {told.uncertainty}) {told.unit}"


def changes(record: Record, earlier: Iterable[Record]) -> dict[str, Change]:
    """How far each of the values to use has moved, by name; one that no earlier record has is left out.

    Parameters
    ----------
    record
        Whose values they are.
    earlier
        Records of the same unit and method, the newest first; no further one is asked for than is needed. A value
        is of the same definition where unit and conditions are the same (`compare`).
    """
    wanted = {name for name, parameter in record.values.items() if parameter.value is not None}
    found: dict[str, Change] = {}
    for before in earlier:
        for difference in compare(before, record):
            if difference.name in wanted - found.keys() and difference.difference is not None:
                found[difference.name] = _change(difference, difference.difference, before)
        if wanted == found.keys():
            break
    return {name: found[name] for name in record.values if name in found}


def _change(told: Difference, difference: float, before: Record) -> Change:
    return Change(
        difference=difference,
        expanded_uncertainty=told.expanded_uncertainty,
        unit=told.unit,
        since=before.provenance.measured_at or before.created_at.isoformat(),
        record_id=before.id,
    )
