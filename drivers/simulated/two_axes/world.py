"""The world of two axes: three accelerometers on an inner axis on an outer one, in a room, wired to voltmeters."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.simulated.chamber import SimulatedChamber
from tumble.drivers.simulated.daq import Converter
from tumble.drivers.simulated.effects import Effects
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.head import HeadOptions, SimulatedHead
from tumble.drivers.simulated.noise import Stream, generator
from tumble.drivers.simulated.room import Room
from tumble.drivers.simulated.two_axes.axis import Axis, wave_rad
from tumble.drivers.simulated.two_axes.geometry import RAD_PER_ARCSEC, gravity_g
from tumble.drivers.simulated.two_axes.meter import OutputsMeter
from tumble.drivers.simulated.two_axes.settings import SimulatedTwoAxes
from tumble.drivers.simulated.two_axes.unit import AXES, Accelerometers
from tumble.drivers.simulated.worlds import Surroundings, WorldKind
from tumble.messages import Message

OUTER: Final = "outer"
INNER: Final = "inner"
CHANNELS: Final = tuple(f"u_{axis}_v" for axis in AXES)
_OPTIONS: Final = HeadOptions(limits_deg=(-360.0, 360.0))


@dataclass(kw_only=True)
class Counts:
    """How often each thing has happened. Every random draw is keyed by one of these."""

    dwells: int = 0
    """Stays of both axes at which something was acquired."""
    looks: dict[int, int] = field(default_factory=dict)
    """Acquisitions of each channel in the present dwell."""
    turn_ons: int = 1
    in_dwell: bool = False


class Terminals:
    """The unit on its axes as voltmeters see it. Fits `meter.OutputTerminals`."""

    def __init__(self, settings: SimulatedTwoAxes, clock: Clock, heads: Mapping[str, HeadOptions]) -> None:
        self._settings, self._effects = settings, settings.effects
        self._unit = Accelerometers(settings)
        room = Room(settings.temperature, settings.seed)
        self.chamber = SimulatedChamber(clock, room.temperature_degc, unit_tau_s=settings.unit_tau_s)
        self._began_s = clock.monotonic_s()
        self.counts = Counts()
        self.axes = {
            name: Axis(name, settings.effects, clock, heads.get(name, _OPTIONS), self._leave) for name in (OUTER, INNER)
        }

    @property
    def dwell(self) -> int:
        """Number of the dwell."""
        return self.counts.dwells

    def postpone(self, outage_s: float) -> None:
        """Count time as if the world had begun so much later."""
        self._began_s += outage_s
        self.chamber.postpone(outage_s)

    def begin_acquisition(self) -> None:
        """The first samples after a move begin a dwell."""
        if not self.counts.in_dwell:
            self.counts.in_dwell = True
            self.counts.dwells += 1
            self.counts.looks = {}

    def sample_v(self, times_s: FloatArray, channel: int) -> FloatArray:
        """Samples of an output; their noise belongs to the dwell and to the number of the look at it."""
        self.counts.looks[channel] = self.counts.looks.get(channel, 0) + 1
        random = self._random(Stream.SAMPLES, channel)
        noise_v = self._settings.noise_v[channel] * random.standard_normal(len(times_s))
        return np.asarray(self._outputs_v(times_s)[:, channel] + noise_v)

    def sensor_degc(self, time_s: float, channel: int) -> float:
        """Temperature of the unit with the noise of the sensor."""
        noise_k = self._settings.temperature.sensor_noise_k
        drawn = self._random(Stream.THERMOMETER, channel).standard_normal()
        return float(self._temperature_degc(np.array([time_s]))[0] + noise_k * drawn)

    def gravity_g(self, times_s: FloatArray) -> FloatArray:
        """Gravity in the case at rising clock times, shape (rows, 3)."""
        e, tau_s = self._effects, self._settings.response_tau_s
        outer_rad, inner_rad = (self.axes[name].true_rad(times_s, tau_s) for name in (OUTER, INNER))
        outer_rad, inner_rad = outer_rad + self._misread_rad(OUTER), inner_rad + self._misread_rad(INNER)
        level_x_rad, level_y_rad = self._levels_rad(times_s)
        phase_rad = 2.0 * inner_rad + np.deg2rad(e.inner_wobble.phase_deg)
        wobble_rad = RAD_PER_ARCSEC * e.inner_wobble.amplitude_arcsec
        return gravity_g(
            outer_rad + level_x_rad,
            inner_rad,
            level_y_rad + wave_rad(e.outer_wobble, 2, outer_rad),
            RAD_PER_ARCSEC * e.axes_orthogonality.value_arcsec,
            (wobble_rad * np.cos(phase_rad), wobble_rad * np.sin(phase_rad)),
        )

    def _levels_rad(self, times_s: FloatArray) -> tuple[FloatArray, FloatArray]:
        p, drift, hours = self._settings.unit_parameters, self._effects.level_drift, (times_s - self._began_s) / 3600.0
        level_x, level_y = p["level_x"] + drift.x_arcsec_h * hours, p["level_y"] + drift.y_arcsec_h * hours
        return RAD_PER_ARCSEC * level_x, RAD_PER_ARCSEC * level_y

    def _misread_rad(self, axis: str) -> float:
        misreading = self._effects.misreading
        if misreading is None or misreading.axis != axis or self.counts.dwells not in misreading.rows:
            return 0.0
        return RAD_PER_ARCSEC * misreading.error_arcsec

    def _outputs_v(self, times_s: FloatArray) -> FloatArray:
        since_s = times_s - self._began_s
        output_v = self._unit.outputs_v(self.gravity_g(times_s), self._temperature_degc(times_s), since_s)
        drawn = generator(self._settings.seed, Stream.TURN_ON, self.counts.turn_ons).standard_normal(3)
        return output_v + drawn * self._effects.realisation_bias.values

    def _temperature_degc(self, times_s: FloatArray) -> FloatArray:
        return self.chamber.unit_degc(times_s)

    def _random(self, stream: Stream, channel: int) -> np.random.Generator:
        """The numbers of a channel: those of every channel have a key of their own."""
        looks = self.counts.looks.get(channel, 0)
        return generator(self._settings.seed, stream + len(Stream) * (1 + channel), self.counts.dwells, looks)

    def _leave(self) -> None:
        self.counts.in_dwell = False


class TwoAxesWorld:
    """Everything that is true at the stand. Fits `tumble.drivers.simulated.worlds.World`.

    It begins at the clock's present time with both axes at zero and the power on.
    """

    def __init__(self, settings: SimulatedTwoAxes, surroundings: Surroundings) -> None:
        self._clock = surroundings.clock
        self._settling = settings.effects.settling
        effects = Effects(daq_nonlinearity=settings.effects.daq_nonlinearity, range_step=settings.effects.range_step)
        self._converter = Converter(effects, resolution_v=settings.resolution_v, range_v=settings.range_v)
        self.terminals = Terminals(settings, surroundings.clock, surroundings.heads)

    @property
    def positioners(self) -> Mapping[str, SimulatedHead]:
        """Both axes."""
        return {name: axis.head for name, axis in self.terminals.axes.items()}

    @property
    def chamber(self) -> SimulatedChamber:
        """Around both axes; as long as it does not run, the unit has the temperature of the room."""
        return self.terminals.chamber

    @property
    def counts(self) -> Counts:
        """What has happened so far."""
        return self.terminals.counts

    @property
    def setters(self) -> Mapping[str, Callable[[str], None]]:
        """Nothing is set by hand."""
        return {}

    def meter(self, channels: Sequence[str]) -> OutputsMeter:
        """A voltmeter at these outputs, at all where none is named. Raises `ValueError` for one that it has not."""
        if unknown := [name for name in channels if name not in CHANNELS]:
            raise ValueError(
                Message(
                    "the simulated unit has no output {name}; it has {there}",
                    name=unknown[0],
                    there=", ".join(CHANNELS),
                )
            )
        wired = {name: CHANNELS.index(name) for name in channels or CHANNELS}
        return OutputsMeter(self._clock, self.terminals, self._converter, channels=wired, settling=self._settling)

    def switch_on(self) -> None:
        """Switch the unit off and on for a moment: its biases are drawn anew."""
        self.counts.turn_ons += 1

    def put_back(self, counts: Counts, outage_s: float) -> None:
        """Count the draws on from `counts`, and have everything that drifts stand as `outage_s` ago."""
        vars(self.terminals.counts).update(vars(counts))
        self.terminals.postpone(outage_s)


WORLD: Final = WorldKind(table=SimulatedTwoAxes, build=TwoAxesWorld)
