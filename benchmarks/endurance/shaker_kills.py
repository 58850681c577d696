"""Kill -9 in runs on a shaker: after every point, on every ramp, and in every dwell. POSIX only.

`python -m benchmarks.endurance.shaker_kills [--emulated]` kills a run of the stand in the process, or of one that is
served by `tumble emulate` (where the generator then goes on driving), resumes it and compares: completed points lost,
doubled, or with other readings than those of the run that nobody killed.
"""

from collections.abc import Iterator
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Final

from benchmarks.endurance.killed_runs import report, served
from benchmarks.endurance.shaker import GENERATOR, METERS, SIMULATED_EXCITER, SIMULATED_METER, written

PROGRAMME: Final = """method = "vibration"
name = "kills"
settle_s = 0.1
settle_samples = 20

[[procedure]]
levels_g = [3.0, 5.0]
frequencies_Hz = [21.3]
mountings = [{}, { x = "o", y = "p" }]
"""
POINTS: Final = 10
RAMPS: Final = 4
_SPEED: Final = 20.0
KILLING: Final = """\
import os, signal, sys
from tumble.app.cli import main
from tumble.procedures.events import PointCompleted, SamplesAcquired
from tumble.procedures.exciters import Exciters
from tumble.procedures.recording.writer import Recorder

what, last = sys.argv.pop(1), int(sys.argv.pop(1))
record, raise_to = Recorder.record, Exciters._set
levels = 0

def die():
    os.kill(os.getpid(), signal.SIGKILL)

def record_and_die(recorder, event):
    record(recorder, event)
    if what == "point" and isinstance(event, PointCompleted) and event.point.index == last:
        die()
    if what == "dwell" and isinstance(event, SamplesAcquired) and event.point == last:
        die()

def set_and_die(exciters, name, level):
    global levels
    levels += 1
    raise_to(exciters, name, level)
    if what == "ramp" and levels == 15 * last + 5:  # eight steps up, seven down
        die()

Recorder.record, Exciters._set = record_and_die, set_and_die
main()
"""


@contextmanager
def in_process(folder: Path) -> Iterator[Path]:
    """The stand file of a stand in the process of the run."""
    yield written(folder, f"{SIMULATED_EXCITER}\n{SIMULATED_METER}", {}, PROGRAMME)


def emulated(folder: Path) -> AbstractContextManager[Path]:
    """The stand file of a stand that a process of its own serves."""
    return served(lambda where: written(folder, f"{GENERATOR}\n{METERS}", dict(where), PROGRAMME), _SPEED)


def main() -> None:
    """Kill at all of them, and say what became of the points."""
    moments = [("point", number) for number in range(POINTS)]
    moments += [("dwell", number) for number in range(POINTS)] + [("ramp", number) for number in range(RAMPS)]
    report(__doc__ or "", {False: in_process, True: emulated}, KILLING, moments)


if __name__ == "__main__":
    main()
