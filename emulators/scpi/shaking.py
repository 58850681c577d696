"""From the outputs of a function generator to what the shakers of a simulated world do."""

from collections.abc import Mapping
from itertools import pairwise
from typing import Final, TypeAlias

import numpy as np

from tumble.drivers.excitation import REST, Excitation, Random, Sines, Tone
from tumble.drivers.simulated.exciter import SimulatedExciter
from tumble.emulators.scpi.outputs import Output
from tumble.emulators.world import SharedWorld

Gains: TypeAlias = Mapping[int, tuple[str, float]]
"""Shaker and its acceleration in g for each volt, peak for peak, by channel."""
_BANDS: Final = 24
_NOTHING: Final = 1e-6
"""Lines below so much of the strongest are rounding."""


class Shaking:
    """Drives the exciter of the world by what the outputs put out; an output of the least amplitude shakes, too."""

    def __init__(self, world: SharedWorld, gains: Gains, outputs: Mapping[int, Output]) -> None:
        self._exciter: SimulatedExciter = world.world.exciter
        self._gains, self._outputs = gains, outputs
        self._seen: tuple[tuple[tuple[str, object], ...], ...] = ()
        self._densities: dict[tuple[str, int, float], Random] = {}

    def align(self) -> None:
        """Outputs begin their waves together; those of the world always do."""

    def follow(self, *, stuck: bool) -> None:
        """Do what the outputs say now; what is stuck goes on as it is."""
        seen = tuple(tuple((name, value) for name, value in vars(each).items() if name != "waveforms")
                     for each in self._outputs.values())  # fmt: skip
        if stuck or seen == self._seen:
            return
        self._seen = seen
        wanted = self._wanted()
        self._exciter.set(wanted, on=wanted != REST)

    def _wanted(self) -> Excitation:
        on = {channel: output for channel, output in self._outputs.items() if output.on and channel in self._gains}
        for channel, output in on.items():
            if output.shape == "ARB":
                return self._random(output, self._gains[channel][1])
        alone = len(self._gains) == 1
        tones = [
            Tone(
                shaker="" if alone else self._gains[channel][0],
                level_g=output.amplitude_v_pp / 2.0 * self._gains[channel][1],
                frequency_hz=output.frequency_hz,
                phase_deg=None if alone else output.phase_deg,
            )
            for channel, output in on.items()
            if output.shape == "SIN"
        ]
        return Sines(tones=tuple(tones)) if tones else REST

    def _random(self, output: Output, g_per_v: float) -> Excitation:
        """Random vibration of the spectrum of the waveform."""
        points = output.waveforms[output.waveform]
        key = (output.waveform, hash(points), output.rate_hz)
        if key not in self._densities:
            self._densities[key] = _spectrum(np.array(points), output.rate_hz)
        return self._densities[key].scaled(output.amplitude_v_pp / 2.0 * g_per_v)


def _spectrum(values: "np.ndarray[tuple[int], np.dtype[np.float64]]", rate_hz: float) -> Random:
    """Density of a waveform of the peak 1, in bands of even width."""
    power = 2.0 * np.abs(np.fft.rfft(values)) ** 2 / len(values) / rate_hz
    hz = np.fft.rfftfreq(len(values), 1.0 / rate_hz)
    lines = np.flatnonzero(power > _NOTHING * power.max())
    edges = np.linspace(lines[0], lines[-1] + 1, _BANDS + 1).astype(int)
    middle_hz = [hz[low:high].mean() for low, high in pairwise(edges)]
    density = [power[low:high].mean() for low, high in pairwise(edges)]
    shape = Random(
        frequencies_hz=(float(hz[lines[0]]), *map(float, middle_hz[1:-1]), float(hz[lines[-1]])),
        density_g2_hz=tuple(map(float, density)),
    )
    return shape.scaled(float(np.sqrt(np.mean(values**2))) / shape.rms_g)
