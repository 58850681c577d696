"""What the stand adds to the scatter of the data (GUM, type B), as errors of the rows."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.budget import Source, not_included
from tumble.calibrations.core.repeats import settings
from tumble.calibrations.methods.gyrocompass.geometry import up_rate
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class TurntableUncertainty:
    """Standard uncertainties of a stand; None where they are not stated."""

    azimuth_deg: float | None = None
    """Reading of the pickoff: one error for every setting of it, the same whenever it is set."""
    tilt_deg: float | None = None
    """Bias of the tilt sensor, common to all dwells: a drift of ωζ times it."""
    latitude_deg: float | None = None
    torquer_scale: float | None = None
    """Relative, common to all rates."""

    @property
    def left_out(self) -> str:
        """That what the stand adds, or which part of it, is not in the stated uncertainty; empty where all of it is."""
        stated = {
            "azimuth": self.azimuth_deg,
            "tilt": self.tilt_deg,
            "latitude": self.latitude_deg,
            "torquer scale": self.torquer_scale,
        }
        nothing = Message(
            "the stand's contribution is not included in the stated uncertainty: nothing says what {keys} add",
            keys=", ".join(stated),
        )
        return not_included(stated, nothing)


def sources(scene: GyrocompassScene, stand: TurntableUncertainty) -> tuple[Source, ...]:
    """Sources of type B with a size above zero, for the rows of a scene."""
    return tuple(source for source in _listed(scene, stand) if np.any(source.errors_v))


def _listed(scene: GyrocompassScene, stand: TurntableUncertainty) -> Iterator[Source]:
    rows, ones = scene.observations, np.ones(scene.dwells)
    yield Source(
        name=Message("reading of the pickoff"),
        symbol=Message("{arcsec:g}″ at every setting", arcsec=round(3600 * (stand.azimuth_deg or 0.0), 6)),
        errors_v=scene.turned(np.deg2rad(ones * (stand.azimuth_deg or 0.0)))[:, None],
        shared_by=np.repeat(settings(rows.azimuth_deg % 360.0), scene.outputs),
    )
    per_degree = np.deg2rad(1.0) * up_rate(rows.latitude_deg) * np.sqrt(1.0 - scene.sin_tilt**2)
    yield Source(
        name=Message("bias of the tilt sensor"),
        symbol=f"{stand.tilt_deg or 0.0:g}°",
        errors_v=scene.in_rows(per_degree * (stand.tilt_deg or 0.0))[:, None],
    )
    per_latitude = -np.deg2rad(1.0) * np.tan(np.deg2rad(rows.latitude_deg)) * scene.earth_deg_h
    yield Source(
        name=Message("stated latitude"),
        symbol=f"{stand.latitude_deg or 0.0:g}°",
        errors_v=scene.in_rows(per_latitude * (stand.latitude_deg or 0.0))[:, None],
    )
    yield Source(
        name=Message("scale factor of the torquer"),
        symbol=Message("{size:g} relative", size=stand.torquer_scale or 0.0),
        errors_v=scene.in_rows(scene.rate_deg_h * (stand.torquer_scale or 0.0))[:, None],
    )
