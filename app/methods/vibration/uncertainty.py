"""What the stand file adds to the budget of vibration rectification."""

from collections.abc import Mapping
from typing import Final

from pydantic import ConfigDict

from tumble.app.measurement import Measurement
from tumble.app.stand_file import RecordedDaq, RecordedStand
from tumble.calibrations.methods.vibration.budget import VibrationUncertainty

REFERENCE: Final = "reference"
UNIT: Final = "unit"
"""Names of the samplers that read the reference accelerometer and the unit."""


class RecordedChannel(RecordedDaq):
    """What every driver's table of a sampler says alike."""

    model_config = ConfigDict(extra="allow")


class VibrationStand(RecordedStand):
    """A stand file with a reference accelerometer and the unit, by whatever drivers they are read."""

    samplers: Mapping[str, RecordedChannel] = {}

    @property
    def uncertainty(self) -> VibrationUncertainty:
        """What the stand adds to the budget; one sampler of both is the reference."""
        gains = {name: table.gain_uncertainty for name, table in self.samplers.items()}
        only = next(iter(gains.values())) if len(gains) == 1 else None
        return VibrationUncertainty(reference_scale=gains.get(REFERENCE, only), output_scale=gains.get(UNIT))


def uncertainty_of(measurement: Measurement) -> VibrationUncertainty:
    """What the stand of a measurement adds; nothing without a stand file. Raises `InputError`: it does not fit."""
    file = measurement.stand_as(VibrationStand)
    return file.uncertainty if file else VibrationUncertainty()
