"""What the thread of the stand can be asked to do, as values: each is handed a connected stand and does one thing."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol

from tumble.app.running import Job, failure
from tumble.app.simulation import Past
from tumble.app.stand_lock import holding_recording
from tumble.app.wiring import Connected
from tumble.procedures.announcer import Listener
from tumble.procedures.progress import Progress
from tumble.window.look.language import spoken

if TYPE_CHECKING:  # the analysis and the store take half a second: a window is up before that
    from tumble.app.calibrating import Calibrated
    from tumble.app.resuming import Unfinished

Tell = Callable[[str], None]
PREPARING: Final = "preparing"
"""The stage before a run in which what is there already is analysed."""


class Activity(Protocol):
    """A run, from its first step to what is made of it."""

    @property
    def job(self) -> Job:
        """Programme, unit and stand file."""
        ...

    @property
    def points_done(self) -> int:
        """Points that are there before it begins."""
        ...

    @property
    def past(self) -> Sequence[Past]:
        """What a simulated stand must have lived through before; nothing where the run begins anew."""
        ...

    def carry_out(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> "Concluded":
        """Do it. Raises `InputError`, `JobError`; the head stands when this returns or raises."""
        ...


@dataclass(frozen=True, kw_only=True)
class Concluded:
    """What a run and its analysis left behind."""

    method: str
    """Name of the method, which is shown by its part of the window."""
    traced: Any
    """What its analysis gave, which its part of the window shows; without one, a `generic.presenting.Analysed`."""
    recordings: tuple[Path, ...]
    record_id: str = ""
    """Empty where nothing was stored."""
    report: Path | None = None


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """A whole calibration: run, fit, trace, store, report."""

    job: Job
    store: Path
    points_done: int = 0
    past: Sequence[Past] = ()

    def carry_out(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> Concluded:
        """Do it."""
        from tumble.app.calibrating import calibrate

        return _stored(self.job, calibrate(self.job, connected, self.store, listeners, tell, spoken()))


@dataclass(frozen=True, kw_only=True)
class Resumption:
    """A run that was cut off: what is left of it, and what was to follow."""

    unfinished: "Unfinished"
    job: Job
    store: Path

    @property
    def points_done(self) -> int:
        """Points in the recording."""
        return len(self.unfinished.recording.points)

    @property
    def past(self) -> Sequence[Past]:
        """The runs before it, and this one up to the break."""
        from tumble.app.resuming import lived_through
        from tumble.app.same_stand import followed

        recording = self.unfinished.recording
        return lived_through(followed(recording), self.job.stand, recording)

    def carry_out(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> Concluded:
        """Do it."""
        from tumble.app.calibrating import conclude, make_ready
        from tumble.app.resuming import resume

        make_ready(self.store)
        path = self.unfinished.path
        with holding_recording(path, self.job.serial_number):
            outcome = resume(self.unfinished, self.job, connected, listeners)
        if error := failure(outcome, path):
            raise error
        return _stored(self.job, conclude(path, self.store, tell, spoken()))


@dataclass(frozen=True, kw_only=True)
class FurtherExperiment:
    """An experiment that the closed loop asked for, the loop closed again with it, and what both say stored."""

    job: Job
    store: Path
    before: tuple[Path, ...]
    """Recordings and tables of the unit so far."""
    points_done: int = 0
    past: Sequence[Past] = ()

    def carry_out(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> Concluded:
        """Do it."""
        from tumble.app.acting import AtStand, prepare, run_experiment
        from tumble.app.analysing import fit
        from tumble.app.calibrating import keep_result, make_ready
        from tumble.app.closing import begin, follow

        make_ready(self.store)
        tell(PREPARING)
        job, clock = self.job, connected.stand.clock
        at = AtStand(
            stand=job.stand,
            connected=connected,
            serial_number=job.serial_number,
            folder=self.store,
            operator=job.operator,
        )
        closing, began_s = begin(self.before, at), clock.monotonic_s()
        asked = next(each for each in closing.planned if each.programme == job.programme.name)
        offer = closing.available.offer(asked.programme)
        prepare(at, offer, connected.control.stop_wanted)
        recording = run_experiment(at, offer, listeners)
        tell("tracing")
        closing = follow(closing, asked, recording, clock.monotonic_s() - began_s, at)
        refitted = closing.traced.refitted(fit(closing.traced.measurement, job.serial_number, folder=self.store))
        done = keep_result(refitted, self.store, tell, spoken(), closing.chain)
        return _stored(job, done, closing.files)


def progress_of(activity: Activity, connected: Connected) -> Progress:
    """What counts the steps of a run."""
    return Progress(activity.job.plan(), connected.stand.clock, activity.points_done)


def _stored(job: Job, done: "Calibrated", recordings: tuple[Path, ...] = ()) -> Concluded:
    """What was kept of one recording, or of several together."""
    return Concluded(
        method=job.programme.method,
        traced=done.analysed,
        recordings=recordings or (done.recording,),
        record_id=done.record.id,
        report=done.report,
    )
