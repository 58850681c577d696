"""Runs a programme on a stand and leaves a recording."""

import math
import os
import signal
import stat
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from datetime import UTC, datetime
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, Final

from tumble.app.exits import Exit, JobError
from tumble.app.identity import program_identity
from tumble.app.signals import handled_by
from tumble.app.stand import LoadedStand, WrittenStand
from tumble.app.stand_lock import holding_recording
from tumble.app.terminal import lead_nowhere
from tumble.app.wiring import Connected
from tumble.drivers.clock import Clock
from tumble.drivers.errors import Interrupted
from tumble.messages import Message
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.announcer import Announcer, Listener
from tumble.procedures.engine import Engine
from tumble.procedures.errors import ProgrammeError
from tumble.procedures.events import FinishReason, State, WarningRaised
from tumble.procedures.outcome import Outcome
from tumble.procedures.plan import REQUEST_S, Plan, plan
from tumble.procedures.plan_checks import (
    check_cable,
    check_condition,
    check_excitations,
    check_limits,
    check_temperatures,
)
from tumble.procedures.programme import Programme
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.header import Header, written_version
from tumble.procedures.registry import find_method
from tumble.procedures.replay import replay
from tumble.procedures.second_look import ReadAgain, SecondLook
from tumble.procedures.steps import Point
from tumble.system_errors import reason

if TYPE_CHECKING:
    from tumble.procedures.recording.contents import Said
    from tumble.procedures.recording.writer import Recorder

FINISHED: Final = {
    FinishReason.COMPLETED: Exit.GOOD,
    FinishReason.STOPPED: Exit.STOPPED,
    FinishReason.UNANSWERED: Exit.BAD_INPUT,
    FinishReason.DEVICE_FAULT: Exit.DEVICE_FAULT,
    FinishReason.STORAGE: Exit.STORAGE,
    FinishReason.INTERNAL: Exit.INTERNAL,
}
"""Exit status of a run by the reason why it ended."""


@dataclass(frozen=True, kw_only=True)
class Outline:
    """A programme at a stand: what can be said of it before anything is run."""

    stand: WrittenStand
    programme: Programme

    @property
    def acquisition(self) -> Acquisition:
        """How each dwell is taken."""
        sampler = self.stand.file.sampling
        return self.programme.acquisition(samples=sampler.samples, rate_hz=sampler.rate_hz)

    def plan(self) -> Plan:
        """Every step with its time; refuses what head, cable or seat forbid. Raises `ProgrammeError`."""
        self._check_stand()
        positioners = self.stand.file.positioners
        speeds_deg_s = {name: table.speed_deg_s for name, table in positioners.items()}
        request_s = max((table.mounting_s for table in positioners.values()), default=REQUEST_S)
        exciters = self.stand.file.exciters
        setting_s = {name: 2.0 * table.ramp_s for name, table in exciters.items()}
        planned = plan(
            self.programme,
            self.acquisition,
            speeds_deg_s=speeds_deg_s,
            request_s=request_s,
            setting_s=setting_s,
        )
        for name, table in positioners.items():
            for condition, allowed in table.allowed.items():
                check_condition(planned, condition, allowed)
            check_limits(planned, name, table.limits_deg)
            check_cable(planned, name, table.turns)
        for name, chamber in self.stand.file.environments.items():
            check_temperatures(planned, name, chamber.limits_degc)
        for name, exciter in exciters.items():
            check_excitations(planned, name, exciter.refusal_of)
        return planned

    def _check_stand(self) -> None:
        """Make sure that the stand file says what the method needs of it. Raises `ProgrammeError`."""
        try:
            find_method(self.programme.method).procedure_part.demand(self.stand.recorded)
        except ValueError as error:
            place = self.stand.path or Message("the built-in stand")
            raise ProgrammeError(Message("{place}: {error}", place=place, error=error)) from error


@dataclass(frozen=True, kw_only=True)
class Job(Outline):
    """What is to be measured."""

    stand: LoadedStand
    serial_number: str
    lot: str = ""
    """In which the unit was made."""
    operator: str = ""

    def check(self, points: Iterable[Point]) -> None:
        """Make sure that recorded points are the beginning of the programme. Raises `JournalError`."""
        tolerance_deg = math.inf if self.stand.file.by_hand else self.acquisition.position_tolerance_deg
        replay(self.programme.procedure(), points, tolerance_deg)


def run(
    job: Job, connected: Connected, recording: Path, listeners: Sequence[Listener] = (), purpose: str = "run"
) -> Outcome:
    """Carry out the programme; `STOPPING_SIGNALS` stop it at a safe standstill.

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
    purpose
        What the recording is made for: `run` or `calibrate`; a resumed run goes on to that.

    Raises
    ------
    InputError
        The programme does not fit the stand; nothing has moved.
    JobError
        The recording cannot be created, and nothing has moved; or it cannot be closed after the run.
    """
    job.plan()
    header = replace(_header(job, connected.stand.clock, purpose), follows=[str(path) for path in connected.ran])
    with holding_recording(recording, job.serial_number):
        recorder = begin_recording(recording, header, connected.stand.clock)
        connected.ran.append(recording.resolve())
        with recorder:
            return carry_out(lambda engine: engine.run(job.programme.procedure), job, connected, recorder, listeners)


