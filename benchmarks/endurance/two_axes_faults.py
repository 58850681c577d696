"""Faults of both axes, the scanner and the chamber in runs of a triad on emulated stands, and what came of each.

`python -m benchmarks.endurance.two_axes_faults [--pair serial|CAN]` has each kind happen while a dwell is under way,
and those of the chamber in a soak too. A run that was stopped is resumed, once the cause is gone, until it is complete;
then every point must be there once. With another unit in the place of an instrument it must not go on.
"""

import argparse
import tempfile
from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from benchmarks.endurance.two_axes import CHAMBER, CIA402, SCANNER, ZABER, TwoAxesStand, served
from tumble.app.resuming import find, resume
from tumble.app.running import run
from tumble.app.wiring import Connected
from tumble.emulators.faults import At, Fault, Kind
from tumble.procedures.events import Event, FinishReason, PointCompleted
from tumble.procedures.outcome import Outcome
from tumble.procedures.recording.reader import read_recording

PROGRAMME: Final = """method = "triad"
name = "faults"
temperatures_degC = [25, 24]
settle_s = 0.1
settle_tolerance_v = 1.0

[soak]
window_s = 48.0
look_s = 12.0
rate_K_per_h = 1000.0
timeout_s = 300.0

[[procedure]]
positions = [[90, 0], [0, 90], [-45, 45], [180, 0]]
"""
ONE_SOAK: Final = PROGRAMME.replace("[25, 24]", "[25]")
WITHOUT_A_SOAK: Final = PROGRAMME.replace("temperatures_degC = [25, 24]\n", "")
"""The same in less time, for a fault in the first soak, and for one in a dwell."""
SPEED: Final = 40.0
DURING_S: Final = 30.0
"""In the first soak, by the stand's clock."""
_WIRE: Final[tuple[Kind, ...]] = ("late", "cut", "double", "reorder", "drop")
_OF_AN_AXIS: Final[tuple[Kind, ...]] = ("power_loss", "stall", "overshoot", "moving_for_ever", "swapped")
_ON_A_LINE: Final[tuple[Kind, ...]] = ("garble", "wrong_checksum", "noise")
_ON_CAN: Final[tuple[Kind, ...]] = ("emergency", "bus_off", "heartbeat_lost", "foreign_frames", "old_bits", "flicker")
_OF_THE_SCANNER: Final[tuple[Kind, ...]] = ("garble", "nan", "overload", "error_queued", "power_loss", "swapped")
_OF_THE_CHAMBER: Final[tuple[Kind, ...]] = ("door_opened", "sensor_broken", "stuck", "alarm", "power_loss", "refused")
PAIRS: Final = {"serial": ZABER, "CAN": CIA402}


@dataclass(frozen=True, kw_only=True)
class Case:
    """One fault at one moment."""

    pair: str
    device: str
    kind: Kind
    soaking: bool = False

    @property
    def other_unit(self) -> bool:
        """Whether another instrument stands there afterwards, so that the run must not go on."""
        return self.kind == "swapped"

    def faults(self) -> list[Fault]:
        """As an emulator takes them; what lasts is over soon after the run was stopped.

        Another unit is seen when the link comes back.
        """
        at = At(time_s=DURING_S) if self.soaking else At(point=2)
        kinds: tuple[Kind, ...] = ("swapped", "drop") if self.other_unit else (self.kind,)
        return [Fault(device=self.device, kind=kind, at=at, lasts_s=0.1 if kind in _WIRE else 1.0) for kind in kinds]


@dataclass(frozen=True, kw_only=True)
class Result:
    """What came of it."""

    reason: FinishReason
    """Why the run ended in which it happened."""
    message: str
    happened: bool
    lost: int
    doubled: int
    resting: bool
    """Whether both axes of the world stood once that run was over."""
    resumed: int
    """How often the run was taken up again until it was complete; -1 where it never was."""


