"""Uncertainty by the GUM: what the stand adds to the scatter of the data."""

from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.budget import Source, not_included
from tumble.calibrations.core.gravity import Gravity
from tumble.calibrations.core.repeats import settings
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.poses import mountings
from tumble.calibrations.methods.dividing_head.stand.columns import corrections_columns_v
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message

_ARCSEC_DEG = 1.0 / 3600.0


@dataclass(frozen=True, kw_only=True)
class StandUncertainty:
    """Standard uncertainties (type B) that a stand file states; None where it does not."""

    head_accuracy_arcsec: float | None = None
    """Reading of the head: one error for every setting, the same whenever it is set."""
    seating_arcsec: float | None = None
    """Repeatability of the unit in its seat: one error for every mounting."""
    daq_gain: float | None = None
    """Relative, common to all readings."""
    daq_offset_v: float | None = None
    """Common to all readings, in volts."""
    gravity: Gravity | None = None
    """Local gravity; it enters the coefficients per m/s² only."""
    record: StandRecord | None = None
    """What the rows were corrected by."""

    @property
    def left_out(self) -> str:
        """That what the stand adds, or which part of it, is not in the stated uncertainty; empty where all of it is."""
        stated = {
            "accuracy_arcsec": self.head_accuracy_arcsec,
            "seating_arcsec": self.seating_arcsec,
            "gain_uncertainty": self.daq_gain,
            "offset_uncertainty_v": self.daq_offset_v,
        }
        nothing = Message(
            "the stand's contribution is not included in the stated uncertainty: no stand file says what head, "
            "seat and DAQ add; state {keys} in a stand file",
            keys=", ".join(stated),
        )
        return not_included(stated, nothing)


def sources(scene: Scene, stand: StandUncertainty) -> tuple[Source, ...]:
    """Sources of type B with a size above zero, for the rows of a scene."""
    observations, slope_v_per_deg = scene.observations, scene.slope_v_per_deg
    head_arcsec, seat_arcsec = stand.head_accuracy_arcsec or 0.0, stand.seating_arcsec or 0.0
    gain, offset_v = stand.daq_gain or 0.0, stand.daq_offset_v or 0.0
    settled = settings(np.mod(observations.angle_deg, 360.0))
    listed = (
        Source(
            name=Message("head reading"),
            symbol=Message("{arcsec:g}″ at every setting", arcsec=head_arcsec),
            errors_v=(slope_v_per_deg * head_arcsec * _ARCSEC_DEG)[:, None],
            shared_by=settled,
        ),
        Source(
            name=Message("seating"),
            symbol=Message("{arcsec:g}″ at every mounting", arcsec=seat_arcsec),
            errors_v=(slope_v_per_deg * seat_arcsec * _ARCSEC_DEG)[:, None],
            shared_by=mountings(observations),
        ),
        Source(
            name=Message("DAQ gain"),
            symbol=Message("{gain:g} relative", gain=gain),
            errors_v=(observations.output_v * gain)[:, None],
        ),
        Source(
            name=Message("DAQ offset"),
            symbol=f"{offset_v * 1e6:g} µV",
            errors_v=np.full((len(observations), 1), offset_v),
        ),
        *((stand.record.source(corrections_columns_v(stand.record.corrections, scene)),) if stand.record else ()),
    )
    return tuple(source for source in listed if np.any(source.errors_v))
