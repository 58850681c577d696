import csv
import json

import numpy as np
import pytest

from benchmarks.bank.dwells import dwells
from benchmarks.bank.geometry import AXES, projections


def table(shared, name):
    """Columns of an example table and its truth."""
    path = next((shared / "cases").glob(f"{name}-*.csv"))
    with path.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return {key: np.array([row[key] for row in rows]) for key in rows[0]}, json.loads(
        path.with_suffix(".truth.json").read_text(encoding="utf-8")
    )


@pytest.mark.parametrize(
    ("mount", "expected"),
    [
        ("face-up", (-0.5, -(0.75**0.5), 0.0)),
        ("face-up-90", (-(0.75**0.5), 0.5, 0.0)),
        ("face-down", (-0.5, 0.75**0.5, 0.0)),
        ("edge", (-0.5, 0.0, -(0.75**0.5))),
        ("edge-back", (-0.5, 0.0, 0.75**0.5)),
        ("end", (0.0, -0.5, -(0.75**0.5))),
    ],
)
def test_at_30_degrees_gravity_falls_as_the_contract_says(mount, expected):
    np.testing.assert_allclose(projections(AXES[mount][None], np.array([30.0]))[0], expected, atol=1e-12)


def test_a_z_end_below_the_horizon_shows_as_gravity_along_the_axis():
    ax, _, _ = projections(AXES["end"][None], np.array([0.0]), tilt_deg=1.0)[0]
    assert ax == pytest.approx(np.sin(np.deg2rad(1.0)))


@pytest.mark.parametrize("name", ["01", "02", "03", "10", "15", "16", "19"])
def test_a_design_has_the_rows_and_the_clock_of_an_independent_generator(shared, name):
    columns, truth = table(shared, name)
    made = dwells(truth["design"], truth["realisations"], np.random.default_rng(0))
    np.testing.assert_allclose(made.time_s, columns["time_s"].astype(float), atol=1e-6)
    np.testing.assert_array_equal(made.angle_deg, columns["angle_deg"].astype(float))
    np.testing.assert_array_equal(made.direction, columns["direction"].astype(int))
    np.testing.assert_array_equal(made.realisation, columns["realisation"].astype(int))
    np.testing.assert_array_equal(made.mount, columns["mount"])
    np.testing.assert_array_equal(made.procedure, columns["procedure"])


def test_a_shuffled_sweep_takes_the_same_angles_in_another_order_each_time():
    made = dwells("q", 2, np.random.default_rng(5))
    first, second = made.angle_deg[:80], made.angle_deg[80:]
    assert sorted(first) == sorted(second) == list(np.arange(0.0, 400.0, 5.0))
    assert not np.array_equal(first, second)


def test_a_dwell_after_a_change_of_mount_or_a_pause_follows_none():
    made = dwells("sf", 2, np.random.default_rng(0))
    assert np.flatnonzero(~made.follows).tolist() == [0, 4, 6, 86, 90, 92]


def test_an_unknown_block_is_refused_by_name():
    with pytest.raises(ValueError, match="no block x"):
        dwells("sx", 2, np.random.default_rng(0))
