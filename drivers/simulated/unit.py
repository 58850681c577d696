"""The unit under test: its output as a function of gravity, temperature and time, without noise."""

from typing import Protocol

import numpy as np

from tumble.drivers.simulated.effects import UnitEffects
from tumble.drivers.simulated.external import Response
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.presets import UnitParameters

REFERENCE_DEGC = 23.0
"""Temperature to which the parameters refer."""


class Unit(Protocol):
    """Anything that answers gravity with a voltage."""

    def static_v(self, gravity_g: FloatArray) -> FloatArray:
        """Output for projections (ax, ay, az), shape (rows, 3), at 23 °C and free of every effect of time."""
        ...

    def voltage_v(self, gravity_g: FloatArray, temperature_degc: FloatArray, time_s: FloatArray) -> FloatArray:
        """Output, shape (rows,); temperature and time have that shape, gravity that or a single row."""
        ...


class Accelerometer:
    """Static response after IEEE 1293, with the seed's sign: a is +1 where an axis points down.

    `u = u0 + kx ax + ky ay + kz az + kxy ax ay + kxx ax² + kyy ay² + kzz az² + kxz ax az + kyz ay az + kxxx ax³
    + kasym |ax|`; bias and scale factor then follow temperature and time, and the bias warms up.
    """

    def __init__(self, parameters: UnitParameters, effects: UnitEffects) -> None:
        p, e = parameters, effects
        linear = [p.u0, p.kx, p.ky, p.kz]
        cross = [p.kxy, e.k_xz, e.k_yz]
        higher = [e.k_xx, e.k_yy, e.k_zz, e.k_xxx, e.scale_asymmetry]
        self._coefficients = np.array([*linear, *cross, *higher])
        self._effects = effects

    def static_v(self, gravity_g: FloatArray) -> FloatArray:
        """Output at 23 °C, settled, without drift."""
        ax, ay, az = gravity_g.T
        linear = [np.ones_like(ax), ax, ay, az]
        cross = [ax * ay, ax * az, ay * az]
        higher = [ax**2, ay**2, az**2, ax**3, np.abs(ax)]
        return np.asarray(self._coefficients @ np.array([*linear, *cross, *higher]))

    def voltage_v(self, gravity_g: FloatArray, temperature_degc: FloatArray, time_s: FloatArray) -> FloatArray:
        """Output with temperature, drift and warm-up."""
        e = self._effects
        warmer_k, hours = temperature_degc - REFERENCE_DEGC, time_s / 3600.0
        bias_v = e.bias_temperature * warmer_k + e.bias_drift * hours
        scale_v_per_g = e.scale_temperature * warmer_k + e.scale_drift * hours
        if e.warm_up:
            bias_v = bias_v + e.warm_up.amplitude * np.exp(-time_s / e.warm_up.tau_s)
        return np.asarray(self.static_v(gravity_g) + bias_v + scale_v_per_g * gravity_g[:, 0])


class ExternalUnit:
    """A unit whose physics is somebody else's function."""

    def __init__(self, response: Response) -> None:
        self._response = response

    def static_v(self, gravity_g: FloatArray) -> FloatArray:
        """Output at 23 °C and time zero."""
        rows = len(gravity_g)
        return self.voltage_v(gravity_g, np.full(rows, REFERENCE_DEGC), np.zeros(rows))

    def voltage_v(self, gravity_g: FloatArray, temperature_degc: FloatArray, time_s: FloatArray) -> FloatArray:
        """Output of the function, called for each row with plain numbers."""
        projections_g = np.broadcast_to(gravity_g, (len(time_s), 3)).tolist()
        rows = zip(projections_g, temperature_degc.tolist(), time_s.tolist(), strict=True)
        return np.array([float(self._response(ax, ay, az, degc, second)) for (ax, ay, az), degc, second in rows])


class Hysteresis:
    """Memory of how ax was last approached, independent of rate: a Prandtl-Ishlinskii sum of four plays.

    A play of reach r is a slack coupling: `w = max(ax - r, min(ax + r, w))`. It is dragged along r behind ax and
    stands still while ax turns back by less than 2 r. The offset is the half gap times the mean of `(w - ax) / r`:
    minus the half gap once ax rose far enough, plus the half gap once it fell, so that the output lags. The reaches are
    a quarter, a half, three quarters and the whole of `reach_g`; a change of ax by twice `reach_g` reverses all.
    """

    def __init__(self, *, half_gap_v: float, reach_g: float, ax_g: float) -> None:
        self._half_gap_v = half_gap_v
        self._reach_g = reach_g * np.array([0.25, 0.5, 0.75, 1.0])
        self._play_g = np.full(4, ax_g)
        self.offset_v = 0.0
        """What the memory adds to the output now."""

    def follow(self, ax_g: float) -> None:
        """Take ax to another value, without turning back on the way."""
        self._play_g = np.maximum(ax_g - self._reach_g, np.minimum(ax_g + self._reach_g, self._play_g))
        self.offset_v = self._half_gap_v * float(np.mean((self._play_g - ax_g) / self._reach_g))
