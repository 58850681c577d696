"""What the stand file of a dividing head adds to the budget of an accelerometer."""

from dataclasses import replace

from pydantic import Field

from tumble.app.measurement import Measurement
from tumble.app.stand_file import RecordedDaq, RecordedHead, RecordedStand
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.drivers.tables import DAQ, HEAD


class HeadStand(RecordedStand):
    """A stand file with a head and a voltmeter, by whatever drivers they are reached."""

    head_table: RecordedHead = Field(alias=HEAD)
    daq_table: RecordedDaq = Field(alias=DAQ)

    @property
    def uncertainty(self) -> StandUncertainty:
        """What the stand adds to the budget."""
        return StandUncertainty(
            head_accuracy_arcsec=self.head_table.accuracy_arcsec,
            seating_arcsec=self.head_table.seating_arcsec,
            daq_gain=self.daq_table.gain_uncertainty,
            daq_offset_v=self.daq_table.offset_uncertainty_v,
            gravity=self.site.gravity,
        )


def uncertainty_of(measurement: Measurement) -> StandUncertainty:
    """What the stand of a measurement adds, and the stand record that was applied; nothing without a stand file.

    Raises
    ------
    InputError
        The stand file does not fit.
    """
    file = measurement.stand_as(HeadStand)
    return replace(file.uncertainty if file else StandUncertainty(), record=measurement.stand_record)
