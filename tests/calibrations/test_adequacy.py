import numpy as np
import pytest
from tables import FLIPS, sweep, table

from tumble.calibrations.core.adequacy import lack_of_fit, told_without
from tumble.calibrations.core.repeats import PureError
from tumble.calibrations.methods.dividing_head.flips import flip_closure
from tumble.calibrations.methods.dividing_head.held_out import held_out_parts
from tumble.calibrations.methods.dividing_head.observations import Observations

NO_KXY = {"u0": 2.5, "kx": 1.0, "ky": 0.01, "kz": 0.002, "kxy": 0.0, "alpha0": 0.0}


def test_lack_of_fit_is_the_classical_f_test():
    # Draper and Smith, Applied Regression Analysis, 3rd edition, 2.1: 24 observations, pure error 7.055 on 10 dof,
    # lack of fit 8.233 on 11 dof... here the ratio is 1.061 and not significant.
    lack = lack_of_fit(7.055 + 8.233, 23, 2, PureError(variance=0.7055, degrees_of_freedom=10))

    assert lack.degrees_of_freedom == 11
    assert lack.variance / 0.7055 == pytest.approx(1.061, abs=0.001)
    assert 0.4 < lack.p_value < 0.6


def test_without_spare_poses_there_is_no_test():
    assert lack_of_fit(1.0, 10, 4, PureError(variance=0.1, degrees_of_freedom=6)).p_value is None


def test_without_repeats_there_is_no_test():
    assert lack_of_fit(1.0, 10, 4, PureError(variance=float("nan"), degrees_of_freedom=0)).p_value is None


def close(rows, sigma_v=1e-3, freedom=18):
    return flip_closure(rows, np.zeros(len(rows)), PureError(variance=sigma_v**2, degrees_of_freedom=freedom))


def test_the_flips_of_a_linear_unit_close():
    closure = close(table(*FLIPS, realisations=2, noise_v=0.0, unit=NO_KXY))

    assert [mean.u0_v for mean in closure.axes.values()] == pytest.approx([2.5, 2.5, 2.5])
    assert closure.p_value == pytest.approx(1.0)


def test_the_mean_of_a_flip_has_half_the_uncertainty_of_its_poles():
    closure = close(table(*FLIPS, realisations=2, noise_v=0.0, unit=NO_KXY))

    assert closure.axes["x"].standard_uncertainty_v == pytest.approx(1e-3 * np.sqrt(1 / 2 + 1 / 2) / 2)


def test_a_second_order_term_shows_in_the_x_flip_alone():
    def kxx(mount, angle_deg):
        return np.where(np.abs(np.abs(angle_deg) - 90.0) < 1.0, 0.006, 0.0)

    closure = close(table(*FLIPS, realisations=4, noise_v=0.0, unit=NO_KXY, extra_v=kxx))

    assert closure.axes["x"].u0_v == pytest.approx(2.506)
    assert closure.worst[0] == "x"
    assert closure.worst[2] == pytest.approx(0.006)
    assert closure.p_value < 1e-6


def test_without_a_complete_flip_there_is_no_closure():
    assert close(table(("flip", "face-up", [-90.0]))) is None


def test_one_flip_alone_has_nothing_to_agree_with():
    closure = close(table(FLIPS[0], noise_v=0.0))

    assert (closure.p_value, closure.worst) == (None, None)


def test_without_a_procedure_column_rows_at_the_poles_are_taken_as_flips():
    rows = table(sweep("face-up"), noise_v=0.0, unit=NO_KXY)
    closure = close(Observations(**{**vars(rows), "procedure": None}))

    assert set(closure.axes) == {"x", "y"}


def test_repeats_of_a_setting_are_held_out_together():
    rows = table(("sweep", "face-up", np.arange(0.0, 360.0, 40.0)), realisations=3)
    parts = held_out_parts(rows)
    assert [sorted(set(rows.angle_deg[out].tolist())) for out in parts] == [[40.0 * place] for place in range(9)]


def test_of_many_settings_every_third_is_held_out():
    assert len(held_out_parts(table(("sweep", "face-up", np.arange(0.0, 360.0, 5.0)), realisations=2))) == 3


def test_a_setting_without_which_the_rest_tells_less_is_not_predicted():
    columns = np.array([[1.0, 0.0], [1.0, 0.0], [1.0, 0.0], [1.0, 1.0]])
    assert told_without(columns, np.array([True, False, False, False]))
    assert not told_without(columns, np.array([False, False, False, True]))


def test_it_takes_more_rows_than_the_model_has_numbers():
    assert not told_without(np.ones((2, 1)), np.array([True, False]))
