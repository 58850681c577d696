"""What no row shows of structure without a name: where it is at rest."""

import numpy as np
import pytest
from tables import UNIT, gravity_on
from tracing_runs import FLIPS, SWEEP, programme, runs

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

RUN = programme(FLIPS, SWEEP.format("face-up", "up"), SWEEP.format("face-down", "up"), realisations=3)
STEEPNESS = 4e-3
"""Change of the scale factor, V/g."""


def ax_g(columns):
    """Along the input axis in both mounts of the sweeps; alpha0 and the other mounts' rows are left out of account."""
    return -np.sin(np.deg2rad(columns["angle_deg"]))


def inside(parameter, value):
    low, high = parameter.interval_95
    return low <= value <= high


@pytest.fixture(scope="module")
def stopped():
    """A stop that is touched from 0.5 g on, or one that is left there."""
    return close_loop(runs(RUN, extra_v=lambda columns: STEEPNESS * np.maximum(ax_g(columns) - 0.5, 0.0)))


def test_a_slope_from_a_place_on_is_found_along_the_acceleration(stopped):
    assert stopped.unexplained.depends_on == "acceleration"


@pytest.mark.parametrize("kx", [UNIT["kx"], UNIT["kx"] + STEEPNESS])
def test_it_may_as_well_end_there_so_that_both_scale_factors_are_possible(stopped, kx):
    assert inside(stopped.augmented.parameters["kx"], kx)


def test_what_has_nothing_to_do_with_it_is_as_certain_as_before(stopped):
    assert stopped.augmented.parameters["kxy"].standard_uncertainty < 1e-4


@pytest.fixture(scope="module")
def contact():
    """A contact that comes and goes, six times."""
    jumps_s = [150.0, 420.0, 560.0, 900.0, 1150.0, 1500.0]
    return close_loop(runs(RUN, extra_v=lambda columns: 8e-4 * (-1.0) ** np.searchsorted(jumps_s, columns["time_s"])))


@pytest.mark.parametrize("rest_v", [-8e-4, 8e-4])
def test_any_level_of_a_contact_that_comes_and_goes_may_be_that_of_rest(contact, rest_v):
    assert contact.unexplained.variable == "time"
    assert inside(contact.augmented.parameters["u0"], UNIT["u0"] + rest_v)


FADING_V = 5e-3
"""Of the cross term, at the moment of seating."""
LASTING_S = 40.0


@pytest.fixture(scope="module")
def seated():
    """A cross term that fades after the unit was seated."""

    def fading_v(columns):
        product_g2, since_s = np.empty(len(columns["mount"])), np.empty(len(columns["mount"]))
        seated_s = 0.0
        for row, (mount, angle_deg) in enumerate(zip(columns["mount"], columns["angle_deg"], strict=True)):
            if row == 0 or mount != columns["mount"][row - 1]:
                seated_s = columns["time_s"][row]
            since_s[row] = columns["time_s"][row] - seated_s
            ax_g, ay_g, _ = gravity_on(mount, np.array([angle_deg]))
            product_g2[row] = ax_g[0] * ay_g[0]
        return FADING_V * product_g2 * np.exp(-since_s / LASTING_S)

    return close_loop(runs(RUN, extra_v=fading_v))


def test_a_cross_term_that_fades_is_found_along_the_time_since_seating(seated):
    assert (seated.unexplained.channel, seated.unexplained.variable) == ("cross", "time_since_seating")
    assert not seated.effects


def test_the_cross_term_may_be_that_at_rest(seated):
    assert inside(seated.augmented.parameters["kxy"], UNIT["kxy"])


CREEP_V = 1e-3
"""What a spring gives back, once it has taken the set of an input of 1 g."""


@pytest.fixture(scope="module")
def crept():
    """A spring that remembers what acted on it for some two minutes."""

    def creeping_v(columns):
        ax_g = np.array(
            [
                gravity_on(mount, np.array([angle_deg]))[0][0]
                for mount, angle_deg in zip(columns["mount"], columns["angle_deg"], strict=True)
            ]
        )
        set_g, now_g = np.empty(len(ax_g)), ax_g[0]
        for row, waited_s in enumerate(np.diff(columns["time_s"], prepend=columns["time_s"][0])):
            now_g = ax_g[row] + (now_g - ax_g[row]) * np.exp(-waited_s / 130.0)
            set_g[row] = now_g
        return CREEP_V * (set_g - ax_g)

    return close_loop(runs(RUN, extra_v=creeping_v))


def test_a_spring_that_creeps_is_found_by_what_acted_on_it(crept):
    assert (crept.unexplained.channel, crept.unexplained.variable) == ("offset", "acceleration")
    assert not crept.effects


def test_the_scale_factor_is_that_before_it_creeps(crept):
    assert inside(crept.augmented.parameters["kx"], UNIT["kx"])
    assert crept.augmented.parameters["kx"].standard_uncertainty < CREEP_V / 4
