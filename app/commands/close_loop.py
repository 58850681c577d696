"""`tumble close-loop`: trace what the declared model leaves to its causes, and run what tells them apart."""

import shlex
from collections.abc import Iterator, Sequence
from contextlib import AbstractContextManager, contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from tumble.app import reports
from tumble.app.acting import AtStand, measure
from tumble.app.adopted_effects import adopted_json, with_what_is_known
from tumble.app.analysed import Traced
from tumble.app.analysing import fit, trace
from tumble.app.calibrating import report_record, store, write_report
from tumble.app.closing import MOST_EXPERIMENTS, Closing, act, begin
from tumble.app.commands import options
from tumble.app.commands.leaving import leave_by
from tumble.app.commands.measuring import Wanted, may_measure
from tumble.app.console import messages, parameter_table, results, run_display, show_verdict, warn
from tumble.app.files import is_recording
from tumble.app.jobs import find_job, measured_at_stand
from tumble.app.joining import read_together
from tumble.app.last_calibration import other_lots
from tumble.app.learning import contradictions_of, learn
from tumble.app.loop_console import tell_closing
from tumble.app.measurements import read_measurement
from tumble.app.methods import close_loop, method_of
from tumble.app.row_sentences import row_lines
from tumble.app.running import Job
from tumble.app.section_report import table_report
from tumble.app.sections import show_sections
from tumble.app.stand import read_stand
from tumble.app.storing import origin_of_tables, record_tables, report_tables
from tumble.app.terminal import language, say
from tumble.calibrations.core.method import Method
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.records.record import Record
from tumble.calibrations.tracing.chain import Chain
from tumble.messages import Message
from tumble.procedures.announcer import Listener
from tumble.procedures.errors import InputError


@click.command("close-loop")
@click.argument("files", metavar="[FILE]...", nargs=-1, type=options.EXISTING)
@may_measure
@click.option(
    "--experiments",
    "most",
    type=click.IntRange(min=0),
    help=f"How many further experiments to run at most: without FILE {MOST_EXPERIMENTS}, after files 0 unless given.",
)
@options.known
@click.option(
    "--record", is_flag=True, help="Keep what files say as a record in --store; a loop that acts always is kept."
)
@options.verbose
@options.json_out
@click.option("--report", "page", type=options.REPORT, help="Write the report (HTML) here.")
def command(
    wanted: Wanted,
    files: tuple[Path, ...],
    most: int | None,
    known: options.Known,
    record: bool,
    verbose: bool,
    json_path: Path | None,
    page: Path | None,
) -> None:
    """Trace what the declared model leaves of recordings (.mcap) or tables (CSV) to effects.

    Several files of one unit are taken together, in the order in which they were measured. A table of a head against a
    reference (reference_deg) or of parameters against temperature (…_degC, no angle_deg) is traced likewise; of two
    tables of one head it is said what changed.

    Without a file the unit --serial is measured at the stand first, with --programme. While effects cannot be told
    apart, the experiment that tells most for its time is run there, and everything is fitted together again. After
    files, --experiments N does the same: they are the first measurement, and a loop that was cut off goes on from them.
    """
    if files and not measured_at_stand((method := method_of(files)).name, files):
        if most:
            raise InputError(
                Message(
                    "{path}: no experiment can be run from a table of this kind; leave --experiments out",
                    path=files[0],
                )
            )
        if known.effects is not None:
            raise InputError(
                Message("{path}: in a table of this kind no effect is adopted; leave --effects out", path=files[0])
            )
        _tell_tables(method, files, known.folder if record else None, verbose, json_path, page)
        return
    if files and not most:
        folder = known.folder if record else None
        traced = _traced(files, wanted, known, None if page or record else 0, folder)
        _tell(traced, None, json_path, page, store(traced, folder) if folder else None, known.folder)
        return
    closing = _closed(wanted, files, MOST_EXPERIMENTS if most is None else most, known)
    traced = closing.traced
    say(*learn(traced, known.folder).sentences, err=True)
    traced = traced.refitted(fit(traced.measurement, wanted.serial_number, folder=known.folder))
    _tell(traced, closing.chain, json_path, page, store(traced, known.folder), known.folder)


def _tell_tables(
    method: Method,
    files: tuple[Path, ...],
    folder: Path | None,
    verbose: bool,
    json_path: Path | None,
    page: Path | None,
) -> None:
    """Trace tables that were measured elsewhere, show what was found, and record it where a folder is given."""
    result = close_loop(method, files)
    warn(result.warnings)
    if str(json_path) != "-":
        show_sections(result.sections(), verbose=verbose)
    record = None if folder is None else record_tables(result, files, folder)
    recorded = {} if record is None else {"record": record.id}
    say(*(Message("record {name}", name=name) for name in recorded.values()), err=True)
    options.write_json(result.document() | recorded, json_path)
    if page is None:
        return
    if record is not None and folder is not None:
        report_tables(method, result, record, folder, page, language())
    else:
        reports.write(table_report(method, result, origin_of_tables(files, None), files[-1].name), page, language())


