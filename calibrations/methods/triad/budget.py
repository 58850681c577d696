"""What a stand with two axes adds to the scatter of the data (GUM, type B).

A constant tilt of the stand adds nothing: it is fitted. Nor does local gravity, as long as values are per local g.
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.budget import Source, not_included
from tumble.calibrations.core.gravity import Gravity
from tumble.calibrations.core.repeats import settings
from tumble.calibrations.methods.triad.geometry import ARCSEC_PER_RAD
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.methods.triad.stand.columns import columns_v
from tumble.calibrations.stand_records.record import StandRecord
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class MeterUncertainty:
    """Standard uncertainties of one voltmeter; None where they are not stated."""

    name: str
    """As the stand file calls it."""
    channels: tuple[int, ...]
    """Outputs that it measures, x as 0."""
    gain: float | None = None
    """Relative, common to all its readings."""
    offset_v: float | None = None
    """Common to all its readings, in volts."""


@dataclass(frozen=True, kw_only=True)
class TwoAxisUncertainty:
    """Standard uncertainties (type B) that a stand file states; None where it does not."""

    outer_arcsec: float | None = None
    """Reading of the outer axis: one error for every setting of it, the same whenever it is set."""
    inner_arcsec: float | None = None
    meters: tuple[MeterUncertainty, ...] = ()
    gravity: Gravity | None = None
    """Local gravity; it enters the scale factors per m/s² only."""
    record: StandRecord | None = None
    """What the rows were corrected by."""

    @property
    def left_out(self) -> str:
        """That what the stand adds, or which part of it, is not in the stated uncertainty; empty where all of it is."""
        stated = {
            "positioners.outer.accuracy_arcsec": self.outer_arcsec,
            "positioners.inner.accuracy_arcsec": self.inner_arcsec,
        }
        for meter in self.meters or (MeterUncertainty(name="NAME", channels=(0, 1, 2)),):
            stated[f"samplers.{meter.name}.gain_uncertainty"] = meter.gain
            stated[f"samplers.{meter.name}.offset_uncertainty_v"] = meter.offset_v
        nothing = Message(
            "the stand's contribution is not included in the stated uncertainty: no stand file says what axes and "
            "voltmeter add; state {keys} in a stand file",
            keys=", ".join(stated),
        )
        return not_included(stated, nothing)


def sources(scene: TriadScene, stand: TwoAxisUncertainty) -> tuple[Source, ...]:
    """Sources of type B with a size above zero, for the rows of a scene."""
    listed = (*_of_the_axes(scene, stand), *_of_the_meters(scene, stand), *_of_the_record(scene, stand.record))
    return tuple(source for source in listed if np.any(source.errors_v))


def _of_the_axes(scene: TriadScene, stand: TwoAxisUncertainty) -> Iterator[Source]:
    rows = scene.observations
    for name, arcsec, slope_v, angle_deg in (
        (Message("reading of the outer axis"), stand.outer_arcsec, scene.outer_v, rows.outer_deg),
        (Message("reading of the inner axis"), stand.inner_arcsec, scene.inner_v, rows.inner_deg),
    ):
        yield Source(
            name=name,
            symbol=Message("{arcsec:g}″ at every setting", arcsec=arcsec or 0.0),
            errors_v=(slope_v * (arcsec or 0.0) / ARCSEC_PER_RAD)[:, None],
            shared_by=np.repeat(settings(np.mod(angle_deg, 360.0)), 3),
        )


def _of_the_meters(scene: TriadScene, stand: TwoAxisUncertainty) -> Iterator[Source]:
    for meter in stand.meters:
        gain, offset_v = meter.gain or 0.0, meter.offset_v or 0.0
        measured = np.tile(np.isin(np.arange(3), meter.channels).astype(float), scene.dwells)
        yield Source(
            name=Message("gain of {sampler}", sampler=meter.name),
            symbol=Message("{gain:g} relative", gain=gain),
            errors_v=(measured * gain * scene.observations.outputs_v.ravel())[:, None],
        )
        yield Source(
            name=Message("offset of {sampler}", sampler=meter.name),
            symbol=f"{offset_v * 1e6:g} µV",
            errors_v=(measured * offset_v)[:, None],
        )


def _of_the_record(scene: TriadScene, record: StandRecord | None) -> Iterator[Source]:
    if record:
        yield record.source(columns_v(record.corrections, scene))
