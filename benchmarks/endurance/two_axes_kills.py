"""Kill -9 in runs of a triad at two temperatures: after every point, and in the midst of every soak. POSIX only.

`python -m benchmarks.endurance.two_axes_kills [--emulated]` kills a run of the stand in the process, or of one that is
served by `tumble emulate`, resumes it and compares: completed points lost, doubled, or with other readings than those
of the run that nobody killed.
"""

from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager, contextmanager
from pathlib import Path
from typing import Final

from benchmarks.endurance.killed_runs import report, served
from benchmarks.endurance.two_axes import CHAMBER, SCANNER, SIMULATED, SIMULATED_CHAMBER, WORLD, ZABER

PROGRAMME: Final = """method = "triad"
name = "kills"
temperatures_degC = [25, 24]
settle_s = 0.1
settle_tolerance_v = 1.0

[soak]
window_s = 48.0
look_s = 12.0
rate_K_per_h = 1000.0

[[procedure]]
positions = [[90, 0], [0, 90], [-45, 45]]
"""
POINTS: Final = 6
SOAKS: Final = 2
_SPEED: Final = 40.0
KILLING: Final = """\
import os, signal, sys
from tumble.app.cli import main
from tumble.procedures.events import PointCompleted
from tumble.procedures.recording.writer import Recorder
from tumble.procedures.soaking import Soaking

what, last = sys.argv.pop(1), int(sys.argv.pop(1))
record, note, carry_out = Recorder.record, Soaking._note, Soaking.carry_out
soaks = looks = 0

def die():
    os.kill(os.getpid(), signal.SIGKILL)

def record_and_die(recorder, event):
    record(recorder, event)
    if what == "point" and isinstance(event, PointCompleted) and event.point.index == last:
        die()

def count_and_carry_out(soaking, setpoint_degc):
    global soaks
    soaks += 1
    return carry_out(soaking, setpoint_degc)

def note_and_die(soaking, status):
    global looks
    note(soaking, status)
    looks += soaks == last + 1
    if what == "soak" and looks == 3:
        die()

Recorder.record, Soaking._note, Soaking.carry_out = record_and_die, note_and_die, count_and_carry_out
main()
"""


@contextmanager
def in_process(folder: Path) -> Iterator[Path]:
    """The stand file of a stand in the process of the run."""
    yield _written(folder, f"{SIMULATED}\n{SIMULATED_CHAMBER}", {})


def emulated(folder: Path) -> AbstractContextManager[Path]:
    """The stand file of a stand that a process of its own serves."""
    tables = "\n".join((ZABER, SCANNER, CHAMBER))
    return served(lambda where: _written(folder, tables, where), _SPEED)


def _written(folder: Path, tables: str, where: Mapping[str, str]) -> Path:
    text = tables
    for name in ("outer", "inner", "scanner", "chamber"):
        text = text.replace(f"{{{name}}}", where.get(name, "socket://127.0.0.1:0"))
    (folder / "programme.toml").write_text(PROGRAMME, "utf-8")
    path = folder / "stand.toml"
    path.write_text(f'name = "kills"\n{text}\n{WORLD}', "utf-8")
    return path


def main() -> None:
    """Kill at all of them, and say what became of the points."""
    moments = [("point", number) for number in range(POINTS)] + [("soak", number) for number in range(SOAKS)]
    report(__doc__ or "", {False: in_process, True: emulated}, KILLING, moments)


if __name__ == "__main__":
    main()
