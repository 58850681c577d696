"""Carries out at a stand what the loop asks for: a first measurement, then experiments."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from tumble.app.available import Offer
from tumble.app.exits import Exit, JobError
from tumble.app.recording_names import recording_path
from tumble.app.running import Job, failure, run
from tumble.app.stand import LoadedStand
from tumble.app.wiring import Connected
from tumble.messages import Message
from tumble.procedures.announcer import Listener
from tumble.procedures.events import ConditionAnswered, Event
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Ask

_POLL_S = 0.5
_NO_TIME_S = 1e-6


class DeclinedError(Exception):
    """The operator will not do what an experiment needs: set `condition` to `value`."""

    def __init__(self, ask: Ask) -> None:
        super().__init__(Message("the operator does not {task}", task=ask.task))
        self.condition, self.value = ask.condition, ask.value

    def concerns(self, offer: Offer) -> bool:
        """Whether an experiment needs just that."""
        return offer.needs.get(self.condition) == self.value


@dataclass(frozen=True, kw_only=True)
class AtStand:
    """A unit at a connected stand, and where its recordings go.

    One connection serves all runs of a loop: a simulated world goes on from one to the next, as a real one does.
    """

    stand: LoadedStand
    connected: Connected
    serial_number: str
    folder: Path
    lot: str = ""
    operator: str = ""
    effects: Path | None = None
    """Adopted effects in place of those of the folder."""

    def job(self, programme: Programme) -> Job:
        """A run of the unit."""
        return Job(
            stand=self.stand,
            programme=programme,
            serial_number=self.serial_number,
            lot=self.lot,
            operator=self.operator,
        )


def measure(at: AtStand, programme: Programme, listeners: Sequence[Listener] = ()) -> Path:
    """Run a programme, and return its recording. Raises `InputError`, `JobError`."""
    recording = recording_path(at.folder, at.serial_number, programme.name, at.connected.stand.clock)
    outcome = run(at.job(programme), at.connected, recording, listeners)
    if error := failure(outcome, recording):
        raise error
    return recording


def prepare(at: AtStand, offer: Offer, stopped: Callable[[], bool] = lambda: False) -> None:
    """See to what must be before an experiment: what takes an operator, a warmer unit say, or time that has passed.

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
    if offer.preparation is not None:
        _have_done(at, offer.preparation, stopped)
    else:
        _wait(at, offer.wait_s, stopped)


def run_experiment(at: AtStand, offer: Offer, listeners: Sequence[Listener] = ()) -> Path:
    """Run an experiment that is prepared, and return its recording.

    Raises
    ------
    DeclinedError
        The operator said no to what it needs.
    InputError, JobError
        What went wrong; the recording is kept whenever there is one.
    """
    refusals: list[Ask] = []

    def listen(event: Event) -> None:
        if isinstance(event, ConditionAnswered) and event.answer and not event.confirmed:
            refusals.append(offer.programme.layout.ask(event.condition, event.value))

    try:
        return measure(at, offer.programme, (*listeners, listen))
    except JobError as error:
        if refusals:
            raise DeclinedError(refusals[0]) from error
        raise


def _have_done(at: AtStand, ask: Ask, stopped: Callable[[], bool]) -> None:
    """Ask the operator to do something. Raises `DeclinedError`."""
    operator = at.connected.operator
    operator.ask(ask)
    while (answer := operator.poll()) is None:
        _wait(at, _POLL_S, stopped)
    if not answer.confirmed:
        raise DeclinedError(ask)


def _wait(at: AtStand, duration_s: float, stopped: Callable[[], bool]) -> None:
    """Let time pass, at a standstill. Raises `JobError` where somebody stops it."""
    clock = at.connected.stand.clock
    end_s = clock.monotonic_s() + duration_s
    while (left_s := end_s - clock.monotonic_s()) > _NO_TIME_S:
        if stopped():
            raise JobError(Message("stopped while waiting; nothing moved"), Exit.STOPPED)
        clock.sleep(min(left_s, _POLL_S))
