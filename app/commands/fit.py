"""`tumble fit`: analyse a raw file."""

from pathlib import Path

import click

from tumble.app.adopted_effects import adopted_json, contradicted, with_what_is_known
from tumble.app.analysing import fit, trace
from tumble.app.commands import options
from tumble.app.commands.leaving import leave_by
from tumble.app.console import results, show_result, warn
from tumble.app.last_calibration import other_lots
from tumble.app.measurements import read_measurement
from tumble.app.sections import show_sections
from tumble.app.stand import read_stand
from tumble.app.terminal import say
from tumble.messages import Message


@click.command("fit")
@click.argument("file", type=options.EXISTING)
@options.json_out
@click.option("--stand", "stand_path", type=options.EXISTING, help="Stand file for the budget of a table.")
@options.serial_of_file
@options.lot_of_file
@click.option("--store", "folder", type=options.EXISTING, help="Folder of the records; without it nothing is stored.")
@options.effects
@options.verbose
def command(
    file: Path,
    json_path: Path | None,
    stand_path: Path | None,
    serial_number: str,
    lot: str,
    folder: Path | None,
    effects: Path | None,
    verbose: bool,
) -> None:
    """Fit a recording (.mcap) or an observation table (CSV).

    Where the programme states limits, or the result is stored, the loop is closed as well: no verdict rests on the fit
    alone.
    """
    measurement = read_measurement(file, read_stand(stand_path).recorded if stand_path else None)
    measurement = with_what_is_known(measurement, folder, effects).of_lot(lot)
    analysed = fit(measurement, serial_number, folder=folder)
    traced = trace(analysed) if analysed.limits or folder is not None or effects is not None else None
    result = traced or analysed
    warn(result.warnings)
    if str(json_path) != "-":
        show_result(result, verbose=verbose)
        if traced is None:
            results().print(
                Message("the values are those of the declared model alone; tumble close-loop traces what it leaves")
            )
        else:
            show_sections(traced.sections())
            warn(contradicted(traced))
    document = result.as_json() | adopted_json(result)
    if traced is not None and folder is not None:
        from tumble.app.calibrating import store  # what drives a stand comes with it

        record = store(traced, folder)
        document["record"] = record.id
        warn(other_lots(folder, record))
        say(Message("record {record_id}", record_id=document["record"]), err=True)
    options.write_json(document, json_path)
    leave_by(result.verdict)
