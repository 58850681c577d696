import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from tables import FLIPS, UNIT, output, sweep, table

from tumble.calibrations.methods.dividing_head.model import PARAMETERS, basis, coefficients, coefficients_jacobian

EVERYWHERE = (*FLIPS, *(sweep(m, 20.0) for m in ("face-up", "face-down", "face-up-90", "edge", "edge-back", "end")))
small = st.floats(-0.1, 0.1)


def theta(unit):
    return np.array([unit[name] for name in PARAMETERS])


@given(small, small, small, st.floats(-44, 44))
def test_the_basis_reproduces_the_model_at_any_alpha0(ky, kz, kxy, alpha0):
    unit = {"u0": 2.5, "kx": 1.1, "ky": ky, "kz": kz, "kxy": kxy, "alpha0": alpha0}
    rows = table(*EVERYWHERE, realisations=1, noise_v=0.0, unit=unit)

    assert basis(rows) @ coefficients(theta(unit)) == pytest.approx(rows.voltage_v, abs=1e-12)


def test_the_jacobian_is_the_slope_of_the_coefficients():
    at = theta(UNIT)
    step = 1e-6
    numeric = [(coefficients(at + step * e) - coefficients(at - step * e)) / (2 * step) for e in np.eye(6)]

    assert coefficients_jacobian(at) == pytest.approx(np.column_stack(numeric), abs=1e-8)


def test_fourier_coefficients_of_the_sweep_are_those_of_equation_15():
    unit = dict(UNIT, alpha0=3.0, kxy=0.02)
    alpha = np.deg2rad(np.arange(0.0, 360.0, 5.0))
    volts = output("face-up", np.rad2deg(alpha), unit)
    a0 = np.deg2rad(3.0)

    assert np.mean(volts * np.sin(alpha)) * 2 == pytest.approx(unit["ky"] * np.sin(a0) - unit["kx"] * np.cos(a0))
    assert np.mean(volts * np.sin(2 * alpha)) * 2 == pytest.approx(0.01 * np.cos(2 * a0))
    assert np.mean(volts * np.cos(2 * alpha)) * 2 == pytest.approx(0.01 * np.sin(2 * a0))
