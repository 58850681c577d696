import json

import numpy as np
import pytest

from tumble.calibrations.stand_records.corrections import corrections_from_map
from tumble.calibrations.stand_records.head_map import HeadMap, head_map_from_json

MAP = HeadMap(
    orders=(1, 3),
    coefficients_deg=np.array([0.03, 0.0, 0.0, 0.01, 0.005]),
    covariance_deg2=np.diag([1e-6, 1e-6, 4e-6, 4e-6, 9e-6]),
)


@pytest.mark.parametrize(
    ("angle_deg", "error_deg"), [(0.0, 0.01), (90.0, 0.03), (30.0, 0.015), (390.0, 0.015), (-270.0, 0.03)]
)
def test_the_error_is_the_sum_of_its_harmonics_in_any_revolution(angle_deg, error_deg):
    assert MAP.error_deg(np.array([angle_deg])) == pytest.approx([error_deg])


def test_backlash_adds_after_moves_in_minus_direction_alone():
    assert MAP.error_deg(np.zeros(3), np.array([-1, 0, 1])) == pytest.approx([0.015, 0.01, 0.01])


def test_the_uncertainty_is_that_of_the_coefficients_at_the_angle():
    assert MAP.standard_uncertainty_deg(np.array([0.0])) == pytest.approx([np.sqrt(5e-6)])
    assert MAP.standard_uncertainty_deg(np.array([0.0]), -1) == pytest.approx([np.sqrt(14e-6)])


def test_correlated_coefficients_may_cancel():
    covariance = np.array([[1e-6, -1e-6, 0.0], [-1e-6, 1e-6, 0.0], [0.0, 0.0, 0.0]])
    together = HeadMap(orders=(1,), coefficients_deg=np.zeros(3), covariance_deg2=covariance)

    assert together.standard_uncertainty_deg(np.array([45.0])) == pytest.approx([0.0], abs=1e-12)


def test_a_curve_goes_once_round():
    curve = MAP.curve(direction=-1, step_deg=90.0)

    assert curve.angle_deg.tolist() == [0.0, 90.0, 180.0, 270.0, 360.0]
    assert curve.error_deg == pytest.approx([0.015, 0.035, -0.005, -0.025, 0.015])
    assert curve.standard_uncertainty_deg.shape == (5,)


def test_a_map_comes_back_from_json():
    again = head_map_from_json(json.loads(json.dumps(MAP.as_json())))

    assert again.orders == MAP.orders
    assert again.coefficients_deg.tolist() == MAP.coefficients_deg.tolist()
    assert again.covariance_deg2.tolist() == MAP.covariance_deg2.tolist()


def test_a_map_from_elsewhere_becomes_corrections_and_comes_back():
    corrections = corrections_from_map(MAP)

    assert [term.effect for term in corrections.terms] == ["head_eccentricity", "graduation", "backlash"]
    assert corrections.head_map.error_deg(np.arange(0.0, 360.0, 7.0), -1) == pytest.approx(
        MAP.error_deg(np.arange(0.0, 360.0, 7.0), -1)
    )


def test_a_map_that_knows_nothing_of_backlash_has_no_term_for_it():
    silent = HeadMap(
        orders=(2,), coefficients_deg=np.array([0.01, 0.0, 0.0]), covariance_deg2=np.diag([1e-6, 1e-6, 0.0])
    )

    assert [term.effect for term in corrections_from_map(silent).terms] == ["head_second_harmonic"]
