"""STOP at random moments of runs whose instruments are silent or garbled: `python -m benchmarks.endurance.stops`.

Printed is how the runs ended, and how long each took from the wish to stop to its end, in real time: with everything at
a standstill that was read back, or with the words that it was not, where the way to what moves stayed away.
"""

import argparse
import random
import tempfile
import time
from collections import Counter
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from statistics import median
from threading import Timer
from typing import Final

from benchmarks.endurance import shaker, two_axes
from benchmarks.endurance.two_axes_pairs import PAIRS
from tumble.app.running import run
from tumble.app.wiring import connect
from tumble.drivers.errors import DeviceError
from tumble.emulators.faults import WIRE, At, Fault, Kind
from tumble.procedures.outcome import Outcome

SHORT: Final = (
    'method = "triad"\nname = "short"\nsettle_s = 0.1\nsettle_tolerance_v = 1.0\n[[procedure]]\nlist = "8o"\n'
)
SPEEDS: Final = (3.0, 30.0)
"""How many times as fast as real time a stand lives."""
KINDS: Final[tuple[Kind, ...]] = (*WIRE, "drop", "noise")
LASTING_S: Final = (0.3, 2.0, 20.0)
_LATEST_S: Final = 6.0
"""When a run is stopped at the latest, in real time."""
_SHAKEN: Final = "a function generator, two multimeters"
_BY_HAND: Final = "two axes set by hand, scanner"


@dataclass(frozen=True, kw_only=True)
class Stopped:
    """How a run ended."""

    stand: str
    outcome: Outcome
    took_s: float | None
    """From the wish to stop; None where the run was over before."""


@contextmanager
def served(name: str, folder: Path, rng: random.Random) -> Iterator[two_axes.TwoAxesStand | shaker.ShakerStand]:
    """An emulated stand, by the name of its instruments."""
    if name == _SHAKEN:
        with shaker.served(folder) as shaken:
            yield shaken
    else:
        with two_axes.served(folder, "\n".join(PAIRS[name]), SHORT, speed=rng.choice(SPEEDS)) as stand:
            yield stand


def stopped(name: str, folder: Path, rng: random.Random) -> Stopped:
    """Carry out a run with up to three faults, and stop it somewhere. Raises `DeviceError` where it cannot begin."""
    with served(name, folder, rng) as stand:
        connected = connect(stand.job.stand, clock=stand.clock)
        for _ in range(rng.randint(0, 3)):
            stand.faults.add(
                Fault(
                    device=rng.choice(list(connected.stand.instruments)),
                    kind=rng.choice(KINDS),
                    at=At(command=rng.randint(1, 200)),
                    lasts_s=rng.choice(LASTING_S),
                    times=rng.choice((1, 1, 5)),
                )
            )
        wished_s: list[float] = []

        def stop() -> None:
            wished_s.append(time.monotonic())
            connected.control.stop()

        wish = Timer(rng.uniform(0.1, _LATEST_S), stop)
        wish.start()
        try:
            outcome = run(stand.job, connected, folder / "run.mcap")
            ended_s = time.monotonic()
        finally:
            wish.cancel()
            connected.links.close()
    took_s = ended_s - wished_s[0] if wished_s and wished_s[0] < ended_s else None
    return Stopped(stand=name, outcome=outcome, took_s=took_s)


def tell(runs: list[Stopped]) -> None:
    """Print how they ended."""
    for (reason, rests), count in Counter(
        (str(each.outcome.reason), each.outcome.at_standstill) for each in runs
    ).items():
        print(f"{count} {reason}, {'at a standstill' if rests else 'no standstill read back'}")
    slow = sorted(((each.took_s, each) for each in runs if each.took_s is not None), key=lambda pair: pair[0])
    rested = [took_s for took_s, each in slow if each.outcome.at_standstill]
    took = f"after {median(rested):.3f} s in the median, {max(rested):.2f} s at most" if rested else "in none"
    print(f"{len(slow)} stopped; at a standstill {took}")
    for took_s, each in slow[-5:]:
        print(f"  {took_s:.2f} s: {each.stand}: {each.outcome.message}")


def main() -> None:
    """Stop runs for some minutes."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0])
    parser.add_argument("--minutes", type=float, default=4.0)
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    rng, names = random.Random(arguments.seed), [name for name in (*PAIRS, _SHAKEN) if name != _BY_HAND]
    until_s, runs = time.monotonic() + 60.0 * arguments.minutes, list[Stopped]()
    while time.monotonic() < until_s:
        with tempfile.TemporaryDirectory() as folder:
            try:
                runs.append(stopped(rng.choice(names), Path(folder), rng))
            except DeviceError as error:
                print(f"not begun: {error}")
    tell(runs)


if __name__ == "__main__":
    main()
