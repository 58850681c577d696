"""Records on the terminal."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich.table import Column, Table

from tumble.app.terminal import say
from tumble.calibrations.core.quantities import format_concise
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.messages import Message

_NAMES = 7
"""Width of the column of names; longer names widen it."""
_SCALE_FACTOR = "kx"
"""The parameter that the list shows, of records that have it."""


def listing(found: tuple[Record, ...]) -> Table:
    """A line for every record, and its method below: a further column would break serial numbers."""
    first = Column("record, method", no_wrap=True)
    table = Table(first, "unit", "programme", "measured", "revision", "verdict", _SCALE_FACTOR)
    for record in found:
        shown = record.values.get(_SCALE_FACTOR)
        origin = record.provenance
        measured = origin.measured_at or f"{record.created_at:%Y-%m-%d %H:%M}"
        table.add_row(
            record.id,
            origin.serial_number,
            origin.programme_name,
            measured,
            str(record.revision),
            record.verdict.outcome.words,
            "; ".join(filter(None, (_value(shown), shown.condition))) if shown else "",
        )
        table.add_row(record.method)
    return table


def effects_of(record: Record) -> Sequence[Mapping[str, Any]]:
    """The effects found, of the loop in a result or of a result that is one."""
    found: Sequence[Mapping[str, Any]] = record.result.get("loop", record.result).get("effects", ())
    return found


def show_parameters(parameters: Mapping[str, RecordedParameter]) -> None:
    """Parameters with their uncertainties, or why they have no value."""
    width = max((len(name) + 1 for name in parameters), default=0)
    for name, parameter in parameters.items():
        beside = f"  {name:{max(width, _NAMES)}s}"
        if parameter.value is None:
            say(Message("{beside}not identifiable: {reason}", beside=beside, reason=parameter.reason))
        else:
            say(f"{beside}{_value(parameter)}{parameter.condition and f'  {parameter.condition}'}")


def _value(parameter: RecordedParameter) -> str:
    if parameter.value is None:
        return ""
    if parameter.standard_uncertainty is None:
        return f"{parameter.value:g} {parameter.unit}".rstrip()
    return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)
