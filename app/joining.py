"""Several raw files of one unit as one measurement: a table, say, and the experiments that were run after it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from tumble.app.jobs import find_job
from tumble.app.measurement import Measurement
from tumble.app.measurements import read_measurement
from tumble.calibrations.core.joining import joined
from tumble.calibrations.core.rows import Rows
from tumble.messages import AsWritten, Message
from tumble.procedures.errors import InputError


def read_together(paths: Sequence[Path], stand: Mapping[str, Any] | None = None) -> Measurement:
    """Read one or more recordings or tables as one measurement, in the order in which they are given.

    Stand and programme are those of the first file that has them.

    Parameters
    ----------
    paths
        Files to read.
    stand
        Stand file as data, in place of what recordings hold.

    Raises
    ------
    InputError
        Unreadable or malformed, of different units, given twice, or one that contradicts its own description.
    """
    measurements = [read_measurement(path, stand) for path in paths]
    first, *others = measurements
    if not others:
        return first
    _refuse_other_methods(measurements)
    _refuse_twice(measurements)
    _refuse_other_units(measurements)
    rows = joined([_answered(each) for each in measurements], [_start_s(each) for each in measurements])
    lots = [(each.path, each.lot) for each in measurements if each.lot]
    return replace(
        first,
        observations=replace(rows, warnings=(*rows.warnings, *_different_lots(lots))),
        lot=lots[0][1] if lots else "",
        stand=next((each.stand for each in measurements if each.stand), {}),
        header=next((each.header for each in measurements if each.header), None),
        others=tuple(others),
    )


def _refuse_other_methods(measurements: Sequence[Measurement]) -> None:
    first = measurements[0]
    for each in measurements:
        if each.method != first.method:
            raise InputError(
                Message(
                    "{first} and {second} are tables of different kinds; give them one by one",
                    first=first.path,
                    second=each.path,
                )
            )


def _refuse_twice(measurements: Sequence[Measurement]) -> None:
    first: dict[str, Path] = {}
    for each in measurements:
        if each.sha256 in first:
            raise InputError(
                Message(
                    "{path}: holds the same as {same}; give every file once", path=each.path, same=first[each.sha256]
                )
            )
        first[each.sha256] = each.path


def _refuse_other_units(measurements: Sequence[Measurement]) -> None:
    recorded = [(each.path, each.header.serial_number) for each in measurements if each.header]
    for path, serial_number in recorded[1:]:
        if serial_number != recorded[0][1]:
            raise InputError(
                Message(
                    "{path}: holds unit {serial_number}, but {other} holds unit {other_serial_number}; "
                    "give only files of "
                    "one unit",
                    path=path,
                    serial_number=AsWritten(serial_number),
                    other=recorded[0][0],
                    other_serial_number=AsWritten(recorded[0][1]),
                )
            )


def _different_lots(lots: Sequence[tuple[Path, str]]) -> Iterator[str]:
    """A unit has one lot, but who is right a file cannot say."""
    for path, lot in lots[1:]:
        if lot != lots[0][1]:
            yield Message(
                "{path}: the unit is of lot {lot} here, but of lot {other_lot} in {other}; see which is right",
                path=path,
                lot=AsWritten(lot),
                other_lot=AsWritten(lots[0][1]),
                other=lots[0][0],
            )


def _answered(measurement: Measurement) -> Rows:
    """The rows of a file; a question that nothing can be traced without must be answered first."""
    try:
        return find_job(measurement.method).answered(measurement.observations)
    except ValueError as error:
        raise InputError(str(error)) from error


def _start_s(measurement: Measurement) -> float | None:
    """Clock time at which `time_s` is 0; only recordings say."""
    return measurement.header.started_wall_ns / 1e9 if measurement.header else None
