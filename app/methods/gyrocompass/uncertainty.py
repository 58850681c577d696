"""What the stand file of a turntable with a gyro platform adds to the budget of heading and drift."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Final

import numpy as np

from tumble.app.measurement import Measurement
from tumble.app.stand_file import RecordedDaq, RecordedHead, RecordedStand
from tumble.calibrations.methods.gyrocompass.budget import TurntableUncertainty
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.stand.applying import left_deg

_TURNTABLE: Final = "azimuth"
_TILT: Final = "tilt_gamma_deg"


class TurntableStand(RecordedStand):
    """A stand file with a turntable and what samples the platform, by whatever drivers they are reached."""

    positioners: Mapping[str, RecordedHead] = {}
    samplers: Mapping[str, RecordedDaq] = {}

    @property
    def uncertainty(self) -> TurntableUncertainty:
        """What the stand adds to the budget."""
        turntable = self.positioners.get(_TURNTABLE)
        arcsec = turntable.accuracy_arcsec if turntable else None
        samplers = self.samplers.values()
        return TurntableUncertainty(
            azimuth_deg=None if arcsec is None else arcsec / 3600.0,
            tilt_deg=next((each.uncertainties[_TILT] for each in samplers if _TILT in each.uncertainties), None),
            latitude_deg=self.site.latitude_uncertainty_deg,
            torquer_scale=next((each.gain_uncertainty for each in samplers if each.gain_uncertainty is not None), None),
        )


def uncertainty_of(measurement: Measurement) -> TurntableUncertainty:
    """What the stand of a measurement adds; nothing without a stand file. Raises `InputError` where that does not fit.

    What a stand record that was applied does not know of itself is part of the reading of the pickoff.
    """
    file, rows = measurement.stand_as(TurntableStand), measurement.observations
    stated = file.uncertainty if file else TurntableUncertainty()
    if measurement.stand_record is None or not isinstance(rows, GyrocompassObservations):
        return stated
    left = left_deg(rows, measurement.stand_record)
    return replace(stated, azimuth_deg=float(np.hypot(stated.azimuth_deg or 0.0, left)))
