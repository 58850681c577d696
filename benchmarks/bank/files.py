"""Write a table as CSV (observations.md, version 1) and its truth as JSON."""

import csv
import json
from pathlib import Path

from benchmarks.bank.table import COLUMNS, Case

_FORMATS = {
    "time_s": "{:.3f}",
    "realisation": "{}",
    "procedure": "{}",
    "mount": "{}",
    "angle_deg": "{:.6f}",
    "direction": "{}",
    "temperature_degC": "{:.3f}",
    "voltage_V": "{:.8f}",
    "voltage_sd_V": "{:.8f}",
    "samples": "{}",
}
"""The columns in the order in which they are written."""


def write_csv(case: Case, path: Path) -> None:
    """Write the columns that the table has."""
    fields = {**COLUMNS, "angle_deg": "angle_deg", "voltage_V": "voltage_v"}
    columns = {
        column: [form.format(value) for value in values.tolist()]
        for column, form in _FORMATS.items()
        if (values := getattr(case.observations, fields[column])) is not None
    }
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*columns.values(), strict=True))


def write_truth(case: Case, path: Path) -> None:
    """Write what was put in."""
    path.write_text(json.dumps(case.truth.as_json(), indent=1) + "\n", encoding="utf-8")
