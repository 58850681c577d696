"""A table of a million rows, to see what memory and time they take.

`python -m benchmarks.million FILE [--rows 1000000] [--settings 3600]`
"""

import argparse
from pathlib import Path

import numpy as np

from tumble.calibrations.core.table import write_table
from tumble.calibrations.methods.dividing_head.observations import Observations


def table(rows: int, settings: int) -> Observations:
    """Sweeps face-up, edge, face-up, edge over all settings, again and again, of a unit without an effect."""
    generator = np.random.default_rng(1)
    number = np.arange(rows)
    angle_deg = number % settings * (360.0 / settings)
    up = number * 4 // rows % 2 == 0
    turned = np.deg2rad(angle_deg + 0.1121)
    ax, ay, az = -np.sin(turned), np.where(up, -np.cos(turned), 0.0), np.where(up, 0.0, -np.cos(turned))
    voltage_v = 2.5 + ax + 0.0098 * ay + 0.002 * az + 0.001 * ax * ay + generator.normal(0.0, 1e-4, rows)
    return Observations(
        row=number + 1,
        angle_deg=angle_deg,
        voltage_v=voltage_v,
        time_s=number.astype(float),
        realisation=number // settings + 1,
        procedure=np.full(rows, "sweep"),
        mount=np.where(up, "face-up", "edge"),
        direction=np.ones(rows, dtype=np.int64),
        temperature_degc=23.0 + generator.normal(0.0, 0.01, rows).round(4),
        voltage_sd_v=np.full(rows, 1e-3),
        samples=np.full(rows, 100),
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", type=Path)
    parser.add_argument("--rows", type=int, default=1_000_000)
    parser.add_argument("--settings", type=int, default=3600)
    options = parser.parse_args()
    write_table(table(options.rows, options.settings), options.file)


if __name__ == "__main__":
    main()
