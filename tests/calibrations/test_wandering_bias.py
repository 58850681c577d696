"""A bias that is taken for a random walk may be any other course: its rest is then not its mean over the rows."""

from dataclasses import replace
from functools import cache

import numpy as np
from tables import FLIPS, UNIT, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop


def late_heat(time_s):
    """Heat that arrives in the middle of the run and leaves."""
    since = np.maximum(time_s / time_s[-1] - 0.4, 0.0)
    return 3e-4 * (np.exp(-since / 0.2) - np.exp(-since / 0.04))


def warmed(time_s):
    """A room that is warmed from the middle of the run on, and cools."""
    part = time_s / time_s[-1]
    return 2e-4 * np.where(part > 0.4, np.sin(np.pi * (part - 0.4) / 0.6), 0.0)


def walked(time_s):
    """A random walk less its mean over the rows."""
    course = np.cumsum(np.random.default_rng(7).normal(size=len(time_s))) * 2e-5
    return course - course.mean()


def wandering(course):
    rows = table(*FLIPS, sweep("face-up", 20.0), sweep("face-down", 20.0), realisations=2, noise_v=5e-5)
    time_s = 20.0 * np.arange(len(rows), dtype=float)
    return close_loop(replace(rows, time_s=time_s, voltage_v=rows.voltage_v + course(time_s)))


@cache
def in_the_warmed_room():
    return wandering(warmed)


def test_the_interval_of_the_bias_holds_where_it_rests():
    low, high = in_the_warmed_room().augmented.parameters["u0"].interval_95

    assert [effect.name for effect in in_the_warmed_room().effects] == ["bias_random_walk"]
    assert low <= UNIT["u0"] <= high


def test_the_other_parameters_are_known_as_well_as_ever():
    assert in_the_warmed_room().augmented.parameters["kx"].standard_uncertainty < 1e-5


def test_heat_that_arrives_late_is_found_as_what_it_is_and_the_bias_is_what_it_was_before():
    loop = wandering(late_heat)
    u0 = loop.augmented.parameters["u0"]

    assert (loop.effects, loop.unexplained.variable) == ((), "time")
    assert "gone within" in loop.unexplained.description
    assert abs(u0.value - UNIT["u0"]) < 5e-6


def test_of_a_walk_it_holds_the_mean_over_the_rows():
    low, high = wandering(walked).augmented.parameters["u0"].interval_95

    assert low <= UNIT["u0"] <= high
