"""What the channels of the platform are at rest, as functions of its place, time and temperature."""

from dataclasses import dataclass

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.gyro_platform.geometry import earth_rate_deg_h, table_axes
from tumble.drivers.simulated.gyro_platform.settings import Lean, SimulatedPlatform
from tumble.drivers.simulated.unit import REFERENCE_DEGC


@dataclass(frozen=True, kw_only=True)
class Placed:
    """The turntable's axes seen from the earth, and what the earth's rotation is along them; each shape (rows,)."""

    along_x_deg_h: FloatArray
    along_y_deg_h: FloatArray
    along_z_deg_h: FloatArray
    x_up: FloatArray
    level_rad: FloatArray
    """Angle b about x at which the platform's y axis is level."""

    @property
    def gamma_deg(self) -> FloatArray:
        """Tilt γ of the levelling axis, positive where it points down."""
        return np.asarray(np.rad2deg(np.arcsin(-self.x_up)))

    def azimuth_deg_h(self, beta_rad: FloatArray) -> FloatArray:
        """The earth's rotation along the platform's z axis where its y axis is off level by β."""
        turned_rad = self.level_rad + beta_rad
        return np.asarray(np.cos(turned_rad) * self.along_z_deg_h - np.sin(turned_rad) * self.along_y_deg_h)


class Platform:
    """The gyro and the tilt sensor on the turntable."""

    def __init__(self, settings: SimulatedPlatform) -> None:
        self._settings, self._effects = settings, settings.effects
        self._earth_deg_h = earth_rate_deg_h(settings.latitude_deg + settings.effects.latitude)

    def placed(self, lean: Lean, delta_rad: FloatArray, since_s: FloatArray) -> Placed:
        """Where everything points at true angles of the turntable and seconds since the world began."""
        yawed_deg = self._settings.alpha0_deg + self._effects.base_yaw * since_s / 3600.0
        x, y, z = table_axes(np.deg2rad(yawed_deg), lean, delta_rad)
        along = [axis @ self._earth_deg_h for axis in (x, y, z)]
        return Placed(
            along_x_deg_h=along[0],
            along_y_deg_h=along[1],
            along_z_deg_h=along[2],
            x_up=x[:, 2],
            level_rad=-np.arctan2(y[:, 2], z[:, 2]),
        )

    def drift_deg_h(self, placed: Placed, since_s: FloatArray, temperature_degc: FloatArray) -> FloatArray:
        """Drift of the levelling channel as far as it is no noise."""
        e, hours = self._effects, since_s / 3600.0
        warming = e.drift_warm_up.amplitude * np.exp(-since_s / e.drift_warm_up.tau_s)
        warmer_k = temperature_degc - REFERENCE_DEGC
        steady = self._settings.drift_deg_h + e.drift_ramp * hours + e.drift_temperature * warmer_k + warming
        return np.asarray(steady - e.g_unbalance * placed.x_up)

    def told_deg_h(self, rate_deg_h: FloatArray) -> FloatArray:
        """A rate as the torquer tells it."""
        e = self._effects
        bent = (
            e.torquer_scale * rate_deg_h + e.torquer_asymmetry * np.abs(rate_deg_h) + e.torquer_square * rate_deg_h**2
        )
        return np.asarray(rate_deg_h + bent)

    def told_tilt_deg(self, tilt_deg: FloatArray) -> FloatArray:
        """A tilt as its sensor tells it."""
        return np.asarray(tilt_deg * (1.0 + self._effects.tilt_scale) + self._effects.tilt_bias)
