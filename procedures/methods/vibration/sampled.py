"""The samples of a recording, dwell by dwell, as accelerations."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.rows import OVERLOAD
from tumble.calibrations.methods.vibration.dwells.samples import RANDOM, REST, VIBRATION, Samples
from tumble.drivers.excitation import Excitation, Random, Rest, Sines, excitation_of, frequencies_hz
from tumble.drivers.mountings import Mounting
from tumble.drivers.tables import EXCITER, MOUNT
from tumble.procedures.methods.vibration.layout import OUTPUT
from tumble.procedures.recording.reader import iter_samples
from tumble.procedures.recording.recorded import Recording
from tumble.procedures.steps import Point

_REFERENCE: Final = re.compile(r".*_([xyz])_v")
"""Name of the channel of a reference accelerometer, by the axis of the table along which it lies."""


@dataclass(frozen=True, kw_only=True)
class SampledDwell:
    """A complete dwell with its samples."""

    point: Point
    time_s: FloatArray
    """Since the run began."""
    output_g: FloatArray
    references_g: Mapping[str, FloatArray]
    """By the axis of the table."""
    overloaded: bool
    """Whether a sample was beyond the range of the sampler."""
    duration_s: float

    @property
    def excitation(self) -> Excitation:
        """What the exciter was told."""
        return excitation_of(self.point.conditions[EXCITER])

    @property
    def mounting(self) -> Mounting:
        """How the unit sat."""
        return Mounting.of(self.point.conditions[MOUNT])

    @property
    def samples(self) -> Samples:
        """As the reduction takes it; tones of different frequencies are reduced as random vibration is."""
        hz = set(frequencies_hz(self.excitation))
        match self.excitation:
            case Rest():
                kind = REST
            case Random():
                kind = RANDOM
            case Sines() if len(hz) > 1:
                kind = RANDOM
            case _:
                kind = VIBRATION
        return Samples(
            dwell=self.point.index + 1,
            kind=kind,
            drive_hz=min(hz) if kind == VIBRATION else 0.0,
            time_s=self.time_s,
            output_g=self.output_g,
            references_g=tuple(self.references_g[axis] for axis in self._driven_first),
        )

    @property
    def _driven_first(self) -> list[str]:
        """Axes with a reference; those that are driven tell the frequency."""
        driven = [tone.shaker for tone in self.excitation.tones] if isinstance(self.excitation, Sines) else []
        return sorted(self.references_g, key=lambda axis: (axis not in driven, axis))


def sampled_dwells(recording: Recording, scale_v_per_g: float) -> list[SampledDwell]:
    """Every complete point with the samples that were taken of it last, in order."""
    complete = {point.index: point for point in recording.points}
    channels: dict[int, dict[str, FloatArray]] = {}
    begins: dict[int, tuple[float, float]] = {}
    for taken in iter_samples(recording.path):
        if taken.point in complete and taken.take == complete[taken.point].take:
            channels[taken.point] = {**channels.get(taken.point, {}), **taken.block.channels}
            begins[taken.point] = (taken.time_s, taken.block.rate_hz)
    references = references_of(recording.header.stand)
    return [
        _dwell(complete[index], channels[index], begins[index], scale_v_per_g, references)
        for index in sorted(channels)
        if OUTPUT in channels[index]
    ]


def references_of(stand: Mapping[str, Any]) -> dict[str, tuple[str, float]]:
    """Channel and sensitivity (V/g) of the reference along each axis of the table, as a stand file says."""
    exciter = stand.get(EXCITER, {})
    said = exciter.get("references", {}) if isinstance(exciter, Mapping) else {}
    found = [(_REFERENCE.fullmatch(channel), channel, float(value)) for channel, value in said.items()]
    return {match[1]: (channel, value) for match, channel, value in sorted(found, key=lambda each: each[1]) if match}


def _dwell(
    point: Point,
    channels: Mapping[str, FloatArray],
    begin: tuple[float, float],
    scale_v_per_g: float,
    references: Mapping[str, tuple[str, float]],
) -> SampledDwell:
    began_s, rate_hz = begin
    output_v = channels[OUTPUT]
    references_v = {axis: channels[name] for axis, (name, _) in references.items() if name in channels}
    known = np.all([np.isfinite(each) for each in (output_v, *references_v.values())], axis=0)
    overloaded = any(bool(np.any(np.abs(each[known]) > OVERLOAD)) for each in (output_v, *references_v.values()))
    return SampledDwell(
        point=point,
        time_s=(began_s + np.arange(len(output_v)) / rate_hz)[known],
        output_g=output_v[known] / scale_v_per_g,
        references_g={axis: each[known] / references[axis][1] for axis, each in references_v.items()},
        overloaded=overloaded,
        duration_s=len(output_v) / rate_hz,
    )
