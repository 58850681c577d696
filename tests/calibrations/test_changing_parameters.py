"""A parameter that structure without a name changes is stated with all that it is over the rows."""

import numpy as np
import pytest

from benchmarks.gyrocompass.__main__ import closed
from benchmarks.gyrocompass.effects import NOVEL
from benchmarks.gyrocompass.world import Design, make
from benchmarks.vibration import __main__ as vibration
from benchmarks.vibration.__main__ import drawn

TWELVE = Design(angles_deg=tuple(float(angle) for angle in range(0, 360, 30)), passes=3)


def inside(parameter, value):
    low, high = parameter.interval_95
    return low <= value <= high


@pytest.fixture(scope="module")
def bent():
    """A drift that bends in time, by up to 0.36 °/h from where it is least."""
    return make(np.random.default_rng(5), TWELVE, [], [(NOVEL["bend"][0], 1.0)], 0.0)


@pytest.fixture(scope="module")
def with_bent_drift(bent):
    return closed(bent.columns)


def test_a_drift_that_bends_is_found_along_the_time(with_bent_drift):
    assert (with_bent_drift.unexplained.channel, with_bent_drift.unexplained.depends_on) == ("offset", "time")


@pytest.mark.parametrize("part", [0.4, 0.1, 0.7])
def test_the_drift_may_be_what_it_is_at_any_time(bent, with_bent_drift, part):
    assert inside(with_bent_drift.augmented.parameters["drift"], bent.drift_deg_h + (part - 0.4) ** 2)


def test_it_says_so(with_bent_drift):
    drift, alpha0 = (with_bent_drift.augmented.parameters[name] for name in ("drift", "alpha0"))

    assert drift.remark.startswith("it changes with what has no name (an offset of the rate that follows the time")
    assert alpha0.remark == ""


def test_the_heading_is_as_certain_as_before(with_bent_drift):
    alpha0 = with_bent_drift.augmented.parameters["alpha0"]

    assert alpha0.standard_uncertainty < 1.5 * alpha0.type_a


def test_the_budget_says_by_how_much(with_bent_drift):
    (line,) = with_bent_drift.augmented_budget.lines
    drift = with_bent_drift.augmented.parameters["drift"]

    assert line.contributions["drift"] == pytest.approx(np.sqrt(drift.standard_uncertainty**2 - drift.type_a**2))


def test_of_a_rectification_that_falls_with_the_frequency_it_is_not_known_which_is_meant():
    _, made, _ = drawn("novel", 1_000_028)
    loop = vibration.closed(made)

    assert (loop.unexplained.channel, loop.unexplained.depends_on) == ("scale", "frequency")
    assert inside(loop.augmented.parameters["k_ii"], made.coefficients[0])
    assert inside(loop.augmented.parameters["k_oo"], made.coefficients[1])
    assert loop.augmented.parameters["k_oo"].standard_uncertainty < 0.1


@pytest.mark.parametrize("seed", [117, 153])
def test_the_ends_of_a_course_are_held_as_surely_as_its_middle(seed):
    _, made, _ = drawn("novel", vibration.SEEDS["development"] + seed)

    assert inside(vibration.closed(made).augmented.parameters["k_ii"], made.coefficients[0])


def test_four_frequencies_do_not_tell_how_wide_a_bump_is_and_the_interval_holds_every_width():
    """A mode of the fixture, 0.4 octaves wide; the bump that is stated is 0.6."""
    _, made, _ = drawn("novel", vibration.SEEDS["development"] + 130)
    k_ii = vibration.closed(made).augmented.parameters["k_ii"]

    assert abs(k_ii.value - made.coefficients[0]) > 3.0 * k_ii.type_a
    assert inside(k_ii, made.coefficients[0])