def _traced(
    files: tuple[Path, ...], wanted: Wanted, known: options.Known, trials: int | None, folder: Path | None
) -> Traced:
    """What files say, without a stand to ask; `folder` is that of the store, None where there will be no record."""
    stand = read_stand(wanted.stand_path).recorded if wanted.stand_path else None
    measurement = with_what_is_known(read_together(files, stand), known.folder, known.effects)
    return trace(fit(measurement.of_lot(wanted.lot), wanted.serial_number, trials, folder))


def _closed(wanted: Wanted, files: tuple[Path, ...], most: int, known: options.Known) -> Closing:
    """What files, or else a first measurement, say together with the experiments that it takes."""
    loaded, programme = wanted.asked()
    find_job(programme.method)
    with wanted.connected(loaded, [path for path in files if is_recording(path)]) as connected:
        at = AtStand(
            stand=loaded,
            connected=connected,
            serial_number=wanted.serial_number,
            folder=known.folder,
            lot=wanted.lot,
            operator=wanted.operator,
            effects=known.effects,
        )

        def watching(job: Job) -> AbstractContextManager[Listener]:
            return run_display(job.plan(), connected.stand.clock, messages())

        with _saying_how_to_go_on(wanted, files, connected.ran, known):
            if not files:
                with watching(at.job(programme)) as display:
                    files = (measure(at, programme, [display]),)
            begun = begin(files, at)
            return act(begun, replace(at, lot=begun.traced.measurement.lot), most, watching, tell_closing)


@contextmanager
def _saying_how_to_go_on(
    wanted: Wanted, files: Sequence[Path], ran: Sequence[Path], known: options.Known
) -> Iterator[None]:
    """Where the loop is cut off: how it goes on from what was measured."""
    try:
        yield
    except BaseException:
        kept = [path for path in dict.fromkeys([*(file.resolve() for file in files), *ran]) if _has_rows(path)]
        if kept:
            stand = ["--stand", str(wanted.stand_path)] if wanted.stand_path else []
            where = ["--serial", wanted.serial_number, "--store", str(known.folder)]
            where += ["--lot", wanted.lot] if wanted.lot else []
            where += ["--effects", str(known.effects)] if known.effects else []
            words = shlex.join([*map(str, kept), *stand, *where, "--experiments", str(MOST_EXPERIMENTS)])
            goes_on = Message(
                "the loop goes on from what was measured with: tumble close-loop {arguments}", arguments=words
            )
            if cut := [path for path in kept if not read_measurement(path).observations.complete]:
                first = Message(
                    "first complete what was cut off: tumble resume {paths}", paths=shlex.join(map(str, cut))
                )
                say(first, err=True)
            say(goes_on, err=True)
        raise


def _has_rows(path: Path) -> bool:
    """Whether there is anything in a file to go on from."""
    try:
        return bool(len(read_measurement(path).observations))
    except InputError:
        return False


def _tell_set_aside(observations: Rows) -> None:
    """Say which rows were not used, where there are any."""
    if observations.set_aside:
        for line in row_lines(observations):
            results().print(line, markup=False, soft_wrap=True)


def _tell(
    traced: Traced,
    chain: Chain[Any] | None,
    json_path: Path | None,
    page: Path | None,
    record: Record | None,
    folder: Path,
) -> None:
    """Show the result where it is wanted; `folder` is the store of the record.

    Raises `SystemExit` where limits are not met or not decided.
    """
    warn(traced.loop_warnings)
    if str(json_path) != "-":
        show_verdict(traced.verdict)
        show_sections(traced.sections())
        if not traced.shows_values:
            results().print(parameter_table(traced))
        _tell_set_aside(traced.rows)
    warn(contradictions_of(traced))
    warn(() if record is None else other_lots(folder, record))
    recorded = {} if record is None else {"record": record.id}
    say(*(Message("record {name}", name=name) for name in recorded.values()), err=True)
    options.write_json(
        traced.loop_json() | adopted_json(traced) | (chain.as_json() if chain else {}) | recorded, json_path
    )
    if page is not None:
        if record is None:
            write_report(traced, page, language(), chain=chain)
        else:
            report_record(traced, record, folder, page, language(), chain)
        say(Message("report {page}", page=page), err=True)
    leave_by(traced.verdict)
