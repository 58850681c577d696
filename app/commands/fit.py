"""`tumble fit`: analyse a raw file."""

from pathlib import Path

import click

from app.analysing import fit, trace
from app.calibrating import store
from app.commands import options
from app.console import show_result, warn
from app.exits import Exit
from app.measurements import read_measurement
from app.stand import read_stand
from app.stand_records import with_stand_record
from app.terminal import say


@click.command("fit")
@click.argument("file", type=options.EXISTING)
@options.json_out
@click.option("--stand", "stand_path", type=options.EXISTING, help="Stand file for the budget of a table.")
@options.serial_of_file
@click.option("--store", "folder", type=options.EXISTING, help="Folder of the records; without it nothing is stored.")
def command(
    file: Path, json_path: Path | None, stand_path: Path | None, serial_number: str, folder: Path | None
) -> None:
    """Fit a recording (.mcap) or an observation table (CSV)."""
    measurement = read_measurement(file, read_stand(stand_path).recorded if stand_path else None)
    measurement = with_stand_record(measurement, folder)
    analysed = fit(measurement, serial_number, folder=folder)
    warn(analysed.calibration.warnings)
    if str(json_path) != "-":
        show_result(analysed)
    document = analysed.calibration.as_json()
    if folder is not None:
        document["record"] = store(trace(analysed), folder).id
        say(f"record {document['record']}", err=True)
    options.write_json(document, json_path)
    if not analysed.inside:
        raise SystemExit(int(Exit.OUTSIDE_LIMITS))
