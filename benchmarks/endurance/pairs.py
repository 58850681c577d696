"""A whole programme through the wire: `python -m benchmarks.endurance.pairs [--programme seed] [--speed 30]`.

Every pair of drivers measures the emulated stand, `tumble run` and `tumble emulate` each in a process of its own; a
short programme also goes over pseudo-terminals and through a network port server (RFC 2217). The same stand is run with
the simulated drivers, and all are fitted. Each cell of the table has the difference from the simulated stand, and from
what was put in, in standard uncertainties of the fit (type A); no difference from the simulated stand may be beyond the
expanded uncertainty (k = 2).
"""

import argparse
import os
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path

from benchmarks.endurance import processes as stands
from benchmarks.endurance.processes import Instruments, emulated, run
from benchmarks.endurance.rfc2217 import rfc2217_port
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.result import Calibration
from tumble.drivers.simulated import Simulated
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.recording.reader import read_recording

PAIRS = {
    "zaber, scpi": stands.ZABER_SCPI,
    "zaber, can": stands.ZABER_CAN,
    "cia402, scpi": stands.CIA402_SCPI,
    "cia402, can": stands.CIA402_CAN,
    "manual, scpi": stands.MANUAL_SCPI,
}
ON_TERMINALS = {"zaber, scpi": stands.ZABER_SCPI, "cia402, can": stands.CIA402_CAN}
TRUE = {name.removesuffix("_deg"): value for name, value in vars(Simulated().unit_parameters).items()}
COVERAGE = 2.0


@dataclass(frozen=True, kw_only=True)
class Whole:
    """A run that was completed, and its fit."""

    name: str
    points: int
    seconds: float
    calibration: Calibration

    def off(self, others: dict[str, float]) -> dict[str, float]:
        """Difference of each parameter that was told from another value, in standard uncertainties."""
        found = self.calibration.parameters
        return {name: (value - others[name]) / found[name].standard_uncertainty for name, value in self.values.items()}

    @property
    def values(self) -> dict[str, float]:
        """What was told."""
        found = self.calibration.parameters
        return {name: parameter.value for name, parameter in found.items() if parameter.value is not None}


def whole(name: str, stand: Path, programme: str) -> Whole:
    """Run and fit."""
    recording = stand.with_suffix(".mcap")
    began_s = time.monotonic()
    run(stand, programme, recording)
    seconds = time.monotonic() - began_s
    rows = observations(read_recording(recording))
    return Whole(name=name, points=len(rows), seconds=seconds, calibration=analyse(rows, trials=0))


@contextmanager
def served(instruments: Instruments, folder: Path, speed: float, suffix: str = "") -> Iterator[Path]:
    """Emulate a stand; gives the file of a stand that reaches it."""
    options = ["--pty"] if suffix else []
    with emulated(instruments.write_stand(folder / "served.toml"), speed, *options) as addresses:
        yield instruments.at(addresses, suffix).write_stand(folder / "stand.toml")


@contextmanager
def served_through_rfc2217(folder: Path, speed: float) -> Iterator[Path]:
    """Emulate a Zaber stage and a multimeter, the stage behind a network port server."""
    stand = stands.ZABER_SCPI
    with (
        emulated(stand.write_stand(folder / "served.toml"), speed) as addresses,
        rfc2217_port(addresses["head"]) as head_url,
    ):
        yield replace(stand.at(addresses), head_url=head_url).write_stand(folder / "stand.toml")


def simulated(programme: str) -> Whole:
    """The same with the simulated drivers."""
    with tempfile.TemporaryDirectory() as name:
        return whole("simulated", stands.SIMULATED.write_stand(Path(name) / "stand.toml"), programme)


def through_sockets(programme: str, speed: float) -> Iterator[Whole]:
    """Every pair over loopback TCP."""
    for name, instruments in PAIRS.items():
        with tempfile.TemporaryDirectory() as folder, served(instruments, Path(folder), speed) as stand:
            yield whole(name, stand, programme)


def through_other_ports(programme: str, speed: float) -> Iterator[Whole]:
    """Pseudo-terminals, where there are any, and RFC 2217."""
    for name, instruments in ON_TERMINALS.items() if os.name == "posix" else ():
        with tempfile.TemporaryDirectory() as folder, served(instruments, Path(folder), speed, "_pty") as stand:
            yield whole(f"{name}, pseudo-terminals", stand, programme)
    with tempfile.TemporaryDirectory() as folder, served_through_rfc2217(Path(folder), speed) as stand:
        yield whole("zaber through RFC 2217, scpi", stand, programme)


def agrees(one: Whole, reference: Whole) -> bool:
    """Whether the same parameters are told, each that of the simulated stand within its expanded uncertainty."""
    if one.points != reference.points or one.values.keys() != reference.values.keys():
        return False
    return all(abs(off) <= COVERAGE for off in one.off(reference.values).values())


def header() -> str:
    columns = ["pair", "points", "time, s", *TRUE]
    return f"| {' | '.join(columns)} |\n|{'---|' * len(columns)}"


def row(one: Whole, reference: Whole) -> str:
    from_simulated, from_truth = one.off(reference.values), one.off(TRUE)
    cells = [f"{from_simulated[name]:+z.3f}, {from_truth[name]:+z.2f}" if name in from_truth else "" for name in TRUE]
    return f"| {' | '.join([one.name, str(one.points), f'{one.seconds:.0f}', *cells])} |"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--programme", default="seed")
    parser.add_argument("--short", default="quick", help="programme for the other ports")
    parser.add_argument("--speed", type=float, default=30.0, help="of the emulated stand, times real time")
    options = parser.parse_args()
    good = True
    for programme, runs in ((options.programme, through_sockets), (options.short, through_other_ports)):
        reference = simulated(programme)
        print(f"{header()}\n{row(reference, reference)}", flush=True)
        for one in runs(programme, options.speed):
            print(row(one, reference), flush=True)
            good &= agrees(one, reference)
    print("all agree" if good else "NOT all agree")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
