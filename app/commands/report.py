"""`tumble report`: the page a person prints."""

from pathlib import Path

import click

from tumble.app.commands import options
from tumble.app.files import check_result
from tumble.app.kinds import report_kind
from tumble.app.terminal import language, say
from tumble.messages import Message


@click.command("report")
@click.argument("file_or_record")
@click.option(
    "--out",
    type=options.REPORT,
    help="File to write, .html or .pdf; without, a page beside the file, or in the store.",
)
@click.option("--stand", "stand_path", type=options.EXISTING, help="Stand file for the budget of a table.")
@options.serial_of_file
@options.lot_of_file
@options.known
def command(
    file_or_record: str,
    out: Path | None,
    stand_path: Path | None,
    serial_number: str,
    lot: str,
    known: options.Known,
) -> None:
    """Write the report (HTML or PDF) of a recording, an observation table, or a stored record by its id."""
    path = Path(file_or_record)
    if path.is_file() or path.suffix:  # an id has none
        page = out or path.with_suffix(".html")
        check_result(page, report_kind(page))
        _report_file(path, page, stand_path, serial_number, lot, known)
    else:
        from tumble.app.reporting import report_again

        page = report_again(known.folder, file_or_record, language(), out)
    say(Message("report {page}", page=page))


def _report_file(
    path: Path, page: Path, stand_path: Path | None, serial_number: str, lot: str, known: options.Known
) -> None:
    """Analyse a file and report it; what that takes is imported here, since a record does without."""
    from tumble.app.adopted_effects import with_what_is_known
    from tumble.app.analysing import fit, trace
    from tumble.app.calibrating import write_report
    from tumble.app.measurements import read_measurement
    from tumble.app.stand import read_stand

    measurement = read_measurement(path, read_stand(stand_path).recorded if stand_path else None)
    measurement = with_what_is_known(measurement, known.folder, known.effects)
    write_report(trace(fit(measurement.of_lot(lot), serial_number)), page, language())
