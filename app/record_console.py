"""Records on the terminal."""

from collections.abc import Mapping
from typing import Final

from rich.table import Column, Table

from tumble.app.headline import headline
from tumble.app.terminal import say
from tumble.calibrations.core.quantities import format_concise
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.messages import Message

_NAMES = 7
"""Width of the column of names; longer names widen it."""
_HEADINGS: Final = (
    Message("unit, lot"),
    Message("programme"),
    Message("measured"),
    Message("revision"),
    Message("verdict"),
    Message("result"),
)


def listing(found: tuple[Record, ...]) -> Table | str:
    """A line for every record, its method and lot below: further columns would break serial numbers."""
    if not found:
        return Message("No record matches.")
    table = Table(Column(Message("record, method"), no_wrap=True), *_HEADINGS)
    for record in found:
        origin = record.provenance
        measured = (origin.measured_at or record.created_at.isoformat())[:16].replace("T", " ")
        table.add_row(
            record.id,
            origin.serial_number,
            origin.programme_name,
            measured,
            str(record.revision),
            record.verdict.outcome.words,
            _result(record),
        )
        table.add_row(record.method, origin.lot)
    return table


def _result(record: Record) -> str:
    """The parameter that stands for a record, with the condition on which it stands."""
    parameter = headline(record)
    if parameter is None or parameter.value is None:
        return parameter.condition if parameter else ""
    named = Message("{parameter} {value}", parameter=parameter.name, value=_value(parameter))
    return Message.joined("; ", filter(None, (named, parameter.condition)))


def show_parameters(parameters: Mapping[str, RecordedParameter]) -> None:
    """Parameters with their uncertainties, or why they have no value."""
    width = max((len(name) + 1 for name in parameters), default=0)
    for name, parameter in parameters.items():
        beside = f"  {name:{max(width, _NAMES)}s}"
        if parameter.value is None:
            say(Message("{beside}not identifiable: {reason}", beside=beside, reason=parameter.reason))
        else:
            say(Message.joined("  ", filter(None, (f"{beside}{_value(parameter)}", parameter.condition))))


def _value(parameter: RecordedParameter) -> str:
    if parameter.value is None:
        return ""
    if parameter.standard_uncertainty is None:
        return f"{parameter.value:g} {parameter.unit}".rstrip()
    return format_concise(parameter.value, parameter.standard_uncertainty, parameter.unit)
