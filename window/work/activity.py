"""What the thread of the stand can be asked to do, as values: each is handed a connected stand and does one thing."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final, Protocol, TypeAlias

from tumble.app.running import Job, failure
from tumble.app.simulation import Past
from tumble.app.stand_lock import holding_recording
from tumble.app.wiring import Connected
from tumble.calibrations.core.verdict import Outcome
from tumble.procedures.announcer import Listener
from tumble.procedures.progress import Progress
from tumble.window.look.language import spoken

if TYPE_CHECKING:  # the analysis and the store take half a second: a window is up before that
    from tumble.app.calibrating import Calibrated
    from tumble.app.closing import Closing
    from tumble.app.resuming import Unfinished

Tell = Callable[[str], None]
PREPARING: Final = "preparing"
"""The stage before a run in which what is there already is analysed."""


class Activity(Protocol):
    """A run, and what is to be made of it."""

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

    def measure(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> "Conclusion":
        """Do what needs the stand. Raises `InputError`, `JobError`; the head stands when this returns or raises."""
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

    @property
    def outcome(self) -> Outcome:
        """Of the verdict."""
        outcome: Outcome = self.traced.verdict.outcome
        return outcome


Conclusion: TypeAlias = Callable[[Tell], Concluded]
"""Analyses and stores what was measured, and tells the stages of it; no stand has to wait for that.

Raises `InputError`, `JobError`; the recording is kept.
"""


@dataclass(frozen=True, kw_only=True)
class Calibration:
    """A whole calibration: run, fit, trace, store, report."""

    job: Job
    store: Path
    points_done: int = 0
    past: Sequence[Past] = ()

    def measure(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> Conclusion:  # noqa: ARG002
        """Run the programme."""
        from tumble.app.calibrating import measure

        return partial(_conclude, self.job, self.store, measure(self.job, connected, self.store, listeners))


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

    def measure(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> Conclusion:  # noqa: ARG002
        """Run what is left of the programme."""
        from tumble.app.calibrating import make_ready
        from tumble.app.resuming import resume

        make_ready(self.store)
        path = self.unfinished.path
        with holding_recording(path, self.job.serial_number):
            outcome = resume(self.unfinished, self.job, connected, listeners)
        if error := failure(outcome, path):
            raise error
        return partial(_conclude, self.job, self.store, path)


@dataclass(frozen=True, kw_only=True)
class FurtherExperiment:
    """An experiment that the closed loop asked for, the loop closed again with it, and what both say stored."""

    job: Job
    store: Path
    before: tuple[Path, ...]
    """Recordings and tables of the unit so far."""
    points_done: int = 0
    past: Sequence[Past] = ()

    def measure(self, connected: Connected, listeners: Sequence[Listener], tell: Tell) -> Conclusion:
        """Find out what the experiment needs, and run it."""
        from tumble.app.acting import AtStand, prepare, run_experiment
        from tumble.app.calibrating import make_ready
        from tumble.app.closing import begin, follow

        make_ready(self.store)
        tell(PREPARING)
        job, clock = self.job, connected.stand.clock
        at = AtStand(
            stand=job.stand,
            connected=connected,
            serial_number=job.serial_number,
            folder=self.store,
            lot=job.lot,
            operator=job.operator,
        )
        closing, began_s = begin(self.before, at), clock.monotonic_s()
        asked = next(each for each in closing.planned if each.programme == job.programme.name)
        offer = closing.available.offer(asked.programme)
        prepare(at, offer, connected.control.stop_wanted)
        recording = run_experiment(at, offer, listeners)
        took_s = clock.monotonic_s() - began_s
        return partial(_close_again, lambda: follow(closing, asked, recording, took_s, at), job, self.store)


def progress_of(activity: Activity, connected: Connected) -> Progress:
    """What counts the steps of a run."""
    return Progress(activity.job.plan(), connected.stand.clock, activity.points_done)


def _conclude(job: Job, store: Path, recording: Path, tell: Tell) -> Concluded:
    from tumble.app.calibrating import conclude

    return _stored(job, conclude(recording, store, tell, spoken()))


def _close_again(follow: "Callable[[], Closing]", job: Job, store: Path, tell: Tell) -> Concluded:
    """Close the loop with a further experiment, and store what all runs say together."""
    from tumble.app.analysing import fit
    from tumble.app.calibrating import keep_result

    tell("tracing")
    closing = follow()
    refitted = closing.traced.refitted(fit(closing.traced.measurement, job.serial_number, folder=store))
    return _stored(job, keep_result(refitted, store, tell, spoken(), closing.chain), closing.files)


def _stored(job: Job, done: "Calibrated", recordings: tuple[Path, ...] = ()) -> Concluded:
    """What was kept of one recording, or of several together."""
    return Concluded(
        method=job.programme.method,
        traced=done.analysed,
        recordings=recordings or (done.recording,),
        record_id=done.record.id,
        report=done.report,
    )
