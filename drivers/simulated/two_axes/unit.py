"""Three accelerometers in one case: outputs as a function of gravity, temperature and time, without noise."""

from typing import Final

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.two_axes.geometry import RAD_PER_ARCSEC
from tumble.drivers.simulated.two_axes.settings import SimulatedTwoAxes
from tumble.drivers.simulated.unit import REFERENCE_DEGC

AXES: Final = ("x", "y", "z")


class Accelerometers:
    """`u_c = bias_c + scale_c (a_c + Σ m_cj a_j) + k a_p a_q + …` for each channel c."""

    def __init__(self, settings: SimulatedTwoAxes) -> None:
        p = settings.unit_parameters
        self._effects = settings.effects
        self._bias_v = np.array([p["bias_x"], p["bias_y"], p["bias_z"]])
        scale = np.array([p["scale_x"], p["scale_y"], p["scale_z"]])
        m_arcsec = np.array([[0.0, p["m_xy"], p["m_xz"]], [p["m_yx"], 0.0, p["m_yz"]], [p["m_zx"], p["m_zy"], 0.0]])
        self._slopes = scale[:, np.newaxis] * (np.eye(3) + RAD_PER_ARCSEC * m_arcsec)
        self._mixing = np.eye(3) + np.array(settings.crosstalk)

    def outputs_v(self, gravity: FloatArray, temperature_degc: FloatArray, time_s: FloatArray) -> FloatArray:
        """Outputs, shape (rows, 3); gravity has that shape, or a single row."""
        e = self._effects
        warmer_k, hours = (temperature_degc - REFERENCE_DEGC)[:, np.newaxis], (time_s / 3600.0)[:, np.newaxis]
        bias_v = self._bias_v + warmer_k * e.bias_temperature.values + hours * e.bias_drift.values
        bias_v = bias_v + np.exp(-time_s / e.warm_up.tau_s)[:, np.newaxis] * e.warm_up.values
        changed_v_per_g = warmer_k * e.scale_temperature.values + hours * e.scale_drift.values
        linear_v = gravity @ self._slopes.T + changed_v_per_g * gravity
        return np.asarray((bias_v + linear_v + self._bent_v(gravity)) @ self._mixing.T)

    def _bent_v(self, gravity: FloatArray) -> FloatArray:
        """What is not linear in gravity."""
        bent_v = np.zeros_like(gravity)
        for name, value in self._effects.coefficients.items():
            channel, _, kind = name.partition(".")
            own = AXES.index(channel)
            powers = [gravity[:, AXES.index(axis)] for axis in kind.removeprefix("k_")] if kind[0] == "k" else None
            bent_v[:, own] += value * (np.abs(gravity[:, own]) if powers is None else np.prod(powers, axis=0))
        return bent_v
