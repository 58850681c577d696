"""The output of an accelerometer as a function of the acceleration in its axes, in g."""

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.vibration.settings import SimulatedVibration


class Pendulum:
    """`y = Ai + 1e-6 (bias + Kii Ai² + Koo Ao² + Kpp Ap² + Kio Ai Ao + Kip Ai Ap + Kiii Ai³ + Kiiii Ai⁴)`.

    A is the whole acceleration, gravity and vibration. Above the limit of `clipping` the output stops.
    """

    def __init__(self, settings: SimulatedVibration) -> None:
        self._p, self._effects = settings.unit_parameters, settings.effects

    def output_g(self, acceleration_g: FloatArray) -> FloatArray:
        """Output at accelerations of the shape (rows, 3), axes i, o, p."""
        p, e = self._p, self._effects
        i, o, s = acceleration_g.T
        squares = p["k_ii"] * i**2 + p["k_oo"] * o**2 + p["k_pp"] * s**2 + p["k_io"] * i * o + p["k_ip"] * i * s
        bent_ug = squares + e.k_iii.value * i**3 + e.k_iiii.value * i**4
        output_g = i + 1e-6 * (p["bias"] + bent_ug)
        return np.asarray(output_g if e.clipping is None else np.minimum(output_g, e.clipping.limit_g))
