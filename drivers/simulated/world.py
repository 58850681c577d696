"""The simulated world: a unit on a head in a room, wired to a DAQ."""

import math
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from tumble.drivers.clock import Clock
from tumble.drivers.simulated.bench import Bench, Counts
from tumble.drivers.simulated.daq import Converter, SimulatedDaq
from tumble.drivers.simulated.external import load_function
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.head import HeadErrors, HeadOptions, SimulatedHead
from tumble.drivers.simulated.noise import RandomWalk, Stream, flicker, generator, standard_normal
from tumble.drivers.simulated.room import Room
from tumble.drivers.simulated.settings import Simulated
from tumble.drivers.simulated.unit import Accelerometer, ExternalUnit, Unit
from tumble.drivers.simulated.worlds import Surroundings, WorldKind
from tumble.drivers.tables import HEAD, MOUNT


class WiredUnit:
    """The unit in its room, as a DAQ that is wired to it sees it. Fits `daq.Terminals`."""

    def __init__(self, settings: Simulated, bench: Bench, unit: Unit, began_s: float) -> None:
        self._settings = settings
        self._bench = bench
        self._unit = unit
        self._began_s = began_s
        self._room = Room(settings.temperature, settings.seed)
        self._flicker = flicker(settings.seed, settings.flicker_v)
        self._random_walk = RandomWalk(settings.seed, v_per_sqrt_h=settings.effects.bias_random_walk)

    @property
    def dwell(self) -> int:
        """Number of the dwell, from 1."""
        return self._bench.counts.dwells

    @property
    def mounting(self) -> int:
        """Number of the mounting, from 1."""
        return self._bench.counts.mountings

    def begin_acquisition(self) -> None:
        """Note that samples are about to be taken."""
        self._bench.begin_acquisition()

    def postpone(self, outage_s: float) -> None:
        """Count time as if the world had begun so much later."""
        self._began_s += outage_s

    def output_v(self, times_s: FloatArray) -> FloatArray:
        """Output at rising clock times with everything but the white noise of the samples."""
        since_s = times_s - self._began_s
        gravity_g = self._bench.gravity_g(times_s)
        response_v = self._unit.voltage_v(gravity_g, self._room.temperature_degc(since_s), since_s)
        wandering_v = self._flicker.at(since_s) + self._random_walk.at(since_s)
        return response_v + wandering_v + self._constant_bias_v()

    def sample_v(self, times_s: FloatArray) -> FloatArray:
        """Samples of the output; their noise belongs to the dwell and to the number of the acquisition in it.

        How often the output was looked at in another dwell, to see whether it had settled, leaves it as it is.
        """
        counts = self._bench.counts
        random = generator(self._settings.seed, Stream.SAMPLES, counts.dwells, counts.in_dwell)
        noise_v = self._noise_v() * random.standard_normal(len(times_s))
        return self.output_v(times_s) + noise_v

    def sensor_degc(self, time_s: float) -> float:
        """Temperature at a clock time with the noise of the sensor."""
        counts = self._bench.counts
        drawn = standard_normal(self._settings.seed, Stream.THERMOMETER, counts.dwells, counts.in_dwell)
        true_degc = float(self._room.temperature_degc(np.array([time_s - self._began_s]))[0])
        return true_degc + self._settings.temperature.sensor_noise_k * drawn

    def _noise_v(self) -> float:
        """Standard deviation of the samples in this dwell: the vibration level is drawn anew for each."""
        drawn = standard_normal(self._settings.seed, Stream.VIBRATION, self._bench.counts.dwells)
        return self._settings.sample_noise_v * math.exp(self._settings.vibration_level_spread * drawn)

    def _constant_bias_v(self) -> float:
        """Bias that does not change within a dwell: turn-on, hysteresis, vibration rectification."""
        effects = self._settings.effects
        drawn = standard_normal(self._settings.seed, Stream.TURN_ON, self._bench.counts.turn_ons)
        turn_on_v = effects.realisation_bias * drawn
        rectified_v = effects.vibration_rectification * self._noise_v() ** 2
        return turn_on_v + self._bench.hysteresis_v + rectified_v


class SimulatedWorld:
    """Everything that is true at the simulated stand, and the instruments through which it is seen.

    The world begins at the clock's present time with the unit face-up, the head at zero and the power on.

    Raises
    ------
    ValueError
        Where a function that the settings name cannot be loaded.
    """

    def __init__(self, settings: Simulated, *, clock: Clock, head: HeadOptions, base_path: Path) -> None:
        effects = settings.effects
        self._unit = _unit(settings, base_path)
        self._bench = Bench(settings, clock, head, _head_errors(settings, base_path))
        self._converter = Converter(effects, resolution_v=settings.resolution_v, range_v=settings.range_v)
        self._terminals = WiredUnit(settings, self._bench, self._unit, clock.monotonic_s())
        self.head: SimulatedHead = self._bench.head
        self.daq = SimulatedDaq(clock, self._terminals, self._converter, settling=effects.settling)

    @property
    def counts(self) -> Counts:
        """What has happened so far."""
        return self._bench.counts

    @property
    def positioners(self) -> Mapping[str, SimulatedHead]:
        """The head, by its name."""
        return {HEAD: self.head}

    def meter(self, channels: Sequence[str]) -> SimulatedDaq:  # noqa: ARG002  # there is one output
        """The voltmeter at the only output, whatever it is called."""
        return self.daq

    @property
    def chamber(self) -> None:
        """There is only the room."""
        return

    @property
    def mount(self) -> str:
        """Mount in which the unit sits."""
        return self._bench.mount

    @property
    def setters(self) -> Mapping[str, Callable[[str], None]]:
        """What a person may set here between dwells, by condition."""
        return {MOUNT: self.seat}

    def seat(self, mount: str) -> None:
        """Seat the unit in another mount. Raises `ValueError` for one that does not exist."""
        self._bench.seat(mount)

    def switch_on(self) -> None:
        """Switch the unit off and on for a moment: its bias is drawn anew, but it stays warm."""
        self.counts.turn_ons += 1

    def put_back(self, counts: Counts, outage_s: float) -> None:
        """Count the draws on from `counts`, and have everything that drifts and wanders stand as `outage_s` ago."""
        vars(self._bench.counts).update(vars(counts))
        self._bench.postpone(outage_s)
        self._terminals.postpone(outage_s)

    def noise_free_voltage(self, mounts: Sequence[str], angles_deg: ArrayLike) -> FloatArray:
        """Mean reading at each reported angle with every static effect and none of time or history.

        At 23 °C, settled, after a move in + direction, in a perfect seat; shape (rows,), in V. Raises `ValueError` for
        a mount that does not exist.
        """
        gravity_g = self._bench.static_gravity_g(mounts, np.asarray(angles_deg, dtype=np.float64))
        return self._converter.distorted_v(self._unit.static_v(gravity_g))


def _build(settings: Simulated, surroundings: Surroundings) -> SimulatedWorld:
    head = surroundings.heads.get(HEAD, HeadOptions())
    return SimulatedWorld(settings, clock=surroundings.clock, head=head, base_path=surroundings.folder)


WORLD: Final = WorldKind(table=Simulated, build=_build)


def _unit(settings: Simulated, base_path: Path) -> Unit:
    if settings.response is None:
        return Accelerometer(settings.unit_parameters, settings.effects)
    return ExternalUnit(load_function(settings.response, base_path))


def _head_errors(settings: Simulated, base_path: Path) -> HeadErrors:
    external = None if settings.head_error is None else load_function(settings.head_error, base_path)
    return HeadErrors(settings.effects, external)
