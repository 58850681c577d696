"""`tumble close-loop`: trace what the declared model leaves to its causes."""

from pathlib import Path

import click

from app.analysing import fit, trace
from app.calibrating import write_report
from app.commands import options
from app.console import messages, warn
from app.exits import Exit
from app.joining import read_together
from app.learning import contradictions_of
from app.loop_console import show_loop
from app.stand import load_stand
from app.stand_records import with_stand_record
from calibrations.montecarlo import TRIALS
from calibrations.tracing.document import document


@click.command("close-loop")
@click.argument("files", metavar="FILE...", nargs=-1, required=True, type=options.EXISTING)
@options.json_out
@click.option("--stand", "stand_path", type=options.EXISTING, help="Stand file for the budget of a table.")
@click.option("--serial", "serial_number", default="", help="Serial number of the unit, where the file does not say.")
@options.stand_store
@click.option("--report", "page", type=options.EXISTING, help="Write the report (HTML) here.")
def command(
    files: tuple[Path, ...],
    json_path: Path | None,
    stand_path: Path | None,
    serial_number: str,
    folder: Path | None,
    page: Path | None,
) -> None:
    """Trace what the declared model leaves of a recording (.mcap) or a table (CSV) to effects.

    Several files of one unit are taken together, in the order in which they were measured.
    """
    measurement = read_together(files, load_stand(stand_path).recorded if stand_path else None)
    measurement = with_stand_record(measurement, folder)
    traced = trace(fit(measurement, serial_number, trials=TRIALS if page else 0))
    warn(traced.loop.augmented.warnings)
    if str(json_path) != "-":
        show_loop(traced.loop)
    warn(contradictions_of(traced))
    options.write_json(document(traced.loop), json_path)
    if page is not None:
        write_report(traced, page)
        messages().print(f"report {page}", soft_wrap=True)
    if not traced.inside:
        raise SystemExit(int(Exit.OUTSIDE_LIMITS))
