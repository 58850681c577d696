"""The programme `24` through the wire, with every pair of instruments: `python -m benchmarks.endurance.two_axes_pairs`.

Printed is by how much each run differs at most from that of the simulated stand in the process, in standard
uncertainties (type A) of the fourteen parameters.
"""

import tempfile
import time
from pathlib import Path
from typing import Final

import numpy as np

from benchmarks.endurance.two_axes import (
    CAN_DAQS,
    CIA402,
    MANUAL,
    METERS,
    SCANNER,
    SIMULATED,
    ZABER,
    ZABER_CHAIN,
    ZABER_LINES,
    job_at,
    served,
    stand_of,
)
from tumble.app.measurements import read_measurement
from tumble.app.running import Job, run
from tumble.app.wiring import Connected, connect
from tumble.calibrations.methods.triad.fit import TriadFit
from tumble.calibrations.methods.triad.loop import declared_fit
from tumble.calibrations.methods.triad.observations import TriadObservations

PROGRAMME: Final = """method = "triad"
name = "24"
settle_s = 0.1
settle_tolerance_v = 1.0

[[procedure]]
list = "24"
"""
PAIRS: Final = {
    "two axes of a Zaber controller, scanner": (ZABER, SCANNER),
    "chain of two Zaber stages, three multimeters": (ZABER_CHAIN, METERS),
    "two Zaber heads on a line each, scanner": (ZABER_LINES, SCANNER),
    "two CiA 402 nodes, scanner": (CIA402, SCANNER),
    "two CiA 402 nodes, three CAN DAQs": (CIA402, CAN_DAQS),
    "two axes set by hand, scanner": (MANUAL, SCANNER),
}


def fitted(job: Job, connected: Connected, path: Path) -> TriadFit:
    """Run and fit."""
    outcome = run(job, connected, path)
    if outcome.error is not None:
        raise outcome.error
    rows = read_measurement(path).observations
    assert isinstance(rows, TriadObservations)
    return declared_fit(rows).fit


def main() -> None:
    """Run all pairs."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        here = stand_of(folder, SIMULATED, {})
        whole = fitted(job_at(here, PROGRAMME), connect(here), folder / "here.mcap")
        deviation = np.sqrt(np.diag(whole.parameter_covariance))
        for number, (pair, tables) in enumerate(PAIRS.items()):
            began_s = time.monotonic()
            with served(folder, "\n".join(tables), PROGRAMME) as stand:
                connected = stand.connect()
                through = fitted(stand.job, connected, folder / f"{number}.mcap")
                connected.links.close()
            off = np.abs(through.values - whole.values) / deviation
            print(f"{pair}: {off.max():.3f} u at most, {time.monotonic() - began_s:.0f} s", flush=True)


if __name__ == "__main__":
    main()
