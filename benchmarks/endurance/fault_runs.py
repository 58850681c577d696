"""Faults at steps of runs on emulated stands, and what came of each."""

import math
import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Final

from benchmarks.endurance.emulated import EmulatedStand, Pair, emulated
from benchmarks.endurance.kills import points_said
from benchmarks.endurance.kinds import FOR_GOOD_S, KINDS, Kind, make_room
from benchmarks.endurance.moments import Moment, strike_at, take_time_to_answer
from tumble.app.exits import Exit, status_of
from tumble.app.resuming import find, resume
from tumble.app.running import failure, run
from tumble.app.signals import handled_by
from tumble.app.wiring import Connected
from tumble.calibrations.methods.dividing_head.questions import questioned
from tumble.drivers.errors import DeviceError
from tumble.procedures.events import Event, PointCompleted, State, StateChanged, WarningRaised
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.recording.reader import read_recording

SPEED: Final = 10.0
PROGRAMME: Final = """\
name = "faults"
settle_s = 0.1

[[procedure]]
kind = "sweep"
mount = "face-up-90"
step_deg = 40.0
points = 7

[[procedure]]
kind = "sweep"
mount = "face-up"
step_deg = 40.0
points = 7
"""
REMARK: Final = re.compile(r": \d+( \(the first: .*\))?$")
"""A number of things put right, which a run tells of some time after they were."""
_LINK_BACK_S: Final = 20.0
"""How much longer than the links were away for good, in real time."""


@dataclass(frozen=True, kw_only=True)
class Case:
    """One fault at one step."""

    kind: Kind
    moment: Moment
    pair: Pair
    speed: float = SPEED

    def __reduce__(self) -> tuple[object, ...]:
        """Kinds hold functions; another process looks its kind up by the name."""
        return case_named, (self.kind.name, self.moment, self.pair, self.speed)


def case_named(name: str, moment: Moment, pair: Pair, speed: float) -> Case:
    """A case by the name of its kind."""
    return Case(kind=next(kind for kind in KINDS if kind.name == name), moment=moment, pair=pair, speed=speed)


@dataclass(frozen=True, kw_only=True)
class Result:
    """What came of it."""

    status: Exit
    """Exit status of the run in which the fault happened."""
    sentences: tuple[str, ...]
    """What was said: how the run ended; where it went on, its warnings and what the analysis asks about its rows."""
    lost: int
    doubled: int
    standing: bool
    """Whether the head in the simulated world stands, whatever the run says of it."""
    read_back: bool
    """Whether its standstill was read back."""
    safe_s: float
    """From the fault to the standstill, or to the next completed point where the run went on, by the stand's clock."""
    resumed: bool | None = None
    """Whether the run, taken up again, has every point once; None where it had come to its end."""


@dataclass
class Watch:
    """A listener that notes when what happened."""

    stand: EmulatedStand
    struck_s: float | None = None
    """When the fault was put, by the stand's clock; it may take until the next command to happen."""
    completed_s: list[float] = field(default_factory=list)
    warned_s: list[float] = field(default_factory=list)
    standstill_s: float | None = None
    completed: list[int] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def __call__(self, event: Event) -> None:
        """Note an event."""
        if isinstance(event, PointCompleted):
            self.completed.append(event.point.index)
            self.completed_s.append(self.stand.clock.monotonic_s())
        elif isinstance(event, WarningRaised):
            self.warnings.append(event.message)
            if not REMARK.search(event.message):
                self.warned_s.append(self.stand.clock.monotonic_s())
        elif isinstance(event, StateChanged) and event.state is State.STANDSTILL:
            self.standstill_s = self.stand.clock.monotonic_s()

    def safe_s(self, ended_s: float, went_on: bool) -> float:
        """From the fault to the standstill; where the run went on, to the first point after it was said to be over."""
        happened = [time_s for time_s, _ in self.stand.faults.happened]
        began_s = happened[0] if happened else self.struck_s
        if began_s is None:
            return math.nan
        if not went_on:
            return (self.standstill_s or ended_s) - began_s
        over_s = max([began_s, *self.warned_s])
        return min([*(time_s for time_s in self.completed_s if time_s >= over_s), ended_s]) - began_s


