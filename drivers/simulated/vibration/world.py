"""The world of vibration: an accelerometer on what shakes it, reference accelerometers beside it, and a voltmeter."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.excitation import REST, STANDARD_GRAVITY_M_S2, Excitation, Rotation
from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.mountings import Mounting
from tumble.drivers.simulated.exciter import SimulatedExciter
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.head import SimulatedHead
from tumble.drivers.simulated.noise import RandomWalk, Stream, generator
from tumble.drivers.simulated.room import Room
from tumble.drivers.simulated.unit import REFERENCE_DEGC
from tumble.drivers.simulated.vibration.heating import Heat, level_g, power_g2
from tumble.drivers.simulated.vibration.meter import VibrationMeter
from tumble.drivers.simulated.vibration.motion import Motion
from tumble.drivers.simulated.vibration.settings import SimulatedVibration
from tumble.drivers.simulated.vibration.unit import Pendulum
from tumble.drivers.simulated.worlds import Surroundings, WorldKind
from tumble.drivers.tables import MOUNT
from tumble.messages import Message

OUTPUT: Final = "output_v"
REFERENCES: Final = ("reference_x_v", "reference_y_v", "reference_z_v")
CHANNELS: Final = (OUTPUT, *REFERENCES)
_OPTIONS: Final = ExciterTable(driver="simulated", level_limit_g=1e4, frequency_limits_Hz=(0.0, 1e6), ramp_s=0.0)


@dataclass(kw_only=True)
class Counts:
    """How often each thing has happened, and the heat that has come of it. Random draws are keyed by these."""

    dwells: int = 0
    """Stays at one excitation at which something was acquired."""
    looks: int = 0
    """Acquisitions in the present dwell."""
    turn_ons: int = 1
    in_dwell: bool = False
    shifted: bool = False
    """Whether the step of `after_shift` is there."""
    heat: Heat = field(default_factory=lambda: Heat(tau_s=300.0))


class VibrationWorld:
    """Everything that is true at the stand. Fits `tumble.drivers.simulated.worlds.World` and `meter.Terminals`."""

    def __init__(self, settings: SimulatedVibration, surroundings: Surroundings) -> None:
        self._settings, self._effects, self._clock = settings, settings.effects, surroundings.clock
        self._began_s = self._clock.monotonic_s()
        self._motion, self._unit = Motion(settings), Pendulum(settings)
        self._room = Room(settings.temperature, settings.seed)
        self._walk = RandomWalk(settings.seed, v_per_sqrt_h=self._effects.bias_random_walk.value)
        self._mounting = Mounting.of(settings.mounting)
        thermal = self._effects.thermal_shift
        self.counts = Counts(heat=Heat(tau_s=thermal.tau_s if thermal else 300.0))
        self.exciter = SimulatedExciter(_OPTIONS, self)

    @property
    def positioners(self) -> Mapping[str, SimulatedHead]:
        """None: what turns a unit in a centrifuge is the exciter."""
        return {}

    @property
    def chamber(self) -> None:
        """None."""
        return

    @property
    def setters(self) -> Mapping[str, Callable[[str], None]]:
        """A person mounts the unit."""
        return {MOUNT: self._mount}

    @property
    def clock(self) -> Clock:
        """By which it lives."""
        return self._clock

    def meter(self, channels: Sequence[str]) -> VibrationMeter:
        """A voltmeter at these outputs, at output and first reference where none is named. Raises `ValueError`."""
        if unknown := [name for name in channels if name not in CHANNELS]:
            raise ValueError(
                Message(
                    "the simulated unit has no output {name}; it has {there}",
                    name=unknown[0],
                    there=", ".join(CHANNELS),
                )
            )
        wired = {name: CHANNELS.index(name) for name in channels or CHANNELS[:2]}
        return VibrationMeter(self, self._settings, wired)

    def switch_on(self) -> None:
        """Switch the unit off and on for a moment: its bias is drawn anew."""
        self.counts.turn_ons += 1

    def put_back(self, counts: Counts, outage_s: float) -> None:
        """Count the draws on from `counts`, and have everything that drifts stand as `outage_s` ago."""
        vars(self.counts).update(vars(counts))
        self._began_s += outage_s

    def begin_acquisition(self) -> None:
        """The first samples after a change of the excitation or the mounting begin a dwell."""
        if not self.counts.in_dwell:
            self.counts.in_dwell, self.counts.looks = True, 0
            self.counts.dwells += 1
            shift = self._effects.after_shift
            self.counts.shifted |= shift is not None and self.counts.dwells == shift.row + 1
        self.counts.looks += 1

    def sampled_v(self, clock_s: FloatArray) -> FloatArray:
        """Output and references, shape (rows, 4), at rising clock times; noise included."""
        time_s = clock_s - self._began_s
        driven, table = self.exciter.driven, self._mounting.table
        static_g = self._motion.tilt_g(driven, time_s) @ table + self._mounting.gravity_g
        references_g = self._motion.table_g(driven, time_s)
        resonant = self._effects.frequency_response is not None
        felt_g = self._motion.table_g(driven, time_s, felt=True) if resonant else references_g
        output_g = self._unit.output_g(felt_g @ table + static_g) + 1e-6 * self._shifted_ug(driven, time_s)
        s = self._settings
        random = generator(s.seed, Stream.SAMPLES, self.counts.dwells, self.counts.looks)
        noise_ug = random.standard_normal((len(time_s), 4)) * [s.noise_ug, *(3 * [s.reference_noise_ug])]
        scales = np.array([s.scale_v_per_g, *(3 * [s.reference_v_per_g])])
        return np.asarray((np.column_stack([output_g, references_g]) + 1e-6 * noise_ug) * scales)

    def sensor_degc(self, clock_s: float) -> float:
        """Temperature of the unit with the noise of the sensor."""
        random = generator(self._settings.seed, Stream.THERMOMETER, self.counts.dwells, self.counts.looks)
        drawn = random.standard_normal() * self._settings.temperature.sensor_noise_k
        return float(self._room.temperature_degc(np.array([clock_s - self._began_s]))[0] + drawn)

    def _shifted_ug(self, driven: Excitation, time_s: FloatArray) -> FloatArray:
        """What is added to the output, in µg."""
        e, counts = self._effects, self.counts
        constant_ug = e.drive_pickup.value * level_g(driven) + e.table_lean.value * self._leaning(driven)
        if isinstance(driven, Rotation):
            rate_rad_s = driven.main_rad_s + driven.sub_rad_s
            constant_ug += 1000.0 * e.spin.mm * rate_rad_s**2 / STANDARD_GRAVITY_M_S2
        if e.after_shift and counts.shifted:
            constant_ug += e.after_shift.step
        if e.misreading and counts.dwells in e.misreading.rows:
            constant_ug += e.misreading.error
        drawn = generator(self._settings.seed, Stream.TURN_ON, counts.turn_ons).standard_normal()
        warmer_k = self._room.temperature_degc(time_s) - REFERENCE_DEGC
        drifting_ug = e.bias_drift.value * time_s / 3600.0 + e.bias_temperature.value * warmer_k
        heated_ug = e.thermal_shift.amplitude * counts.heat.at(time_s) if e.thermal_shift else 0.0
        return np.asarray(
            constant_ug + e.realisation_bias.value * drawn + drifting_ug + heated_ug + self._walk.at(time_s)
        )

    def _leaning(self, driven: Excitation) -> float:
        """Mean square of the drive along the input axis as far as that lies along x."""
        return float(self._mounting.table[0, 0]) * power_g2(driven)

    def _mount(self, text: str) -> None:
        """Seat the unit, by hand. Raises `ValueError` for a text that is no mounting."""
        mounting = Mounting.of(text)
        if mounting == self._mounting:
            return
        self.counts.in_dwell = self.counts.shifted = False
        self._mounting = mounting

    def drive_changes(self, before: Excitation, after: Excitation) -> None:
        """Heat goes towards another power; a new level on the way from rest is no other dwell."""
        self.counts.heat.change(self._clock.monotonic_s() - self._began_s, power_g2(after))
        if REST in (before, after):
            self.counts.in_dwell = False


WORLD: Final = WorldKind(table=SimulatedVibration, build=VibrationWorld)
