"""`tumble allan`: the noise of a unit that was left alone, and how long to average it."""

from pathlib import Path

import click

from tumble.app import reports
from tumble.app.commands import options
from tumble.app.console import warn
from tumble.app.files import is_recording, write_new
from tumble.app.sections import show_sections
from tumble.app.still import read_still_dwell
from tumble.app.terminal import language, say
from tumble.calibrations.allan.recording import StillRecording, read_still
from tumble.calibrations.allan.result import AllanResult, allan
from tumble.calibrations.allan.sections import sections
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.report.document import page_of_sections
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.programmes import load_programme, with_dwell


@click.command("allan")
@click.argument("file", type=options.EXISTING)
@click.option(
    "--rate",
    "rate_hz",
    type=click.FloatRange(min=0.0, min_open=True),
    callback=options.finite,
    help="Samples a second, where there is no column time_s.",
)
@click.option("--programme", help="Programme whose dwells are to last as long as this recording says.")
@click.option("--out", type=options.EXISTING, help="Where that programme is written (TOML); an existing file is kept.")
@options.verbose
@options.json_out
@click.option("--report", "page", type=options.REPORT, help="Write the report (HTML) here.")
def command(
    file: Path,
    rate_hz: float | None,
    programme: str | None,
    out: Path | None,
    verbose: bool,
    json_path: Path | None,
    page: Path | None,
) -> None:
    """Allan deviation of a long still recording: white noise, flicker, random walk, best averaging time.

    FILE is a table (CSV), of which every column of numbers but times and temperatures is an output, or the recording
    (.mcap) of a run, of which the first dwell is used. With --programme and --out a programme is written
    whose dwells last as long as the recording says.
    """
    if (programme is None) != (out is None):
        raise click.UsageError(Message("give --programme and --out together"))
    result = allan(_read(file, rate_hz))
    warn(result.warnings)
    if str(json_path) != "-":
        show_sections(sections(result), verbose=verbose)
    options.write_json(result.document(), json_path)
    if page is not None:
        _write_page(result, page)
    if programme is not None and out is not None:
        _write_programme(result, programme, out)


def _read(file: Path, rate_hz: float | None) -> StillRecording:
    """Read a table, or the first dwell of a run. Raises `InputError`, `RecordingError`."""
    if is_recording(file):
        return read_still_dwell(file)
    try:
        return read_still(file, rate_hz)
    except TableError as error:
        raise InputError(str(error)) from error


def _write_page(result: AllanResult, page: Path) -> None:
    name = Path(result.recording.source).name
    reports.write(
        page_of_sections(Message("Allan deviation"), name, list(sections(result)), result.warnings), page, language()
    )
    say(Message("report {page}", page=page), err=True)


def _write_programme(result: AllanResult, programme: str, out: Path) -> None:
    """Write a programme with the dwell that was found. Raises `InputError` where none was."""
    if result.dwell_s is None:
        raise InputError(
            Message(
                "{path}: the noise falls as long as it can be averaged, so that no dwell follows; record for longer, "
                "or write dwell_s into the programme yourself",
                path=result.recording.source,
            )
        )
    write_new(out, with_dwell(load_programme(programme).text, round(result.dwell_s, 1)))
    say(Message("programme {path}", path=out), err=True)
