"""What the screen Records asks of the store; every function is called outside the event loop.

Database and analysis are imported when they are called: a window is up before that.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Final

from tumble.app.files import check_result, replacing, write_text
from tumble.app.kinds import Kind
from tumble.app.running import Job
from tumble.calibrations.records.record import Record
from tumble.calibrations.records.wanted import Wanted
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.window.look.language import spoken
from tumble.window.work import tables
from tumble.window.work.activity import Concluded, Resumption

if TYPE_CHECKING:
    from tumble.app.cut_off import CutOff
    from tumble.calibrations.records.store import Store
    from tumble.calibrations.records.verify import Verification
    from tumble.calibrations.stand_records.record import StandRecord
    from tumble.window.work.compared import Comparison
    from tumble.window.work.preview import Preview
    from tumble.window.work.record_lines import RecordLine


SHOWN: Final = 60
"""Records that are listed at once; who looks for others says so."""


@dataclass(frozen=True, kw_only=True)
class Found:
    """What was looked for."""

    lines: "tuple[RecordLine, ...]"
    """The newest of them, in the order in which they were measured."""
    more: bool
    """Whether there are older ones."""


@dataclass(frozen=True, kw_only=True)
class Around:
    """What else a store holds."""

    cut_off: "tuple[CutOff, ...]"
    titles: Mapping[str, str]
    programmes: tuple[str, ...] = ()
    stand_names: tuple[str, ...] = ()
    methods: tuple[str, ...] = ()
    findings: tuple[str, ...] = ()
    """All four of which there are records."""
    stands: "tuple[StandRecord, ...]" = ()
    """Stand records of all stands."""


def search(folder: Path, wanted: Wanted) -> Found:
    """Look for records; a store that is not there holds nothing. Raises `StoreError`, one that is lost among them."""
    from tumble.app.opening import check_not_lost
    from tumble.calibrations.records.store import DATABASE
    from tumble.window.work.record_lines import lines_of

    if not (folder / DATABASE).is_file():
        check_not_lost(folder)
        return Found(lines=(), more=False)
    found = _kept_open(folder).newest(wanted, SHOWN + 1)
    return Found(lines=lines_of(found[:SHOWN][::-1], method_titles()), more=len(found) > SHOWN)


@lru_cache(maxsize=1)
def _kept_open(folder: Path) -> "Store":
    """A store as it was opened first: of a search among many records a tenth of the time would go into opening it."""
    from tumble.app.opening import open_store

    return open_store(folder)


def look_around(folder: Path) -> Around:
    """Look for runs that came to no record, programmes and stand records."""
    from tumble.app.cut_off import cut_off_runs
    from tumble.app.opening import open_store
    from tumble.app.stand_records import list_stand_records
    from tumble.calibrations.records.store import DATABASE

    if not (folder / DATABASE).is_file():
        return Around(cut_off=cut_off_runs(folder), titles=method_titles())
    kept = open_store(folder)
    return Around(
        cut_off=cut_off_runs(folder),
        titles=method_titles(),
        programmes=kept.programmes(),
        stand_names=kept.stands(),
        methods=kept.methods(),
        findings=kept.findings(),
        stands=list_stand_records(folder),
    )


@cache
def method_titles() -> Mapping[str, str]:
    """What the installed methods measure, in words, by name."""
    from tumble.app.methods import methods

    return {method.name: method.title for method in methods()}


def open_record(folder: Path, record_id: str) -> Concluded:
    """Read the raw file of a record and work out everything that the screen Result shows."""
    from tumble.app.analysing import fit, trace
    from tumble.app.jobs import measured_at_stand
    from tumble.app.kept_reports import report_path
    from tumble.app.opening import open_store
    from tumble.app.recall import recall

    found = open_store(folder)
    record = found.get(record_id)
    files = found.raw_files(record)
    if not measured_at_stand(record.method, files):
        return tables.recall(record, files, folder)
    record, measurement = recall(folder, record_id)
    traced = trace(fit(measurement, record.provenance.serial_number, folder=folder))
    page = report_path(folder, record)
    return Concluded(
        method=record.method,
        traced=traced,
        recordings=tuple(each.path for each in (measurement, *measurement.others)),
        record_id=record.id,
        report=page if page.is_file() else None,
    )


def analyse_again(folder: Path, record_id: str) -> Concluded:
    """Analyse the raw file of a record anew and store what comes of it as a further revision."""
    from tumble.app.calibrating import report_record, store
    from tumble.app.kept_reports import report_path

    concluded = open_record(folder, record_id)
    if isinstance(concluded.traced, tables.TableResult):
        return analyse_file(folder, *concluded.recordings)
    record = store(concluded.traced, folder)
    page = report_path(folder, record)
    report_record(concluded.traced, record, folder, page, spoken())
    return replace(concluded, record_id=record.id, report=page)


def analyse_cut_off(folder: Path, path: Path) -> Concluded:
    """Analyse a run as far as it goes, and store what comes of it."""
    from tumble.app.calibrating import conclude, make_ready

    make_ready(folder)
    done = conclude(path, folder, language=spoken())
    return Concluded(
        method=done.record.method,
        traced=done.analysed,
        recordings=(path,),
        record_id=done.record.id,
        report=done.report,
    )


def analyse_file(folder: Path, *files: Path) -> Concluded:
    """Analyse a recording, or tables of one unit, by the method that they are of, and store what comes of it."""
    from tumble.app.jobs import measured_at_stand
    from tumble.app.methods import method_of

    method = method_of(files)
    if measured_at_stand(method.name, files):
        return analyse_cut_off(folder, files[0])
    return tables.analyse(method, files, folder)


def discard(folder: Path, path: Path) -> Path:
    """Take a run that nobody needs out of the way, and return where it lies now. Raises `InputError`, `JobError`."""
    from tumble.app.discarding import discard

    return discard(folder, path)


def preview(record: Record) -> "Preview":
    """A record in short."""
    from tumble.window.work.preview import preview

    return preview(record)


def comparison(first: Record, second: Record) -> "Comparison":
    """Hold two records against each other. Raises `RecordError`."""
    from tumble.window.work.comparison import comparison

    return comparison(first, second)


def verify_all(folder: Path, record_ids: Sequence[str]) -> "tuple[Verification, ...]":
    """Verify records."""
    from tumble.app.opening import open_store
    from tumble.app.recall import verify_record

    records = open_store(folder)
    return tuple(verify_record(records, records.get(record_id)) for record_id in record_ids)


def resumption(folder: Path, path: Path) -> Resumption:
    """What there is to go on with a run that was cut off."""
    from tumble.app.resuming import find
    from tumble.app.same_stand import load_same_stand

    unfinished = find(path)
    header = unfinished.recording.header
    job = Job(
        stand=load_same_stand(unfinished.recording),
        programme=unfinished.programme,
        serial_number=header.serial_number,
        lot=header.lot,
        operator=header.operator,
    )
    job.check(unfinished.recording.points)
    return Resumption(unfinished=unfinished, job=job, store=folder)


def export(folder: Path, record_id: str, path: Path) -> Path:
    """Write a record in the format that the name of the file ends in: JSON, HTML, CSV or PDF.

    Raises `InputError` for another ending, `JobError` where the file cannot be written.
    """
    from tumble.app.opening import open_store
    from tumble.app.reporting import report_again
    from tumble.calibrations.records.export import document_text

    match path.suffix.lower():
        case ".json":
            write_text(path, document_text(open_store(folder).get(record_id)))
        case ".html" | ".pdf":
            report_again(folder, record_id, spoken(), path)
        case ".csv":
            _write_rows(folder, record_id, path)
        case suffix:
            raise InputError(
                Message(
                    "{path}: {ending} is no format of a record; end it in .json, .html, .csv or .pdf",
                    path=path,
                    ending=suffix or Message("no ending"),
                )
            )
    return path


def _write_rows(folder: Path, record_id: str, path: Path) -> None:
    from tumble.app.recall import recall
    from tumble.calibrations.core.table import write_table

    check_result(path, Kind.TABLE)
    _, measurement = recall(folder, record_id)
    with replacing(path, Kind.TABLE) as begun:
        write_table(measurement.observations, begun)
