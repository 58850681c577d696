"""Runs a programme on a stand and leaves a recording."""

import re
import signal
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from datetime import UTC, datetime
from hashlib import sha256
from pathlib import Path
from types import FrameType

from app.exits import FINISHED, Exit, JobError
from app.identity import program_identity
from app.stand import LoadedStand
from app.wiring import Connected
from drivers.clock import Clock
from procedures.announcer import Listener
from procedures.engine import Engine
from procedures.outcome import Outcome
from procedures.plan import Plan, check_limits, plan
from procedures.programme import Programme
from procedures.recording.errors import RecordingError
from procedures.recording.header import Header

_LONGEST_NAME = 60
_RESERVED = {"CON", "PRN", "AUX", "NUL", *(f"{port}{n}" for port in ("COM", "LPT") for n in range(1, 10))}
"""Names of devices on Windows."""


@dataclass(frozen=True, kw_only=True)
class Job:
    """What is to be measured."""

    stand: LoadedStand
    programme: Programme
    serial_number: str
    operator: str = ""

    def plan(self) -> Plan:
        """Every step with its time; refuses what the head's limits forbid. Raises `ProgrammeError`."""
        stand = self.stand.file
        acquisition = self.programme.acquisition(samples=stand.daq.samples, rate_hz=stand.daq.rate_hz)
        planned = plan(self.programme, acquisition, speed_deg_s=stand.head.speed_deg_s)
        check_limits(planned, stand.head.limits_deg)
        return planned


def run(job: Job, connected: Connected, recording: Path, listeners: Sequence[Listener] = ()) -> Outcome:
    """Carry out the programme; SIGINT and SIGTERM stop it at a safe standstill.

    Parameters
    ----------
    job
        Programme, unit and stand file.
    connected
        The instruments, and who seats the unit.
    recording
        File to write; must not exist.
    listeners
        Called with every event.

    Raises
    ------
    InputError
        The programme does not fit the stand; nothing has moved.
    JobError
        The recording cannot be created, and nothing has moved; or it cannot be closed after the run.
    """
    from procedures.recording.writer import Recorder  # the MCAP library takes 0.1 s

    job.plan()
    daq = job.stand.file.daq
    stand = connected.stand
    try:
        recording.parent.mkdir(parents=True, exist_ok=True)
        recorder = Recorder(recording, _header(job, stand.clock), stand.clock)
    except (OSError, RecordingError) as error:
        raise JobError(_storage_sentence(recording, error), Exit.STORAGE) from error
    acquisition = job.programme.acquisition(samples=daq.samples, rate_hz=daq.rate_hz)
    engine = Engine(stand, connected.operator, recorder, acquisition, [*connected.listeners, *listeners])
    try:
        with recorder, _stopping_on_signals(engine):
            return engine.run(job.programme.procedure())
    except RecordingError as error:  # from closing it: what fails during the run is in the outcome
        raise JobError(f"{error}; its complete points can be read", Exit.STORAGE) from error


def failure(outcome: Outcome, recording: Path) -> JobError | None:
    """The error of a run that was not completed: what happened, what was kept, what to do; None after a whole run."""
    status = FINISHED[outcome.reason]
    if status is Exit.GOOD:
        return None
    kept = len(outcome.points)
    points = f"{kept} complete point{'s' if kept != 1 else ''} kept in {recording}"
    return JobError(f"{outcome.message}; {points}", status)


def recording_path(folder: Path, serial_number: str, programme: str, clock: Clock) -> Path:
    """Where a run of a unit is recorded: `recordings/SERIAL/UTC-programme.mcap`, a name that sorts by time."""
    moment = datetime.fromtimestamp(clock.wall_ns() / 1e9, tz=UTC).strftime("%Y%m%dT%H%M%SZ")
    name = f"{moment}-{_safe(programme)}"
    path = folder / "recordings" / _safe(serial_number) / f"{name}.mcap"
    number = 1
    while path.exists():
        number += 1
        path = path.with_name(f"{name}-{number}.mcap")
    return path


def _safe(text: str) -> str:
    """Text as a file name on any system: what had to be changed gets a hash, so that no two texts share a name."""
    plain = re.sub(r"[^A-Za-z0-9._-]+", "_", text).strip("._")[:_LONGEST_NAME]
    if plain == text and plain.split(".")[0].upper() not in _RESERVED:
        return plain
    return f"{plain or 'unit'}-{sha256(text.encode()).hexdigest()[:8]}"


def _header(job: Job, clock: Clock) -> Header:
    program = program_identity()
    return Header(
        serial_number=job.serial_number,
        operator=job.operator,
        programme_text=job.programme.text,
        programme_sha256=job.programme.sha256,
        stand=job.stand.recorded,
        stand_path=str(job.stand.path.resolve()) if job.stand.path else "",
        stand_sha256=job.stand.sha256,
        program_version=program.version,
        git_commit=program.git_commit,
        git_dirty=program.git_dirty,
        packages=program.packages,
        started_wall_ns=clock.wall_ns(),
        started_monotonic_s=clock.monotonic_s(),
    )


def _storage_sentence(path: Path, error: Exception) -> str:
    if isinstance(error, RecordingError):
        return str(error)
    reason = error.strerror if isinstance(error, OSError) else str(error)
    return f"{path}: cannot be created ({reason}); choose another --store or make room"


@contextmanager
def _stopping_on_signals(engine: Engine) -> Iterator[None]:
    """Have SIGINT and SIGTERM stop the run; a second SIGINT interrupts it at once, still to a standstill."""
    asked = False

    def stop(number: int, _frame: FrameType | None) -> None:
        nonlocal asked
        if asked and number == signal.SIGINT:
            raise KeyboardInterrupt
        asked = True
        engine.control.stop()

    try:
        previous = {number: signal.signal(number, stop) for number in (signal.SIGINT, signal.SIGTERM)}
    except ValueError:  # not the main thread: whoever runs it there handles signals
        previous = {}
    try:
        yield
    finally:
        for number, handler in previous.items():
            signal.signal(number, handler)
