"""`tumble export`: from recording to observation table."""

from pathlib import Path

import click

from app.commands import options
from app.console import warn
from app.exits import Exit, JobError
from app.files import RECORDING_SUFFIX, is_recording, refuse_recording
from app.measurements import read_measurement
from app.terminal import say
from calibrations.table import write_table
from procedures.errors import InputError


@click.command("export")
@click.argument("recording", type=options.EXISTING)
@click.option("--out", type=options.EXISTING, help="Table to write; the recording's name with .csv without.")
def command(recording: Path, out: Path | None) -> None:
    """Write the observation table (CSV) of a recording: one row per dwell."""
    if not is_recording(recording):
        raise InputError(f"{recording}: is no recording; name a file that ends in {RECORDING_SUFFIX}")
    table = out or recording.with_suffix(".csv")
    refuse_recording(table)
    measurement = read_measurement(recording)
    try:
        write_table(measurement.observations, table)
    except OSError as error:
        raise JobError(
            f"{table}: cannot be written ({error.strerror}); make room or choose another", Exit.STORAGE
        ) from error
    warn(measurement.observations.warnings)
    say(f"{len(measurement.observations)} rows in {table}", err=True)
