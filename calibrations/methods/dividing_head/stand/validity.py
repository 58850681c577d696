"""Over what a table of an accelerometer was measured."""

import numpy as np

from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.stand_records.record import Validity


def validity_of(observations: Observations, measured_at: str = "") -> Validity:
    """The ranges of one table."""
    temperature = observations.temperature_degc
    known = temperature is not None and bool(np.isfinite(temperature).any())
    return Validity(
        angle_deg=(float(observations.angle_deg.min()), float(observations.angle_deg.max())),
        voltage_v=(float(observations.output_v.min()), float(observations.output_v.max())),
        temperature_degc=(float(np.nanmin(temperature)), float(np.nanmax(temperature))) if known else None,  # type: ignore[arg-type]
        measured_from=measured_at,
        measured_to=measured_at,
    )
