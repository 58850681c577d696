"""The parameter that stands for a record in a list."""

from tumble.app.methods import method_called
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record


def headline(record: Record) -> RecordedParameter | None:
    """The parameter that the record's method names; None where it is not identifiable.

    Where the method names none: the first with an uncertainty, or else with a value.
    """
    values = record.values
    told = {name: parameter for name, parameter in values.items() if parameter.value is not None}
    if name := _named(record.method):
        return told.get(name)
    sure = [parameter for parameter in told.values() if parameter.standard_uncertainty is not None]
    return next(iter([*sure, *told.values()]), None)


def _named(method: str) -> str:
    try:
        return method_called(method).headline
    except LookupError:  # of a method that is not installed
        return ""
