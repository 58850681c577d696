"""Whether a form without a name differs from the catalogue of a triad in the rows of a table."""

import numpy as np
import pytest

from benchmarks.triad.apart import NOT_PARTED, Seen
from benchmarks.triad.novel import NOVEL_STAND, NOVEL_UNIT
from benchmarks.triad.world import make
from tumble.calibrations.methods.triad.programmes import POSITIONS

NOISE_V = (1e-5, 1e-5, 1e-5)


def seen(kind, size, positions):
    draw, _ = {**NOVEL_UNIT, **NOVEL_STAND}[kind]
    form = draw(np.random.default_rng(1))
    stand, unit = ([(form, size)], []) if kind in NOVEL_STAND else ([], [(form, size)])
    return Seen(make(np.random.default_rng(2), positions, 3, NOISE_V, stand, unit))


@pytest.mark.parametrize("kind", ["saturation", "quartic", "fifth_order"])
def test_in_steps_of_45_degrees_the_catalogue_has_every_course_of_the_input(kind):
    assert seen(kind, 1e-3, POSITIONS["24"]).left_by_two() < NOT_PARTED


@pytest.mark.parametrize("kind", ["saturation", "quartic", "fifth_order"])
def test_with_positions_between_it_lacks_them(kind):
    assert seen(kind, 1e-3, (*POSITIONS["24"], *POSITIONS["fine"])).left_by_two() > NOT_PARTED


def test_it_lacks_a_third_harmonic_of_an_axis():
    assert seen("third_harmonic", 30.0, POSITIONS["24"]).left_by_two() > NOT_PARTED


def test_what_follows_the_time_follows_no_angle():
    variables = seen("jump", 1e-4, POSITIONS["24"]).variables("time")

    assert "time" in variables
    assert not variables & {"angle", "acceleration", "direction"}
