"""The course of structure without a name, as far as the rows know it."""

from functools import cache

import numpy as np
import pytest
from tables import FLIPS, output, sweep, table

from tumble.calibrations.methods.dividing_head.document import document
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

NOISE_V = 1e-4


def bump_deg(angle_deg):
    """A scar of the worm: the angle of the head is off near 140°."""
    return 0.03 * np.exp(-0.5 * ((angle_deg % 360.0 - 140.0) / 10.0) ** 2)


def scarred(mount, angle_deg):
    angle_deg = np.asarray(angle_deg, float)
    return output(mount, angle_deg + bump_deg(angle_deg)) - output(mount, angle_deg)


@cache
def traced():
    return close_loop(table(*FLIPS, sweep("face-up"), sweep("face-up-90"), noise_v=NOISE_V, extra_v=scarred))


@cache
def course():
    (one,) = traced().unexplained.courses
    return one


def test_it_says_what_changes_by_how_much_and_along_what():
    said = (course().channel, course().unit, course().variable, course().variable_unit)

    assert said == ("angle", "deg", "angle", "deg")


def test_there_is_a_value_for_every_setting_in_order():
    assert np.diff(course().at).min() > 0
    assert {140.0, 145.0, 150.0} <= set(course().at.tolist())


def test_it_is_where_the_structure_is():
    assert course().value == pytest.approx(bump_deg(course().at), abs=3e-3)


def test_near_the_structure_it_is_known_far_better_than_its_size():
    near = np.abs(course().at - 140.0) < 10.0

    assert np.all(course().standard_uncertainty[near] < 0.1 * 0.03)


def test_the_result_holds_it_so_that_a_reader_can_predict():
    (written,) = document(traced())["unexplained"]["courses"]

    assert set(written) == {
        "channel", "channel_detail", "unit", "variable", "detail", "variable_unit",
        "at", "value", "standard_uncertainty",
    }  # fmt: skip
    assert len(written["at"]) == len(written["value"]) == len(written["standard_uncertainty"])
