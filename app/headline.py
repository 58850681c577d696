"""The parameter that stands for a record in a list."""

from collections.abc import Mapping

from tumble.app.methods import method_called
from tumble.calibrations.records.parameter import RecordedParameter
from tumble.calibrations.records.record import Record
from tumble.procedures.errors import InputError


def headline(record: Record) -> RecordedParameter | None:
    """The parameter that the record's method names, or else `chosen` one; None where there is none."""
    try:
        name = method_called(record.method).headline
    except (LookupError, InputError):  # of a method that is not installed, or cannot be used
        name = ""
    return chosen(record.values, name)


def chosen(values: Mapping[str, RecordedParameter], name: str) -> RecordedParameter | None:
    """The named parameter; without a name the first with an uncertainty, or else with a value; None where none has."""
    if name:
        return values.get(name)
    told = [parameter for parameter in values.values() if parameter.value is not None]
    sure = [parameter for parameter in told if parameter.standard_uncertainty is not None]
    return next(iter([*sure, *told]), None)