def cases(pair: str) -> list[Case]:
    """All kinds, of the second axis, the scanner and the chamber."""
    axis = (*_WIRE, *_OF_AN_AXIS, *(_ON_A_LINE if pair == "serial" else _ON_CAN))
    kinds = {"inner": axis, "outer": ("stall", "power_loss"), "scanner": (*_WIRE, *_OF_THE_SCANNER)}
    found = [Case(pair=pair, device=device, kind=kind) for device, every in kinds.items() for kind in every]
    chamber = [*_WIRE, *_OF_THE_CHAMBER]
    return found + [Case(pair=pair, device="chamber", kind=kind, soaking=both) for kind in chamber for both in (0, 1)]


def carried_out(case: Case, folder: Path, programme: str = PROGRAMME) -> Result:
    """Have one fault happen in a run, and go on until the run is complete."""
    completed: list[int] = []

    def listen(event: Event) -> None:
        if isinstance(event, PointCompleted):
            completed.append(event.point.index)

    with served(folder, "\n".join((PAIRS[case.pair], SCANNER, CHAMBER)), programme, SPEED) as stand:
        for fault in case.faults():
            stand.faults.add(fault)
        recording = folder / "run.mcap"
        outcome = _connected(stand, lambda connected: run(stand.job, connected, recording, [listen]))
        with stand.shared.lock:
            resting = not any(axis.status().moving for axis in stand.shared.world.positioners.values())
        resumed, last, most = 0, outcome, 1 if case.other_unit else _MOST
        while last.reason is not FinishReason.COMPLETED and resumed < most:
            resumed += 1
            stand.clock.sleep(SPEED)  # until what lasted is over
            last = _connected(stand, lambda connected: resume(find(recording), stand.job, connected, [listen], 1.0))
        whole = last.reason is FinishReason.COMPLETED
        wanted = {*completed, *(range(stand.job.plan().dwells) if whole else ())}
        kept = Counter(point.index for point in read_recording(recording).points)
        return Result(
            reason=outcome.reason,
            message=outcome.message,
            happened=bool(stand.faults.happened),
            lost=sum(index not in kept for index in wanted),
            doubled=sum(count - 1 for count in kept.values()) + len(completed) - len(set(completed)),
            resting=resting,
            resumed=resumed if whole else -1,
        )


_MOST: Final = 3


def _connected(stand: TwoAxesStand, act: Callable[[Connected], Outcome]) -> Outcome:
    connected = stand.connect()
    try:
        return act(connected)
    finally:
        connected.links.close()


def main() -> None:
    """Have all of them happen, and say what came of each."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--pair", choices=list(PAIRS), action="append")
    results: list[tuple[Case, Result]] = []
    for pair in parser.parse_args().pair or list(PAIRS):
        for case in cases(pair):
            with tempfile.TemporaryDirectory() as folder:
                result = carried_out(case, Path(folder))
            results.append((case, result))
            when = "soak" if case.soaking else "dwell"
            counts = f"lost {result.lost}, doubled {result.doubled}, resumed {result.resumed}"
            missed = "" if result.happened else " DID NOT HAPPEN"
            what = f"{pair} {case.device} {case.kind} ({when}): {result.reason}, {counts}{missed}"
            print(f"{what}: {result.message[:120]}", flush=True)
    _tell_sum(results)


def _tell_sum(results: Sequence[tuple[Case, Result]]) -> None:
    lost, doubled = sum(each.lost for _, each in results), sum(each.doubled for _, each in results)
    moving = sum(not each.resting for _, each in results)
    refused = sum(each.resumed < 0 and case.other_unit for case, each in results)
    never = sum(each.resumed < 0 and not case.other_unit for case, each in results)
    print(
        f"{len(results)} runs: lost {lost}, doubled {doubled}, moving afterwards {moving}, other units refused "
        f"{refused}, never completed {never}"
    )


if __name__ == "__main__":
    main()
