"""Every kind of fault at every kind of step, through the wire: what happened, what was lost, how soon it was safe.

`python -m benchmarks.endurance.faults` runs a small programme on an emulated stand once for every fault, step and pair
of instruments, and prints a table in Markdown. Lost are points that the run had announced as completed and that its
recording does not hold. A run that was stopped is resumed once the fault is over; `resumed` says that it then had every
point of the programme, once.
"""

import argparse
import math
import os
import re
import sys
import tempfile
import time
from collections import Counter
from collections.abc import Iterable
from concurrent.futures import ProcessPoolExecutor
from contextlib import suppress
from dataclasses import dataclass, field
from itertools import product
from multiprocessing import get_context
from pathlib import Path
from typing import Final

from app.exits import Exit, status_of
from app.resuming import find, resume
from app.running import failure, run
from app.wiring import Connected
from benchmarks.endurance.emulated import EmulatedStand, Pair, emulated
from benchmarks.endurance.kills import points_said
from benchmarks.endurance.kinds import KINDS, Kind, room_again
from benchmarks.endurance.moments import MOMENTS, Moment, strike_at, take_time_to_answer
from calibrations.tracing.questions import questioned
from drivers.errors import DeviceError
from procedures.events import Event, PointCompleted, State, StateChanged, WarningRaised
from procedures.recording.observations import observations
from procedures.recording.reader import read_recording

SPEED: Final = 10.0
PAIRS: Final[tuple[Pair, ...]] = ("serial", "CAN")
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
_LINK_BACK_S: Final = 20.0
_ALWAYS: Final = "dividing head: has no reference; it is homed"
_PLACES: Final = {
    r"\S*run\.mcap": "run.mcap",
    r"127\.0\.0\.1[:&a-z=]*\d+": "HOST:PORT",
    r"after [\d.]+ s;": "after some seconds;",
    r"\d+ complete points?": "some complete points",
    r"point \d+ \([^)]*\)": "point (pose)",
    r"-?[\d.]+ deg when(.*) at -?[\d.]+ deg": r"some angle when\1 at another",
}


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
    read_back: bool = False
    completed: list[int] = field(default_factory=list)
    warnings: list[str] = field(default_factory=list)

    def __call__(self, event: Event) -> None:
        """Note an event."""
        if isinstance(event, PointCompleted):
            self.completed.append(event.point.index)
            self.completed_s.append(self.stand.clock.monotonic_s())
        elif isinstance(event, WarningRaised):
            self.warnings.append(event.message)
            self.warned_s.append(self.stand.clock.monotonic_s())
        elif isinstance(event, StateChanged) and event.state is State.STANDSTILL:
            self.read_back, self.standstill_s = True, self.stand.clock.monotonic_s()

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
    with emulated(folder, case.pair, programme, case.speed) as stand, room_again():
        recording, watch = folder / "run.mcap", Watch(stand)
        status, said = Exit.GOOD, ""
        try:
            status, said = _run(case, stand, watch, recording)
        except KeyboardInterrupt:  # after the run was over
            status, said = Exit.STOPPED, "interrupted"
        except Exception as error:  # a fault of the program among them
            status, said = status_of(error) or Exit.INTERNAL, str(error) or repr(error)
        ended_s = stand.clock.monotonic_s()
        with room_again():
            pass
        kept = Counter(point.index for point in points_said(recording)) if recording.exists() else Counter()
        standing = not stand.shared.head.status().moving
        whole, points = status is Exit.GOOD, stand.job.plan().dwells
        return Result(
            status=status,
            sentences=(*watch.warnings, *_asked(recording)) if whole else (said,),
            lost=sum(index not in kept for index in watch.completed) + (points - len(kept) if whole else 0),
            doubled=sum(count - 1 for count in kept.values()),
            standing=standing,
            read_back=watch.read_back,
            safe_s=watch.safe_s(ended_s, whole),
            resumed=None if whole else _resumed(stand, recording),
        )


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
    """The stand, once its links are back."""
    deadline_s = time.monotonic() + _LINK_BACK_S
    while True:
        with suppress(DeviceError):
            return stand.connect()
        if time.monotonic() > deadline_s:
            return stand.connect()
        time.sleep(0.1)


def of_case(case: Case) -> Result:
    """Have one fault happen in a folder of its own."""
    with tempfile.TemporaryDirectory() as name:
        return carried_out(case, Path(name))


