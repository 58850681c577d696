"""What is stated of a parameter holds over every explanation near the one that is stated."""

import numpy as np
import pytest
from tables import FLIPS, UNIT, gravity_on, output, sweep, table

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.tracing.averaged import Reach, averaged

TWO_MOUNTS = (*FLIPS, sweep("face-up"), sweep("face-down"))
ONE_MOUNT = (*FLIPS, sweep("face-up"))


def cubed(size_v):
    return lambda mount, angle_deg: size_v * gravity_on(mount, angle_deg)[0] ** 3


@pytest.fixture(scope="module")
def nearly_found():
    """A third-order term of some 6 noise units: too small to be stated, it moves kx by 7 standard uncertainties."""
    return close_loop(table(*TWO_MOUNTS, realisations=2, extra_v=cubed(8e-5)))


def test_an_effect_that_is_nearly_found_is_not_stated(nearly_found):
    assert nearly_found.effects == ()


def test_but_the_interval_of_what_it_moves_holds_the_truth(nearly_found):
    held = [
        low <= UNIT["kx"] <= high
        for low, high in (fit.parameters["kx"].interval_95 for fit in (nearly_found.declared, nearly_found.augmented))
    ]

    assert held == [False, True]


def test_the_budget_says_where_the_wider_interval_comes_from(nearly_found):
    line = nearly_found.augmented.budget[-1]
    fits = nearly_found.declared, nearly_found.augmented
    before, after = (fit.parameters["kx"].standard_uncertainty for fit in fits)

    assert line.contributions["kx"] == pytest.approx(np.sqrt(after**2 - before**2), rel=1e-6)


def test_what_nothing_else_would_move_stays_as_it_was(nearly_found):
    assert nearly_found.augmented.parameters["kxy"] == nearly_found.declared.parameters["kxy"]


def test_in_one_mount_values_hold_only_if_there_is_no_second_order_term():
    u0 = close_loop(table(*ONE_MOUNT, realisations=3)).augmented.parameters["u0"]

    assert u0.rests_on_absence
    assert u0.as_json()["given"] == {"k_xx": 0.0}
    assert u0.condition == "if there is no k_xx"


def test_in_several_mounts_no_value_rests_on_the_absence_of_anything():
    mounts = (sweep("face-up"), sweep("face-down"), sweep("edge"), sweep("edge-back"), sweep("end"))
    loop = close_loop(table(*FLIPS, *mounts, realisations=2))

    assert [name for name, each in loop.augmented.parameters.items() if each.rests_on_absence] == []


def test_what_it_is_at_an_unknown_place_moves_the_ends_of_an_interval():
    low, high = 0.8, 1.2
    stated = Parameter(
        name="bias",
        unit="V",
        value=1.0,
        standard_uncertainty=0.1,
        type_a=0.1,
        degrees_of_freedom=50.0,
        interval_95=(low, high),
    )

    after, (line,) = averaged({"bias": stated}, [], {}, {"bias": Reach(below=-0.5, above=2.0)})

    assert after["bias"].interval_95 == pytest.approx((low - 0.5, high + 2.0))
    assert line.contributions["bias"] > 0.0


def two_part_scale(error_deg):
    """What a head whose scale is in two parts adds: one half is too long, the other one is off, in volts."""

    def extra_v(mount, angle_deg):
        part = (angle_deg - 40.0) % 360.0 / 360.0
        error = error_deg * np.where(part < 0.5, 2.0 * part - 0.5, 0.2)
        return output(mount, angle_deg + error) - output(mount, angle_deg)

    return extra_v


def test_where_a_named_error_of_the_head_may_be_part_of_one_without_a_name_alpha0_holds_at_every_place():
    loop = close_loop(table(*TWO_MOUNTS, extra_v=two_part_scale(0.04)))
    alpha0 = loop.augmented.parameters["alpha0"]

    assert "head_eccentricity" in [each.name for each in loop.effects]
    assert loop.unexplained is not None
    assert alpha0.interval_95[0] <= UNIT["alpha0"] <= alpha0.interval_95[1]
    assert "the named error of the head may be a part of the one without a name" in alpha0.remark
