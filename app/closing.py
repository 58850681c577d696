"""The loop acts: it runs the experiment that tells most for its time, fits everything together, and asks again.

`begin` and `follow` say what is known by now, and what to run next; `tumble.app.acting` runs it.
`act` is the whole loop.
"""

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import dataclass, replace
from pathlib import Path

from tumble.app.acting import AtStand, DeclinedError, prepare, run_experiment
from tumble.app.adopted_effects import with_what_is_known
from tumble.app.analysed import Traced
from tumble.app.analysing import fit
from tumble.app.available import Available
from tumble.app.job_part import Renewing
from tumble.app.jobs import find_job
from tumble.app.joining import read_together
from tumble.app.measurement import Measurement
from tumble.app.measurements import read_measurement
from tumble.app.running import Job
from tumble.calibrations.core.sentences import series
from tumble.calibrations.tracing.chain import FUTILE, Chain, Ended
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.link import Link
from tumble.calibrations.tracing.next_run import cannot, cheapest, experiments_for
from tumble.calibrations.tracing.stage import ClosedLoop, stage_of
from tumble.messages import AsWritten, Message
from tumble.procedures.announcer import Listener
from tumble.procedures.errors import InputError

MOST_EXPERIMENTS = 6


@dataclass(frozen=True, kw_only=True)
class Closing:
    """A loop that is being closed on one unit: what was measured, what that says, what could be run next."""

    files: tuple[Path, ...]
    traced: Traced
    chain: Chain[ClosedLoop]
    available: Available
    planned: tuple[Experiment, ...]
    """What would tell apart the rivals that are left, of what is available."""
    declined: str = ""
    """What the operator would not do, where that is why it was planned anew."""

    @property
    def next(self) -> Experiment | None:
        """What is worth most for its time; None where nothing is left to be told, or nothing available tells it."""
        return cheapest(self.planned)

    def planned_with(self, left: Available, declined: str = "") -> "Closing":
        """The same with what is available by now."""
        planned = experiments_for(self.traced.explained, left.probes, doubted=self.chain.doubted)
        traced = self.traced.planned(planned)
        return replace(self, available=left, planned=planned, traced=traced, declined=declined)


def begin(files: Sequence[Path], at: AtStand) -> Closing:
    """What was measured so far says: a first measurement, and experiments in the order in which they were run.

    What is no experiment that the files before it asked for is part of the first measurement. Raises `InputError`.
    """
    first, *others = map(read_measurement, files)
    experiments = find_job(first.method).experiments
    asked = [_programme_name(each) in experiments for each in others]
    plain = 1 + asked.index(True) if True in asked else len(files)
    closing = _begun(files[:plain], at)  # nothing before the first experiment decides anything by itself
    for path in files[plain:]:
        measurement = read_measurement(path)
        name = _programme_name(measurement)
        asked_for = next((each for each in closing.planned if each.programme == name), None)
        if asked_for is None:
            closing = _begun((*closing.files, path), at)
        else:
            times_s = measurement.observations.time_s
            took_s = float(times_s[-1]) if times_s is not None else asked_for.stand_time_s
            closing = follow(closing, asked_for, path, took_s, at)
    return closing


def _programme_name(measurement: Measurement) -> str:
    return measurement.programme.name if measurement.programme else ""


def _begun(files: Sequence[Path], at: AtStand) -> Closing:
    """What a first measurement says; several files are taken together."""
    measurement = _taken_together(files, at)
    if measurement.header and measurement.header.serial_number != at.serial_number:
        raise InputError(
            Message(
                "{path}: holds unit {serial_number}, and {wanted} is to be measured; give files of that "
                "unit, or its --serial",
                path=measurement.path,
                serial_number=AsWritten(measurement.header.serial_number),
                wanted=AsWritten(at.serial_number),
            )
        )
    part = find_job(measurement.method)
    found = part.available(at.stand, measurement.observations, at.connected.attended)
    traced = _traced(measurement, at)
    planned = experiments_for(traced.explained, found.probes)
    return Closing(
        files=tuple(files),
        traced=traced.planned(planned),
        chain=Chain(first=stage_of(traced.loop, traced.explained)),
        available=found,
        planned=planned,
    )


def follow(closing: Closing, experiment: Experiment, recording: Path, stand_time_s: float, at: AtStand) -> Closing:
    """What everything says together once an experiment was run. Raises `InputError`."""
    files = (*closing.files, recording)
    measurement = _taken_together(files, at)
    traced = _traced(measurement, at)
    link = Link(
        experiment=experiment,
        recording=str(recording),
        stand_time_s=stand_time_s,
        before=closing.chain.last,
        after=stage_of(traced.loop, traced.explained, closing.chain.last.behind),
    )
    chain = replace(closing.chain, links=(*closing.chain.links, link))
    grown = replace(closing, files=files, traced=traced, chain=chain)
    left = closing.available
    if link.futile:
        left = left.without(
            lambda each: each.programme.name == experiment.programme, Message("it told nothing when it was run")
        )
    part = find_job(measurement.method)
    return grown.planned_with(part.renewed(left, measurement.observations) if isinstance(part, Renewing) else left)