def cell(case: Case, result: Result) -> str:
    """What happened, in a few words; what must not happen is bold."""
    words = [
        "went on" if result.status is Exit.GOOD else f"stopped, status {int(result.status)}",
        f"{result.safe_s:.1f} s",
    ]
    remarks = {
        "standstill not read back": not result.read_back,
        "other unit refused": result.resumed is False and case.kind.other_unit,
        "**not resumed**": result.resumed is False and not case.kind.other_unit,
        "**head moves**": not result.standing,
        f"**{result.lost} lost**": result.lost > 0,
        f"**{result.doubled} doubled**": result.doubled > 0,
        "asked by the analysis": any("seated as asked" in said for said in result.sentences),
    }
    return ", ".join([*words, *(remark for remark, holds in remarks.items() if holds)])


def table(pair: Pair, results: dict[Case, Result]) -> str:
    """A table in Markdown: a row for every kind of fault, a column for every kind of step."""
    lines = [f"| fault, {pair} | {' | '.join(MOMENTS)} |", "|---" * (len(MOMENTS) + 1) + "|"]
    for kind in KINDS:
        cells = {
            case.moment: cell(case, result)
            for case, result in results.items()
            if case.pair == pair and case.kind is kind
        }
        if cells:
            lines.append(f"| {kind.name} | {' | '.join(cells.get(moment, '') for moment in MOMENTS)} |")
    return "\n".join(lines)


def sentences(results: dict[Case, Result]) -> str:
    """What was said, once for each kind of fault, with how often."""
    said = Counter(
        f"- {case.kind.name}: {sentence}"
        for case, result in results.items()
        for sentence in {_without_place(sentence) for sentence in result.sentences} - {_ALWAYS}
    )
    return "\n".join(f"{sentence} ({count} times)" for sentence, count in said.items())


def _without_place(sentence: str) -> str:
    """A sentence without what is another one in every run."""
    for pattern, word in _PLACES.items():
        sentence = re.sub(pattern, word, sentence)
    return sentence


def summary(results: dict[Case, Result]) -> str:
    """One line for all."""
    stopped = [result for result in results.values() if result.status is not Exit.GOOD]
    read_back = [result for result in stopped if result.read_back]
    slowest_s = max((result.safe_s for result in read_back), default=0.0)
    return (
        f"{len(results)} faults at a step: {len(results) - len(stopped)} runs went on to their end, "
        f"{len(stopped)} stopped, {len(read_back)} of these with a standstill read back, the slowest "
        f"{slowest_s:.1f} s after the fault; "
        f"{sum(result.lost for result in results.values())} points lost, "
        f"{sum(result.doubled for result in results.values())} doubled"
    )


def is_bad(case: Case, result: Result) -> bool:
    """Whether something happened that must not."""
    resumed = result.resumed is not False or case.kind.other_unit
    unasked = case.kind.device == "operator" and not any("seated as asked" in said for said in result.sentences)
    return bool(
        unasked or result.lost or result.doubled or not result.standing or result.status is Exit.INTERNAL or not resumed
    )


def cases(kinds: Iterable[Kind], speed: float) -> list[Case]:
    """Every fault at every step, with each pair of instruments that can have it."""
    return [
        Case(kind=kind, moment=moment, pair=pair, speed=speed)
        for kind, moment, pair in product(kinds, MOMENTS, PAIRS)
        if pair in kind.pairs
    ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--speed", type=float, default=SPEED, help="of the stand, times real time")
    parser.add_argument("--kind", default="", help="only the kinds whose name contains this")
    parser.add_argument("--moment", choices=MOMENTS, help="only this step")
    parser.add_argument("--processes", type=int, default=os.cpu_count() or 1)
    options = parser.parse_args()
    chosen = [kind for kind in KINDS if options.kind in kind.name]
    wanted = [case for case in cases(chosen, options.speed) if options.moment in (None, case.moment)]
    with ProcessPoolExecutor(options.processes, mp_context=get_context("spawn")) as pool:
        results = dict(zip(wanted, pool.map(of_case, wanted), strict=True))
    for pair in PAIRS:
        print(table(pair, results), end="\n\n")
    print(sentences(results), end="\n\n")
    print(summary(results))
    if bad := [case for case, result in results.items() if is_bad(case, result)]:
        sys.exit("\n".join(f"{case.kind.name} at {case.moment}, {case.pair}: went wrong" for case in bad))


if __name__ == "__main__":
    main()
