"""Heading and drift in the noise that columns of a table declare of the gyro, at the Cramér-Rao bound."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.gyrocompass.__main__ import write
from benchmarks.gyrocompass.effects import STAND
from benchmarks.gyrocompass.world import Design, make
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.methods.gyrocompass.declared_noise import declared
from tumble.calibrations.methods.gyrocompass.document import document
from tumble.calibrations.methods.gyrocompass.loop import close_gyrocompass_loop
from tumble.calibrations.methods.gyrocompass.observations import read_gyrocompass_table
from tumble.calibrations.methods.gyrocompass.sections import sections

FOUR = Design(angles_deg=(0.0, 90.0, 180.0, 270.0), passes=3, lean_deg=0.3)
WHITE = 0.01 * np.sqrt(60.0 / 3600.0)
"""N, in °/√h, of 0.01 °/h in dwells of 60 s."""


def loop_of(folder, sizes=(), **noise):
    made = make(np.random.default_rng(3), FOUR, [(STAND[name], size) for name, size in sizes])
    columns = {name: np.full(len(made.columns["time_s"]), size) for name, size in noise.items()}
    write(folder / "table.csv", made.columns | columns)
    return made, close_gyrocompass_loop(read_gyrocompass_table(folder / "table.csv"))


def said(loop):
    (shown,) = (each for each in sections(loop) if each.title == "In the declared noise")
    return list(shown.lines)


def test_white_noise_gives_the_bound(tmp_path):
    made, loop = loop_of(tmp_path, angle_random_walk_deg_sqrt_h=WHITE)

    found = loop.in_declared_noise

    dwells, north_deg_h = len(made.columns["time_s"]), 15.041068 * np.cos(np.deg2rad(made.platform.latitude_deg))
    bound_deg = np.rad2deg(0.01 / north_deg_h / np.sqrt(dwells / 2.0))
    assert found.standard_uncertainties["alpha0"] == pytest.approx(bound_deg, rel=0.01)
    assert found.standard_uncertainties["drift"] == pytest.approx(0.01 / np.sqrt(dwells), rel=0.01)
    assert abs(found.values["alpha0"] - made.platform.alpha0_deg) < 3.0 * bound_deg
    assert not found.contradicted


def test_what_was_found_is_fitted_beside(tmp_path):
    made, loop = loop_of(tmp_path, [("backlash", 0.3)], angle_random_walk_deg_sqrt_h=WHITE)

    found = loop.in_declared_noise

    assert abs(found.values["alpha0"] - made.platform.alpha0_deg) < 3.0 * found.standard_uncertainties["alpha0"]
    assert not found.contradicted


def test_a_gyro_that_scatters_more_than_declared_is_said_to(tmp_path):
    _, loop = loop_of(tmp_path, angle_random_walk_deg_sqrt_h=WHITE / 3.0)

    assert loop.in_declared_noise.contradicted
    assert said(loop)[1] == "The gyro is not as declared: its rates scatter 2.9 times as much. Correct its noise."


def test_a_table_that_declares_nothing_says_nothing(tmp_path):
    _, loop = loop_of(tmp_path)

    assert document(loop)["declared_noise"] is None
    assert said(loop) == []


def test_a_correlation_time_alone_is_no_noise(tmp_path):
    _, loop = loop_of(tmp_path, correlation_s=1000.0)

    assert declared(loop.observations) is None


def test_overlapping_dwells_have_no_covariance_of_their_means(tmp_path):
    made, _ = loop_of(tmp_path)
    noisy = made.columns | {"angle_random_walk_deg_sqrt_h": np.full(len(made.columns["time_s"]), WHITE)}
    write(tmp_path / "table.csv", noisy)
    rows = read_gyrocompass_table(tmp_path / "table.csv")

    assert close_gyrocompass_loop(replace(rows, dwell_s=20.0 * rows.dwell_s)).in_declared_noise is None


@pytest.mark.parametrize("size", [-1e-3, float("inf"), 1e-300, 1e200])
def test_a_size_that_no_gyro_has_is_refused_with_its_place(tmp_path, size):
    with pytest.raises(TableError, match=r"line 2, column angle_random_walk_deg_sqrt_h: .* leave the column out"):
        loop_of(tmp_path, angle_random_walk_deg_sqrt_h=size)


@pytest.mark.parametrize("correlation_s", [-1000.0, 0.0])
def test_a_correlation_time_is_above_zero(tmp_path, correlation_s):
    with pytest.raises(TableError, match=r"line 2, column correlation_s: "):
        loop_of(tmp_path, gauss_markov_deg_h=0.2, correlation_s=correlation_s)


def test_two_gyros_in_one_table_are_refused(tmp_path):
    made, _ = loop_of(tmp_path)
    sizes = np.full(len(made.columns["time_s"]), WHITE)
    sizes[4] *= 2.0
    write(tmp_path / "table.csv", made.columns | {"angle_random_walk_deg_sqrt_h": sizes})

    with pytest.raises(TableError, match=r"line 6, column angle_random_walk_deg_sqrt_h: .* the same in every row"):
        read_gyrocompass_table(tmp_path / "table.csv")


def test_the_place_is_the_line_of_the_file_comments_counted(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text(
        "# by hand\nazimuth_deg,rate_deg_h,latitude_deg,correlation_s\n0,1,50,10\n\n# turned\n90,2,50,-1\n", "utf-8"
    )

    with pytest.raises(TableError, match=r"line 6, column correlation_s: -1 is nothing"):
        read_gyrocompass_table(path)


def test_a_declared_noise_that_cannot_be_used_is_said(tmp_path):
    made, _ = loop_of(tmp_path)
    count = len(made.columns["time_s"])
    changed = {"angle_random_walk_deg_sqrt_h": np.full(count, WHITE), "dwell_s": np.full(count, -60.0)}
    write(tmp_path / "table.csv", made.columns | changed)

    (warning,) = read_gyrocompass_table(tmp_path / "table.csv").warnings

    assert "the declared noise is not used" in str(warning)
