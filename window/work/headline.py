"""The parameter that stands for a record in a list."""

from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record


def headline(record: Record, name: str) -> RecordedParameter | None:
    """The named parameter; without a name the first with an uncertainty, or else with a value; None where none has."""
    values = record.values
    if name:
        return values.get(name)
    told = [parameter for parameter in values.values() if parameter.value is not None]
    sure = [parameter for parameter in told if parameter.standard_uncertainty is not None]
    return next(iter([*sure, *told]), None)