def begin_recording(
    path: Path, header: Header, clock: Clock, before: "Iterable[Said]" = (), elsewhen_s: float = 0.0
) -> "Recorder":
    """Create a recording, see `Recorder`. Raises `JobError`."""
    from tumble.procedures.recording.writer import Recorder  # the MCAP library takes 0.1 s

    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        return Recorder(path, header, clock, before, elsewhen_s)
    except (OSError, RecordingError) as error:
        raise JobError(_storage_sentence(path, error), Exit.STORAGE) from error


def carry_out(
    action: Callable[[Engine], Outcome],
    job: Job,
    connected: Connected,
    recorder: "Recorder",
    listeners: Sequence[Listener],
) -> Outcome:
    """Have an engine do something while signals stop it, and close the recording. Raises `JobError`."""
    try:
        with connected.hears(connected.control, recorder.path) as hears:
            heard = [*connected.listeners, hears, *listeners]
            engine = Engine(
                connected.stand,
                connected.operator,
                recorder,
                job.acquisition,
                heard,
                _second_look(job, connected),
                control=connected.control,
                look=connected.look,
            )
            with _stopping_on_signals(engine), recorder:
                _warn_of_what_is_due(job, connected.stand.clock, Announcer(recorder, heard))
                return action(engine)
    except RecordingError as error:  # from closing it: what fails during the run is in the outcome
        raise JobError(Message("{error}; its complete points can be read", error=error), Exit.STORAGE) from error


def _second_look(job: Job, connected: Connected) -> SecondLook | None:
    """Whoever reads positioners by eye, asked again where the method of the programme doubts a reading."""
    if not connected.eyepieces:
        return None
    return ReadAgain(connected.eyepieces, find_method(job.programme.method).procedure_part.contradicted)


def _warn_of_what_is_due(job: Job, clock: Clock, announcer: Announcer) -> None:
    """Have recording and display say which calibrations are overdue, by the day of the stand's clock, UTC."""
    today = datetime.fromtimestamp(clock.wall_ns() / 1e9, tz=UTC).date()
    for sentence in job.stand.file.expired(today):
        announcer.announce(WarningRaised(message=sentence))


def failure(outcome: Outcome, recording: Path) -> JobError | None:
    """The error of a run that was not completed: what happened, what was kept, what to do; None after a whole run.

    Its cause is what ended the run.
    """
    status = FINISHED[outcome.reason]
    if status is Exit.GOOD:
        return None
    kept = Message.counted(
        "{happened}; {count} complete point kept in {recording}",
        "{happened}; {count} complete points kept in {recording}",
        count=len(outcome.points),
        happened=outcome.message,
        recording=recording,
    )
    if status is Exit.STOPPED:  # all others say what to do first
        kept = Message("{kept}; tumble resume goes on", kept=kept)
    error = JobError(kept, status)
    error.__cause__ = outcome.error
    return error


def _header(job: Job, clock: Clock, purpose: str) -> Header:
    program = program_identity()
    return Header(
        serial_number=job.serial_number,
        lot=job.lot,
        operator=job.operator,
        programme_text=job.programme.text,
        programme_sha256=job.programme.sha256,
        method=job.programme.method,
        method_version=find_method(job.programme.method).version,
        format_version=written_version(job.programme.method),
        stand=job.stand.recorded,
        stand_path=str(job.stand.path.resolve()) if job.stand.path else "",
        stand_sha256=job.stand.sha256,
        stand_code_sha256=job.stand.code_sha256,
        program_version=program.version,
        git_commit=program.git_commit,
        git_dirty=program.git_dirty,
        packages=program.packages,
        started_wall_ns=clock.wall_ns(),
        started_monotonic_s=clock.monotonic_s(),
        job=purpose,
    )


def _storage_sentence(path: Path, error: Exception) -> str:
    if isinstance(error, RecordingError):
        return str(error)
    why = reason(error) if isinstance(error, OSError) else str(error)
    return Message("{path}: cannot be created ({reason}); choose another store, or make room", path=path, reason=why)


@contextmanager
def _stopping_on_signals(engine: Engine) -> Iterator[None]:
    """Have `STOPPING_SIGNALS` stop the run; a second SIGINT interrupts it at once, still to a standstill.

    Nothing interrupts what brings the head to rest and closes the recording, which takes seconds at most.
    """
    asked = False

    def stop(number: int, _frame: FrameType | None) -> None:
        nonlocal asked
        if asked and number == signal.SIGINT and engine.state not in (State.STOPPING, State.STANDSTILL):
            raise Interrupted(signal.Signals(number).name)
        asked = True
        engine.control.stop()
        _leave_lost_terminal()

    with handled_by(stop):
        yield


def _leave_lost_terminal() -> None:
    """Say nothing more to a terminal that was closed: every word would be an error."""
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):  # redirected to what is no file
            if stat.S_ISCHR(os.fstat(stream.fileno()).st_mode) and not stream.isatty():
                lead_nowhere(stream)
