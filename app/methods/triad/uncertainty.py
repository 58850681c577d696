"""What the stand file of two axes adds to the budget of a triad."""

from collections.abc import Mapping
from dataclasses import replace

from pydantic import ConfigDict

from tumble.app.measurement import Measurement
from tumble.app.stand_file import RecordedDaq, RecordedHead, RecordedStand
from tumble.calibrations.methods.triad.budget import MeterUncertainty, TwoAxisUncertainty

_OUTPUTS = ("u_x_v", "u_y_v", "u_z_v")


class RecordedMeter(RecordedDaq):
    """What every driver's table of a voltmeter says alike; in its own keys its channels have names."""

    model_config = ConfigDict(extra="allow")

    @property
    def outputs(self) -> tuple[int, ...]:
        """Outputs that it measures, x as 0; all where it does not say."""
        named = {*self.channels}
        for value in (self.model_extra or {}).values():
            named |= {*value} if isinstance(value, Mapping) else set()
        return tuple(place for place, name in enumerate(_OUTPUTS) if name in named) or (0, 1, 2)


class TwoAxisStand(RecordedStand):
    """A stand file with two axes and voltmeters, by whatever drivers they are reached."""

    positioners: Mapping[str, RecordedHead] = {}
    samplers: Mapping[str, RecordedMeter] = {}

    @property
    def uncertainty(self) -> TwoAxisUncertainty:
        """What the stand adds to the budget."""
        accuracy = {name: table.accuracy_arcsec for name, table in self.positioners.items()}
        return TwoAxisUncertainty(
            outer_arcsec=accuracy.get("outer"),
            inner_arcsec=accuracy.get("inner"),
            meters=tuple(
                MeterUncertainty(
                    name=name,
                    channels=table.outputs,
                    gain=table.gain_uncertainty,
                    offset_v=table.offset_uncertainty_v,
                )
                for name, table in self.samplers.items()
            ),
            gravity=self.site.gravity,
        )


def uncertainty_of(measurement: Measurement) -> TwoAxisUncertainty:
    """What the stand of a measurement adds, and the stand record that was applied; nothing without a stand file.

    Raises
    ------
    InputError
        The stand file does not fit.
    """
    file = measurement.stand_as(TwoAxisStand)
    return replace(file.uncertainty if file else TwoAxisUncertainty(), record=measurement.stand_record)
