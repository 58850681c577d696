"""`tumble export`: from recording to observation table, or to a table of parameters against temperature."""

import csv
from collections.abc import Mapping, Sequence
from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.console import warn
from tumble.app.files import RECORDING_SUFFIX, is_recording, replacing
from tumble.app.job_part import OverTemperature
from tumble.app.jobs import find_job
from tumble.app.kinds import Kind
from tumble.app.measurement import Measurement
from tumble.app.measurements import read_measurement
from tumble.app.terminal import say
from tumble.calibrations.core.table import write_table
from tumble.messages import Message
from tumble.procedures.errors import InputError


@click.command("export")
@click.argument("recordings", metavar="RECORDING...", nargs=-1, required=True, type=options.EXISTING)
@click.option("--out", type=options.TABLE, help="Table to write; the recording's name with .csv without.")
@click.option(
    "--parameters",
    is_flag=True,
    help="Write the parameters of a fit at each temperature instead, one row a run, of one recording or several.",
)
def command(recordings: tuple[Path, ...], out: Path | None, parameters: bool) -> None:
    """Write the observation table (CSV) of a recording: one row per dwell."""
    if parameters:
        _write_parameters([read_measurement(path) for path in recordings], out or recordings[0].with_suffix(".csv"))
        return
    if len(recordings) > 1:
        raise click.UsageError(Message("give one recording at a time, or --parameters"))
    _write_rows(recordings[0], out or recordings[0].with_suffix(".csv"))


def _write_rows(recording: Path, table: Path) -> None:
    if not is_recording(recording):
        raise InputError(
            Message(
                "{path}: is no recording; name a file that ends in {suffix}",
                path=recording,
                suffix=RECORDING_SUFFIX,
            )
        )
    measurement = read_measurement(recording)
    with replacing(table, Kind.TABLE) as begun:
        write_table(measurement.observations, begun)
    warn(measurement.observations.warnings)
    say(
        Message.counted(
            "{count} row in {table}", "{count} rows in {table}", count=len(measurement.observations), table=table
        ),
        err=True,
    )


def _write_parameters(measurements: Sequence[Measurement], table: Path) -> None:
    """Write one row a run at a temperature. Raises `InputError`."""
    columns = _columns(measurements)
    with replacing(table, Kind.TABLE) as begun, begun.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))
    say(
        Message.counted("{count} run in {table}", "{count} runs in {table}", count=len(columns["run"]), table=table),
        err=True,
    )


def _columns(measurements: Sequence[Measurement]) -> Mapping[str, Sequence[float]]:
    part = find_job(measurements[0].method)
    if not isinstance(part, OverTemperature) or len({each.method for each in measurements}) > 1:
        raise InputError(
            Message("{path}: of runs of this kind no table of parameters is made", path=measurements[0].path)
        )
    try:
        return part.parameter_runs([each.observations for each in measurements])
    except ValueError as error:
        raise InputError(str(error)) from error