def act(
    closing: Closing,
    at: AtStand,
    most: int = MOST_EXPERIMENTS,
    watching: Callable[[Job], AbstractContextManager[Listener]] = lambda _: nullcontext(lambda _: None),
    tell: Callable[[Closing], None] = lambda _: None,
) -> Closing:
    """Run experiments until the rivals are told apart, or until it is clear that they will not be, and why.

    Parameters
    ----------
    closing
        The first measurement, with what it says.
    at
        Where it goes on.
    most
        Experiments that are run at most.
    watching
        Gives for every run a listener.
    tell
        Called before every experiment, and at the end.

    Raises
    ------
    InputError, JobError
        What went wrong; every recording is kept, and `begin` with them goes on.
    """
    while not (closing := _ended(closing, most)).chain.ended:
        tell(closing)
        closing = _once(closing, at, watching)
    tell(closing)
    return closing


def _once(closing: Closing, at: AtStand, watching: Callable[[Job], AbstractContextManager[Listener]]) -> Closing:
    """Run the next experiment, or plan without what the operator declines."""
    experiment = closing.next
    assert experiment is not None, "_ended sees to that"
    offer, clock = closing.available.offer(experiment.programme), at.connected.stand.clock
    began_s = clock.monotonic_s()
    try:
        prepare(at, offer)
        with watching(at.job(offer.programme)) as listener:
            recording = run_experiment(at, offer, [listener])
    except DeclinedError as refusal:
        left = closing.available.without(refusal.concerns, str(refusal))
        return closing.planned_with(left, declined=str(refusal))
    return follow(closing, experiment, recording, clock.monotonic_s() - began_s, at)


def _ended(closing: Closing, most: int) -> Closing:
    """The loop with the reason why it ends here, where it does."""
    ended, why = _verdict(closing, most)
    if ended is None:
        return closing
    done = closing if closing.chain.last.disputed else _without_confirming(closing)
    return replace(done, chain=replace(closing.chain, ended=ended, why=why))


def _without_confirming(closing: Closing) -> Closing:
    """What is told apart asks for nothing more, though it was barely so."""
    planned = experiments_for(closing.traced.explained, closing.available.probes)
    return replace(closing, planned=planned, traced=closing.traced.planned(planned))


def _verdict(closing: Closing, most: int) -> tuple[Ended | None, str]:
    chain = closing.chain
    if not chain.last.disputed:
        return _nothing_disputed(closing, most)
    if closing.next is None:
        return Ended.NOTHING_AVAILABLE, cannot(closing.planned, _elsewhere(closing))
    if why := _in_vain(chain):
        return Ended.NOT_AS_PROMISED, why
    if len(chain.links) >= most:
        return Ended.ENOUGH, Message.counted(
            "{count} experiment was to be run at most; the next would be {programme}.",
            "{count} experiments were to be run at most; the next would be {programme}.",
            count=most,
            programme=closing.next.programme,
        )
    return None, ""


def _nothing_disputed(closing: Closing, most: int) -> tuple[Ended | None, str]:
    """Where nothing has a rival, only what is barely so is asked once more."""
    if not closing.chain.first.disputed:
        return Ended.NOTHING_TO_TELL, Message("Nothing has to be told apart.")
    if closing.next is None or len(closing.chain.links) >= most:
        return Ended.TOLD_APART, Message("Everything that was found is told apart.")
    return None, ""


def _in_vain(chain: Chain[ClosedLoop]) -> str:
    """Why no further experiment is worth its time, where those that were run told nothing; else empty."""
    if chain.futile >= FUTILE:
        return Message.counted(
            "{count} experiment told nothing apart, though it was to: nothing here tells {left}.",
            "{count} experiments in a row told nothing apart, though each was to: nothing here tells {left}.",
            count=chain.futile,
            left=_left(chain),
        )
    if chain.unkept:
        return Message.counted(
            "{count} experiment told nothing apart, though with those before it was to: nothing here tells {left}.",
            "{count} experiments in a row told nothing apart, though together they were to: nothing here tells {left}.",
            count=len(chain.in_vain),
            left=_left(chain),
        )
    return ""


def _left(chain: Chain[ClosedLoop]) -> Message:
    """What is not told apart."""
    return Message.joined(
        "; ",
        (
            Message("{first} from {others}", first=first, others=series(others, "or"))
            for first, *others in chain.last.disputed
        ),
    )


def _elsewhere(closing: Closing) -> dict[str, tuple[Experiment, str]]:
    """What would help if it could be run, and why it cannot."""
    refused = closing.available.refused
    wanted = experiments_for(closing.traced.explained, [offer.probe for offer, _ in refused.values()])
    return {each.programme: (each, refused[each.programme][1]) for each in wanted if each.command}


def _taken_together(files: Sequence[Path], at: AtStand) -> Measurement:
    measurement = with_what_is_known(read_together(files, at.stand.recorded), at.folder, at.effects)
    return measurement.of_lot(at.lot)


def _traced(measurement: Measurement, at: AtStand) -> Traced:
    """The loop closed on what was measured so far."""
    analysed = fit(measurement, at.serial_number, trials=0, folder=at.folder)
    return find_job(measurement.method).trace(analysed)
