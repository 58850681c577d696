"""What a point costs beside the stand: this engine and Bluesky's, in turn, on devices that take no time.

A point here is a move, its position read back, the settling criterion, the samples, their reduction and the events of
all that, kept in a list. For Bluesky it is a move and a reading of ophyd-async soft signals, its documents kept in a
list. Nothing is written to a disk by either. Needs `pip install tumble[bench]`:

    python benchmarks/engine_overhead.py --points 500 --rounds 7
"""

import argparse
import statistics
import time
from collections.abc import Callable, Generator
from typing import Any

import numpy as np
from bluesky import RunEngine
from bluesky import plan_stubs as bps
from bluesky import preprocessors as bpp
from ophyd_async.core import StandardReadable, StandardReadableFormat, init_devices, soft_signal_rw

from tumble.drivers.clock import SystemClock
from tumble.drivers.protocols import Identity, PositionerStatus, SampleBlock, Stand
from tumble.procedures import Acquisition, Answers, Engine, ScriptedOperator, programme_from_text
from tumble.procedures.events import Event, FinishReason


class SoftHead:
    """Is where it shall be at once."""

    limits_deg = (-1e9, 1e9)
    speed_deg_s = 1e9

    def __init__(self) -> None:
        self._angle_deg = 0.0

    def identify(self) -> Identity:
        """Who it is."""
        return Identity(model="soft head", serial="0")

    def home(self) -> None:
        """Go to 0."""
        self._angle_deg = 0.0

    def start_move(self, angle_deg: float) -> None:
        """Be there."""
        self._angle_deg = angle_deg

    def status(self) -> PositionerStatus:
        """Where it is."""
        return PositionerStatus(angle_deg=self._angle_deg, moving=False, device_time_s=0.0)

    def stop(self) -> None:
        """Nothing moves."""


class SoftDaq:
    """Has its samples ready."""

    def __init__(self) -> None:
        self._voltage_v = np.random.default_rng(1).normal(2.5, 1e-3, 100)

    def identify(self) -> Identity:
        """Who it is."""
        return Identity(model="soft DAQ", serial="0")

    def acquire(self, samples: int, rate_hz: float) -> SampleBlock:
        """Give the first of the samples."""
        return SampleBlock(
            voltage_v=self._voltage_v[:samples], rate_hz=rate_hz, device_time_s=0.0, temperature_degc=23.0
        )


class ListSink:
    """Keeps events in memory."""

    def __init__(self) -> None:
        self.events: list[Event] = []

    def record(self, event: Event) -> None:
        """Keep an event."""
        self.events.append(event)


def ours(points: int) -> float:
    """Milliseconds a point of a sweep of so many, the 50 ms for the standstill at the end of the run included."""
    text = f'name = "bench"\n[[procedure]]\nkind = "sweep"\nstep_deg = 0.5\npoints = {points}\n'
    acquisition = Acquisition(samples=100, rate_hz=100.0, settle_samples=10)
    stand = Stand(name="soft", positioners={"head": SoftHead()}, samplers={"daq": SoftDaq()}, clock=SystemClock())
    engine = Engine(stand, ScriptedOperator(Answers(mounts={"default": "yes"})), ListSink(), acquisition)
    procedure = programme_from_text(text, "bench.toml").procedure
    began_s = time.perf_counter()
    outcome = engine.run(procedure)
    took_s = time.perf_counter() - began_s
    if outcome.reason is not FinishReason.COMPLETED:
        raise SystemExit(outcome.message)
    return 1e3 * took_s / points


class SoftStand(StandardReadable):
    """An angle to set, and a voltage and a temperature to read."""

    def __init__(self, name: str = "") -> None:
        with self.add_children_as_readables(StandardReadableFormat.HINTED_SIGNAL):
            self.angle_deg = soft_signal_rw(float)
            self.voltage_v = soft_signal_rw(float, initial_value=2.5)
            self.temperature_degc = soft_signal_rw(float, initial_value=23.0)
        super().__init__(name=name)


def bluesky(run_engine: RunEngine, stand: SoftStand, points: int) -> float:
    """Milliseconds a point of the same sweep."""
    documents: list[tuple[str, Any]] = []

    @bpp.run_decorator()
    def sweep() -> Generator[Any, Any, None]:
        for number in range(points):
            yield from bps.mv(stand.angle_deg, 0.5 * number)
            yield from bps.create()
            yield from bps.read(stand)
            yield from bps.save()

    began_s = time.perf_counter()
    run_engine(sweep(), lambda name, document: documents.append((name, document)))
    return 1e3 * (time.perf_counter() - began_s) / points


def main() -> None:
    arguments = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    arguments.add_argument("--points", type=int, default=500)
    arguments.add_argument("--rounds", type=int, default=7)
    chosen = arguments.parse_args()

    run_engine = RunEngine(context_managers=[])
    with init_devices():
        stand = SoftStand(name="soft")
    engines: dict[str, Callable[[], float]] = {
        "tumble": lambda: ours(chosen.points),
        "bluesky": lambda: bluesky(run_engine, stand, chosen.points),
    }
    figures: dict[str, list[float]] = {name: [] for name in engines}
    for _ in range(chosen.rounds):
        for name, measure in engines.items():
            figures[name].append(measure())
    for name, taken in figures.items():
        low, high = min(taken), max(taken)
        print(f"{name:8} {statistics.median(taken):7.3f} ms a point (median of {len(taken)}; {low:.3f} to {high:.3f})")
    ratio = statistics.median(figures["bluesky"]) / statistics.median(figures["tumble"])
    print(f"bluesky takes {ratio:.1f} times as long")


if __name__ == "__main__":
    main()
