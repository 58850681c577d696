"""Files that are the first measurement together are traced once, together."""

import math

import pytest
from app_jobs import tumble

from tumble.app.methods.dividing_head import job


@pytest.fixture
def traced(monkeypatch):
    """Rows of every table that is traced."""
    rows, explain = [], job.explain_questioned
    monkeypatch.setattr(
        job,
        "explain_questioned",
        lambda asked, *more: rows.append(len(asked.observations)) or explain(asked, *more),
    )
    return rows


def test_three_tables_are_traced_once(tmp_path, traced):
    for name, more in (("a", 0.0), ("b", 1e-5), ("c", 2e-5)):
        lines = [
            f"{angle},{2.5 - math.sin(math.radians(angle)) + 1e-4 * (angle % 7 - 3) + more}"
            for angle in range(0, 360, 15)
        ]
        (tmp_path / f"{name}.csv").write_text("\n".join(["angle_deg,voltage_V", *lines, ""]))

    files = [tmp_path / f"{name}.csv" for name in "abc"]
    tumble("close-loop", *files, "--serial", "SN1", "--store", tmp_path / "s", "--experiments", "1")

    assert traced[0] == 72
