"""Faults of generator and meters in runs on an emulated shaker, and what came of each.

`python -m benchmarks.endurance.shaker_faults` has each kind happen while the unit is shaken, and again on a ramp. A run
that was stopped is resumed, once the cause is gone, until it is complete; then every point must be there once. Whatever
ended a run, the shaker of the world must be at rest, or the operator must have been told to see to it.
"""

import tempfile
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from benchmarks.endurance.shaker import ShakerStand, served
from tumble.app.resuming import find, resume
from tumble.app.running import run
from tumble.drivers.excitation import REST
from tumble.emulators.faults import At, Kind
from tumble.procedures.events import Event, FinishReason, PointCompleted, WarningRaised
from tumble.procedures.recording.reader import read_recording

PROGRAMME: Final = """method = "vibration"
name = "faults"
settle_s = 0.1
settle_samples = 20
settle_timeout_s = 1.0

[[procedure]]
levels_g = [3.0, 5.0]
frequencies_Hz = [21.3]
"""
SPEED: Final = 10.0
_WIRE: Final[tuple[Kind, ...]] = ("late", "cut", "double", "reorder", "drop", "garble", "noise")
_OF_THE_GENERATOR: Final[tuple[Kind, ...]] = ("error_queued", "swapped", "power_loss", "refused", "stuck", "alarm")
_OF_A_METER: Final[tuple[Kind, ...]] = ("error_queued", "swapped", "power_loss", "nan", "overload")
_HAND: Final = "by hand"
_MOST: Final = 3
_MARGIN_S: Final = 0.5


@dataclass(frozen=True, kw_only=True)
class Case:
    """One fault at one moment."""

    device: str
    kind: Kind
    on_a_ramp: bool = False

    @property
    def lasts_s(self) -> float:
        """A generator is stuck until no stop waits for it any longer."""
        return 0.1 if self.kind in _WIRE else 4.0 if self.kind == "stuck" else 1.0

    def happen_at(self, stand: ShakerStand) -> None:
        """Have it happen; what lasts is over soon after the run was stopped."""
        at = At(point=2)
        if self.device == "exciter":  # its amplitude for 3 g, and one on the way there
            at = At(command=1, containing="VOLT 0.") if self.on_a_ramp else At(command=1, containing="VOLT 3")
        if self.kind == "swapped":  # which is seen when the link comes back
            stand.suffer("drop", at, 0.1, self.device)
        stand.suffer(self.kind, at, self.lasts_s, self.device)


@dataclass(frozen=True, kw_only=True)
class Result:
    """What came of it."""

    reason: FinishReason
    """Why the run ended in which it happened."""
    message: str
    happened: bool
    lost: int
    doubled: int
    safe: bool
    """Whether the shaker rested once that run was over, or the operator was told."""
    told: bool
    """Whether he was."""
    resumed: int
    """How often the run was taken up again until it was complete; -1 where it never was."""


def cases() -> list[Case]:
    """All kinds, of the generator, the meter at the unit and that at the reference."""
    exciter = [Case(device="exciter", kind=kind) for kind in (*_WIRE, *_OF_THE_GENERATOR)]
    ramps = [Case(device="exciter", kind=kind, on_a_ramp=True) for kind in ("drop", *_OF_THE_GENERATOR)]
    unit = [Case(device="unit", kind=kind) for kind in (*_WIRE, *_OF_A_METER)]
    return exciter + ramps + unit + [Case(device="reference", kind="overload"), Case(device="reference", kind="drop")]


def carried_out(case: Case, folder: Path, speed: float = SPEED) -> Result:
    """Have one fault happen in a run, and go on until the run is complete."""
    completed: list[int] = []
    warned: list[str] = []

    def listen(event: Event) -> None:
        if isinstance(event, PointCompleted):
            completed.append(event.point.index)
        elif isinstance(event, WarningRaised):
            warned.append(event.message)

    with served(folder, programme=PROGRAMME, speed=speed) as stand:
        case.happen_at(stand)
        recording = folder / "run.mcap"
        with stand.connected() as connected:
            outcome = run(stand.job, connected, recording, [listen])
        told = any(_HAND in each for each in warned)
        resting = stand.exciter.driven == REST
        resumed, last = 0, outcome
        while last.reason is not FinishReason.COMPLETED and resumed < _MOST:
            resumed += 1
            stand.clock.sleep((case.lasts_s + _MARGIN_S) * speed)  # until what lasted is over
            with stand.connected() as connected:
                last = resume(find(recording), stand.job, connected, [listen], 10.0)
        whole = last.reason is FinishReason.COMPLETED
        kept = Counter(point.index for point in read_recording(recording).points)
        return Result(
            reason=outcome.reason,
            message=outcome.message,
            happened=bool(stand.faults.happened),
            lost=sum(index not in kept for index in {*completed, *(range(stand.job.plan().dwells) if whole else ())}),
            doubled=sum(count - 1 for count in kept.values()) + len(completed) - len(set(completed)),
            safe=resting or told,
            told=told,
            resumed=resumed if whole else -1,
        )


def main() -> None:
    """Have all of them happen, and say what came of each."""
    results = []
    for case in cases():
        with tempfile.TemporaryDirectory() as folder:
            result = carried_out(case, Path(folder))
        results.append(result)
        when = "ramp" if case.on_a_ramp else "dwell"
        counts = f"lost {result.lost}, doubled {result.doubled}, resumed {result.resumed}"
        missed = "" if result.happened else " DID NOT HAPPEN"
        safe = "told to see to it" if result.told else "at rest" if result.safe else "DRIVES ON"
        print(
            f"{case.device} {case.kind} ({when}): {result.reason}, {counts}, {safe}{missed}: {result.message[:110]}",
            flush=True,
        )
    lost, doubled = sum(each.lost for each in results), sum(each.doubled for each in results)
    unsafe, never = sum(not each.safe for each in results), sum(each.resumed < 0 for each in results)
    print(f"{len(results)} runs: lost {lost}, doubled {doubled}, driving on unsaid {unsafe}, never complete {never}")


if __name__ == "__main__":
    main()
