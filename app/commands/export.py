"""`tumble export`: from recording to observation table."""

from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.console import warn
from tumble.app.files import RECORDING_SUFFIX, is_recording, replacing
from tumble.app.kinds import Kind
from tumble.app.measurements import read_measurement
from tumble.app.terminal import say
from tumble.calibrations.core.table import write_table
from tumble.messages import Message
from tumble.procedures.errors import InputError


@click.command("export")
@click.argument("recording", type=options.EXISTING)
@click.option("--out", type=options.TABLE, help="Table to write; the recording's name with .csv without.")
def command(recording: Path, out: Path | None) -> None:
    """Write the observation table (CSV) of a recording: one row per dwell."""
    if not is_recording(recording):
        raise InputError(
            Message(
                "{path}: is no recording; name a file that ends in {suffix}",
                path=recording,
                suffix=RECORDING_SUFFIX,
            )
        )
    table = out or recording.with_suffix(".csv")
    measurement = read_measurement(recording)
    with replacing(table, Kind.TABLE) as begun:
        write_table(measurement.observations, begun)
    warn(measurement.observations.warnings)
    say(
        Message("{rows} rows in {table}", rows=len(measurement.observations), table=table),
        err=True,
    )
