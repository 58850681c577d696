"""The main job and its parts: run, fit, trace, store, report."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from tumble.app import reports
from tumble.app.adopted_effects import FOLDER, adopted_json, read_kept, with_what_is_known
from tumble.app.analysed import Traced
from tumble.app.analysing import fit, trace
from tumble.app.exits import Exit, JobError
from tumble.app.jobs import find_job
from tumble.app.kept_reports import keep, of_record, report_path
from tumble.app.last_calibration import other_lots
from tumble.app.learning import Learned, contradictions_of, learn
from tumble.app.measurements import read_measurement
from tumble.app.opening import store_to_write
from tumble.app.recording_names import recording_path
from tumble.app.running import Job, failure, run
from tumble.app.wiring import Connected
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.records.errors import StoreError
from tumble.calibrations.records.record import Record
from tumble.calibrations.tracing.chain import Chain
from tumble.messages import Language, Message
from tumble.procedures.announcer import Listener
from tumble.system_errors import reason


def store(traced: Traced, folder: Path) -> Record:
    """Store a calibration; a raw file that was calibrated before gets a further revision. Raises `JobError`."""
    try:
        return store_to_write(folder).revise(_entry(traced), traced.provenance)
    except StoreError as error:
        raise JobError(
            Message("{error}; the recording is kept in {path}", error=error, path=traced.measurement.path), Exit.STORAGE
        ) from error


def _entry(traced: Traced) -> Entry:
    """A result as the store takes it, with the adopted effects that were offered to it."""
    entry = traced.entry
    return replace(entry, result={**entry.result, **adopted_json(traced)})


def make_ready(folder: Path) -> None:
    """Find out before anything is measured whether the store will take the result. Raises `JobError`."""
    try:
        store_to_write(folder).migrate()
        (folder / "reports").mkdir(exist_ok=True)
    except StoreError as error:
        raise JobError(Message("{error}; nothing was measured", error=error), Exit.STORAGE) from error
    except OSError as error:
        sentence = Message(
            "{folder}: cannot be made ({reason}); nothing was measured",
            folder=folder / "reports",
            reason=reason(error),
        )
        raise JobError(sentence, Exit.STORAGE) from error


def has_report(path: Path) -> bool:
    """Whether a report is there to its end."""
    return path.is_file() and path.read_bytes().rstrip().endswith(b"</html>")


def write_report(traced: Traced, path: Path, language: Language, chain: Chain[Any] | None = None) -> None:
    """Write the report in a language, with the experiments that closed the loop where there were any.

    Raises `JobError`.
    """
    reports.write(traced.report("", 1, chain, contradictions_of(traced)), path, language)


def report_record(
    traced: Traced, record: Record, folder: Path, path: Path, language: Language, chain: Chain[Any] | None = None
) -> None:
    """Write the report of a record in a language, and keep in its store what it says.

    `chain` are the experiments that closed the loop, if there were any. Raises `JobError`.
    """
    said = traced.report(record.id, record.revision, chain, contradictions_of(traced))
    report = of_record(said, record, folder)
    keep(report, record, folder)
    reports.write(report, path, language)


@dataclass(frozen=True, kw_only=True)
class Calibrated:
    """What the whole job leaves behind."""

    analysed: Traced
    record: Record
    recording: Path
    report: Path
    learned: Learned
    """What the run says of its stand."""
    doubts: tuple[str, ...]
    """What earlier records of the unit say otherwise of it."""


def calibrate(
    job: Job,
    connected: Connected,
    folder: Path,
    listeners: Sequence[Listener] = (),
    tell: Callable[[str], None] = lambda _: None,
    language: Language = Language.ENGLISH,
    effects: Path | None = None,
) -> Calibrated:
    """Run, fit, trace what is left, store, report: the whole job.

    Parameters
    ----------
    job
        Programme, unit and stand file.
    connected
        The instruments, and who seats the unit.
    folder
        Store: `recordings`, `reports` and `records.sqlite` lie in it.
    listeners
        Called with every event of the run.
    tell
        Called with a sentence when a stage begins.
    language
        Of the report.
    effects
        File or folder of adopted effects, in place of those of the store.

    Raises
    ------
    InputError, JobError
        What went wrong; the recording is kept whenever there is one.
    """
    return conclude(measure(job, connected, folder, listeners, effects), folder, tell, language, effects)


def measure(
    job: Job,
    connected: Connected,
    folder: Path,
    listeners: Sequence[Listener] = (),
    effects: Path | None = None,
) -> Path:
    """Run what is to be calibrated, and return its recording, which `conclude` takes; arguments as of `calibrate`.

    Raises
    ------
    InputError, JobError
        What went wrong; the recording is kept whenever there is one.
    """
    find_job(job.programme.method)
    job.plan()
    make_ready(folder)
    read_kept(effects or folder / FOLDER)  # what is broken is told before anything is measured
    recording = recording_path(folder, job.serial_number, job.programme.name, connected.stand.clock)
    outcome = run(job, connected, recording, listeners, "calibrate")
    if error := failure(outcome, recording):
        raise error
    return recording


def conclude(
    recording: Path,
    folder: Path,
    tell: Callable[[str], None] = lambda _: None,
    language: Language = Language.ENGLISH,
    effects: Path | None = None,
) -> Calibrated:
    """Fit a recording, trace what is left, store, report in a language: the job once the run is over.

    Adopted effects are those of the store, or those of the file or folder `effects`.

    Raises
    ------
    InputError, JobError
        What went wrong; the recording is kept.
    """
    tell("fitting")
    analysed = fit(with_what_is_known(read_measurement(recording), folder, effects), folder=folder)
    tell("tracing")
    traced = trace(analysed)
    return keep_result(traced, folder, tell, language)


def keep_result(
    traced: Traced,
    folder: Path,
    tell: Callable[[str], None] = lambda _: None,
    language: Language = Language.ENGLISH,
    chain: Chain[Any] | None = None,
) -> Calibrated:
    """Store a result and write its report in a language, with the experiments that closed the loop if there were any.

    Raises
    ------
    InputError, JobError
        What went wrong; the raw files are kept.
    """
    tell("storing")
    record, recording = store(traced, folder), traced.measurement.path
    learned = learn(traced, folder)
    tell("reporting")
    report = report_path(folder, record)
    try:
        report_record(traced, record, folder, report, language, chain)
    except JobError as error:
        raise JobError(
            Message(
                "{error}; record {record} of {recording} is stored", error=error, record=record.id, recording=recording
            ),
            error.status,
        ) from error
    doubts = other_lots(folder, record)
    return Calibrated(
        analysed=traced, record=record, recording=recording, report=report, learned=learned, doubts=doubts
    )
