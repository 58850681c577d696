"""Writes a table as the contract has it (observations.md)."""

import csv
from pathlib import Path
from typing import Final

import numpy as np

from benchmarks.blind.clock import SAMPLES
from benchmarks.blind.table import Table

THERMOMETER_DEGC: Final = 0.003
"""Noise of the temperature as recorded."""


def write_table(path: Path, table: Table, rng: np.random.Generator) -> None:
    """Write the rows of the table, not those of the fresh realisations."""
    columns = _columns(table, rng)
    held = np.flatnonzero(~table.run.fresh)
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([values[row] for values in columns.values()] for row in held)


def _columns(table: Table, rng: np.random.Generator) -> dict[str, list[str]]:
    run = table.run
    temperature_degc = run.temperature_degc + THERMOMETER_DEGC * rng.normal(size=len(run.time_s))
    columns = {
        "time_s": [f"{time:.3f}" for time in run.time_s],
        "realisation": [str(number) for number in run.realisation],
        "procedure": [str(word) for word in run.procedure],
        "mount": [str(word) for word in run.mount],
        "angle_deg": [f"{angle:.4f}" for angle in run.angle_deg],
        "direction": [str(sign) for sign in run.direction],
        "temperature_degC": [f"{temperature:.3f}" for temperature in temperature_degc],
        "voltage_V": [f"{voltage:.8f}" for voltage in table.voltage_v],
        "voltage_sd_V": [f"{spread:.8f}" for spread in run.voltage_sd_v],
        "samples": [str(SAMPLES)] * len(run.time_s),
    }
    return {name: values for name, values in columns.items() if name not in table.left_out}