def carried_out(case: Case, folder: Path, programme: str = PROGRAMME) -> Result:
    """Have one fault happen in a run of a programme."""
    with emulated(folder, case.pair, programme, case.speed) as stand:
        recording, watch = folder / "run.mcap", Watch(stand)
        status, said = _attempted(case, stand, watch, recording)
        ended_s = stand.clock.monotonic_s()
        with stand.shared.lock:
            standing = not stand.shared.head.status().moving
        kept = Counter(point.index for point in points_said(recording)) if recording.exists() else Counter()
        whole, points = status is Exit.GOOD, stand.job.plan().dwells
        return Result(
            status=status,
            sentences=(*watch.warnings, *_asked(recording)) if whole else (said,),
            lost=sum(index not in kept for index in watch.completed) + (points - len(kept) if whole else 0),
            doubled=sum(count - 1 for count in kept.values()),
            standing=standing,
            read_back=watch.standstill_s is not None,
            safe_s=watch.safe_s(ended_s, whole),
            resumed=None if whole else _resumed(stand, recording),
        )


def _attempted(case: Case, stand: EmulatedStand, watch: Watch, recording: Path) -> tuple[Exit, str]:
    """Exit status of the run, and why it was stopped."""
    try:
        return _run(case, stand, watch, recording)
    except KeyboardInterrupt:  # after the run was over
        return Exit.STOPPED, "interrupted"
    except Exception as error:  # a fault of the program among them
        return status_of(error) or Exit.INTERNAL, str(error) or repr(error)
    finally:
        make_room()


def _run(case: Case, stand: EmulatedStand, watch: Watch, recording: Path) -> tuple[Exit, str]:
    connected = stand.connect()

    def strike() -> None:
        watch.struck_s = stand.clock.monotonic_s()
        case.kind.does(stand, recording)

    try:
        take_time_to_answer(connected)
        strike_at(case.moment, connected, case.kind.device, case.kind.early, strike)
        outcome = run(stand.job, connected, recording, [watch])
    finally:
        connected.links.close()
    error = failure(outcome, recording)
    return (error.status, str(error)) if error else (Exit.GOOD, "")


def _asked(recording: Path) -> tuple[str, ...]:
    """What the analysis asks about the rows, the mount of some of them above all."""
    return questioned(observations(read_recording(recording))).questions


def _resumed(stand: EmulatedStand, recording: Path) -> bool:
    """Take a run up again, as an operator would who has seen to the cause."""
    if not recording.exists():
        return False
    stand.clock.set_by_s = 0.0
    try:
        connected = reached(stand)
        try:
            outcome = resume(find(recording), stand.job, connected)
        finally:
            connected.links.close()
    except Exception as error:  # whatever it is, it was not resumed
        print(f"not resumed: {error}", file=sys.stderr)
        return False
    if error := failure(outcome, recording):
        print(f"not resumed: {error}", file=sys.stderr)
    indices = [point.index for point in points_said(recording)]
    return error is None and indices == list(range(stand.job.plan().dwells))


def reached(stand: EmulatedStand) -> Connected:
    """Connect the stand, once its links are back. Raises `DeviceError` where they stay away."""
    deadline_s = time.monotonic() + _LINK_BACK_S + FOR_GOOD_S / stand.speed
    while time.monotonic() < deadline_s:
        with suppress(DeviceError):
            return stand.connect()
        time.sleep(0.1)
    return stand.connect()


def of_case(case: Case, programme: str = PROGRAMME) -> Result:
    """Have one fault happen in a folder of its own. A signal that comes when the run is over already ends nothing."""
    with tempfile.TemporaryDirectory() as name, handled_by(lambda *_: None):
        return carried_out(case, Path(name), programme)


def of_cases(cases: Sequence[Case], processes: int, programme: str = PROGRAMME) -> dict[Case, Result]:
    """What came of each, in so many processes: a stand never waits for the interpreter of another.

    What happens to a whole process, a signal or a full disk, happens to one that has nothing else to do.
    """
    with ProcessPoolExecutor(processes, mp_context=get_context("spawn")) as pool:
        return dict(zip(cases, pool.map(partial(of_case, programme=programme), cases), strict=True))
