"""Heading and drift in a declared noise: at the bound, with intervals that cover; figures of the field."""

import numpy as np
import pytest

from benchmarks.gyrocompass.__main__ import write
from benchmarks.gyrocompass.bounds import NOISES, ORDERS, measured
from benchmarks.gyrocompass.world import Design, make
from tumble.calibrations.methods.gyrocompass import figures
from tumble.calibrations.methods.gyrocompass.heading import estimated
from tumble.calibrations.methods.gyrocompass.lean import Lean
from tumble.calibrations.methods.gyrocompass.loop import close_gyrocompass_loop
from tumble.calibrations.methods.gyrocompass.observations import read_gyrocompass_table
from tumble.calibrations.methods.gyrocompass.sections import sections


@pytest.mark.parametrize("noise", NOISES)
def test_the_bound_is_reached_and_intervals_cover(noise):
    ratio, covered = measured(ORDERS["0/180/90/270"] * 4, NOISES[noise], 8_000, np.random.default_rng(1))

    assert ratio == pytest.approx([1.0, 1.0], abs=0.03)
    assert covered == pytest.approx([0.95, 0.95], abs=0.01)


def test_rates_without_noise_give_heading_and_drift_back():
    delta = np.deg2rad([0.0, 90.0, 200.0, 300.0])
    lean = Lean(cosine=np.zeros(4), sine=np.zeros(4))
    rate = 9.577 * np.sin(np.deg2rad(-130.0) + delta) * 15.041068 * np.cos(np.deg2rad(50.0)) / 9.577 + 3.0

    found = estimated(rate, delta, np.full(4, 50.0), lean, np.diag([1.0, 2.0, 1.0, 3.0]))

    assert (found.alpha0_deg, found.drift_deg_h) == pytest.approx((-130.0, 3.0), abs=1e-9)
    assert found.standard_uncertainties.shape == (2,)


@pytest.fixture(scope="module")
def loop(tmp_path_factory):
    path = tmp_path_factory.mktemp("gyro") / "table.csv"
    write(path, make(np.random.default_rng(8), Design(angles_deg=(0.0, 90.0, 180.0, 270.0), passes=2)).columns)
    return close_gyrocompass_loop(read_gyrocompass_table(path))


@pytest.mark.parametrize("draw", [figures.heading_circle, figures.rate_figure, figures.drift_figure])
def test_figures_are_drawn(loop, draw):
    picture = draw(loop).__html__()
    assert picture.startswith("<svg ")
    assert 'role="img"' in picture


def test_the_answer_comes_first_and_every_picture_has_a_caption(loop):
    shown = list(sections(loop))

    assert shown[0].lines == ["Nothing is left that the scatter of the data does not explain."]
    assert [str(each.title) for each in shown if each.figure] == ["Heading circle", "Rate against azimuth", "Drift"]
    assert all(each.caption for each in shown if each.figure)
