"""Carries out at a stand what the loop asks for: a first measurement, then experiments."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from tumble.app.available import programme_of
from tumble.app.exits import Exit, JobError
from tumble.app.running import Job, failure, recording_path, run
from tumble.app.stand import LoadedStand
from tumble.app.wiring import Connected
from tumble.calibrations.methods.dividing_head.probes import Probe
from tumble.procedures.announcer import Listener
from tumble.procedures.events import ConditionAnswered, Event
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Ask

_POLL_S = 0.5
_NO_TIME_S = 1e-6
_WARM_PROMPT = (
    "Bring the unit to a temperature about {:g} K higher than before and let it settle there; answer yes when it has, "
    "or no if that cannot be done."
)


class DeclinedError(Exception):
    """The operator will not seat the unit in `mount`, or will not warm it where that is empty."""

    def __init__(self, message: str, mount: str = "") -> None:
        super().__init__(message)
        self.mount = mount


@dataclass(frozen=True, kw_only=True)
class AtStand:
    """A unit at a connected stand, and where its recordings go.

    One connection serves all runs of a loop: a simulated world goes on from one to the next, as a real one does.
    """

    stand: LoadedStand
    connected: Connected
    serial_number: str
    folder: Path
    operator: str = ""

    def job(self, programme: Programme) -> Job:
        """A run of the unit."""
        return Job(stand=self.stand, programme=programme, serial_number=self.serial_number, operator=self.operator)


def measure(at: AtStand, programme: Programme, listeners: Sequence[Listener] = ()) -> Path:
    """Run a programme, and return its recording. Raises `InputError`, `JobError`."""
    recording = recording_path(at.folder, at.serial_number, programme.name, at.connected.stand.clock)
    outcome = run(at.job(programme), at.connected, recording, listeners)
    if error := failure(outcome, recording):
        raise error
    return recording


def prepare(at: AtStand, probe: Probe, stopped: Callable[[], bool] = lambda: False) -> None:
    """See to what must be before an experiment: a warmer unit, which takes an operator, or time that has passed.

    Parameters
    ----------
    stopped
        Asked all the time.

    Raises
    ------
    DeclinedError
        The operator said no.
    JobError
        Somebody stopped it; nothing has moved.
    """
    if probe.warmer_k:
        _have_warmed(at, probe.warmer_k, stopped)
    else:
        _wait(at, probe.wait_s, stopped)


def run_experiment(at: AtStand, probe: Probe, listeners: Sequence[Listener] = ()) -> Path:
    """Run an experiment that is prepared, and return its recording.

    Raises
    ------
    DeclinedError
        The operator said no to its mount.
    InputError, JobError
        What went wrong; the recording is kept whenever there is one.
    """
    refusals: list[str] = []

    def listen(event: Event) -> None:
        if isinstance(event, ConditionAnswered) and event.answer and not event.confirmed:
            refusals.append(event.value)

    try:
        return measure(at, programme_of(probe), (*listeners, listen))
    except JobError as error:
        if refusals:
            raise DeclinedError(f"the operator does not seat the unit in {refusals[0]}", refusals[0]) from error
        raise


def _have_warmed(at: AtStand, warmer_k: float, stopped: Callable[[], bool]) -> None:
    """Ask the operator to warm the unit. Raises `DeclinedError`."""
    operator = at.connected.operator
    operator.ask(
        Ask(
            condition="temperature",
            value="warm",
            task="warm the unit",
            remedy="warm it",
            prompt=_WARM_PROMPT.format(warmer_k),
            hint="Type yes when the unit has settled, or no if it cannot be warmed.",
        )
    )
    while (answer := operator.poll()) is None:
        _wait(at, _POLL_S, stopped)
    if not answer.confirmed:
        raise DeclinedError("the operator does not warm the unit")


def _wait(at: AtStand, duration_s: float, stopped: Callable[[], bool]) -> None:
    """Let time pass, at a standstill. Raises `JobError` where somebody stops it."""
    clock = at.connected.stand.clock
    end_s = clock.monotonic_s() + duration_s
    while (left_s := end_s - clock.monotonic_s()) > _NO_TIME_S:
        if stopped():
            raise JobError("stopped while waiting; nothing moved", Exit.STOPPED)
        clock.sleep(min(left_s, _POLL_S))
