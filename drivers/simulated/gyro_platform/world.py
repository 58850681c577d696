"""The world of a gyro platform: it levels itself on a turntable whose base leans, in a room."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.drivers.simulated.chamber import SimulatedChamber
from tumble.drivers.simulated.daq import OVERLOAD_V
from tumble.drivers.simulated.geometry import FloatArray
from tumble.drivers.simulated.gyro_platform.drift import AZIMUTH, LEVELLING, Wandering, white_deg_h
from tumble.drivers.simulated.gyro_platform.levelling import RAD_S_IN_DEG_H, LevellingLag
from tumble.drivers.simulated.gyro_platform.outputs import (
    AZIMUTH_RATE,
    CHANNELS,
    LEVELLING_RATE,
    TILT_BETA,
    TILT_GAMMA,
    PlatformOutputs,
)
from tumble.drivers.simulated.gyro_platform.pickoff import Pickoff
from tumble.drivers.simulated.gyro_platform.platform import Placed, Platform
from tumble.drivers.simulated.gyro_platform.settings import Lean, SimulatedPlatform
from tumble.drivers.simulated.head import HeadOptions, SimulatedHead
from tumble.drivers.simulated.noise import Stream, generator
from tumble.drivers.simulated.room import Room
from tumble.drivers.simulated.worlds import Surroundings, WorldKind
from tumble.messages import Message

TURNTABLE: Final = "azimuth"
BASE: Final = "base"
"""The condition that a person sets: the number of the way in which the base leans."""
_OPTIONS: Final = HeadOptions(limits_deg=(-370.0, 370.0), steps_per_deg=3600.0, speed_deg_s=9.0)
_LEANS: Final = 102
"""Stream of the leans that the table does not list, none of those of `Stream`."""
_MOST_DEG: Final = 3.0
_PAUSE_S: Final = 600.0
"""After this nothing remains of the rate in the dwell before."""


@dataclass(kw_only=True)
class Counts:
    """How often each thing has happened. Every random draw is keyed by one of these."""

    dwells: int = 0
    """Stays of the turntable at which something was acquired."""
    looks: int = 0
    """Acquisitions in the present dwell."""
    turn_ons: int = 1
    in_dwell: bool = False


class PlatformWorld:
    """Everything that is true at the stand. Fits `tumble.drivers.simulated.worlds.World`.

    It begins at the clock's present time with the turntable at zero, the base as number 1, and the platform level.
    """

    def __init__(self, settings: SimulatedPlatform, surroundings: Surroundings) -> None:
        self._settings, self._effects, self._clock = settings, settings.effects, surroundings.clock
        self._began_s = self._clock.monotonic_s()
        room = Room(settings.temperature, settings.seed)
        self.chamber = SimulatedChamber(self._clock, room.temperature_degc, unit_tau_s=settings.unit_tau_s)
        self.counts = Counts()
        self._lean = settings.leans_deg[0]
        self._platform, self._pickoff = Platform(settings), Pickoff(settings.effects)
        walk = settings.effects.drift_random_walk
        self._wandering = Wandering(settings.seed, LEVELLING, settings.noise, walk)
        self._azimuth_wandering = Wandering(settings.seed, AZIMUTH, settings.azimuth_noise, 0.0)
        options = surroundings.heads.get(TURNTABLE, _OPTIONS)
        self.head = SimulatedHead(self._clock, options, self._leave)
        self._lag = LevellingLag(settings.levelling_tau_s, self._followed)
        self._previous = _Previous()

    @property
    def positioners(self) -> Mapping[str, SimulatedHead]:
        """The turntable."""
        return {TURNTABLE: self.head}

    @property
    def setters(self) -> Mapping[str, Callable[[str], None]]:
        """The base is leaned by hand."""
        return {BASE: self.lean}

    def meter(self, channels: Sequence[str]) -> PlatformOutputs:
        """What samples these channels, all where none is named. Raises `ValueError` for one that it has not."""
        if unknown := [name for name in channels if name not in CHANNELS]:
            raise ValueError(
                Message(
                    "the simulated platform has no channel {name}; it has {there}",
                    name=unknown[0],
                    there=", ".join(CHANNELS),
                )
            )
        return PlatformOutputs(self._clock, self, channels or CHANNELS)

    def lean(self, number: str) -> None:
        """Lean the base as a number from 1: as the table lists, and beyond that as drawn. Raises `ValueError`."""
        if not (number.isdecimal() and int(number) >= 1):
            raise ValueError(Message("{number} is no number of a lean; they count from 1", number=number))
        now_s = self._clock.monotonic_s()
        before = self._placed(np.array([now_s]))
        self._leave()
        self._lean = self._lean_called(int(number))
        after = self._placed(np.array([now_s]))
        rate_deg_h = float((after.along_x_deg_h - before.along_x_deg_h)[0])
        self._lag.kick(now_s, rate_deg_h, float((after.level_rad - before.level_rad)[0]))

    def _lean_called(self, number: int) -> Lean:
        leans = self._settings.leans_deg
        if number <= len(leans):
            return leans[number - 1]
        gamma_deg, kappa_deg = generator(self._settings.seed, _LEANS, number).uniform(-_MOST_DEG, _MOST_DEG, 2).tolist()
        return gamma_deg, kappa_deg

    def switch_on(self) -> None:
        """Switch the platform off and on for a moment: its drift is drawn anew."""
        self.counts.turn_ons += 1

    def put_back(self, counts: Counts, outage_s: float) -> None:
        """Count the draws on from `counts`, and have everything that drifts and wanders stand as `outage_s` ago."""
        vars(self.counts).update(vars(counts))
        self._began_s += outage_s
        self.chamber.postpone(outage_s)

    def sample(self, times_s: FloatArray, rate_hz: float) -> dict[str, FloatArray]:
        """Every channel with its noise at clock times; the first samples after a move begin a dwell."""
        self._begin(float(times_s[0]))
        placed, since_s = self._placed(times_s), times_s - self._began_s
        lag_deg_h = self._lag.at(times_s)
        rest_deg_h = placed.along_x_deg_h + self._drift_deg_h(placed, times_s)
        beta_rad = -self._settings.levelling_tau_s * (rest_deg_h + lag_deg_h) / RAD_S_IN_DEG_H
        azimuth_deg_h = placed.azimuth_deg_h(beta_rad) + self._settings.azimuth_drift_deg_h
        quiet = {
            LEVELLING_RATE: self._platform.told_deg_h(rest_deg_h) + lag_deg_h,
            AZIMUTH_RATE: azimuth_deg_h + self._azimuth_wandering.at(np.maximum(since_s, 0.0)),
            TILT_GAMMA: self._platform.told_tilt_deg(placed.gamma_deg),
            TILT_BETA: np.rad2deg(beta_rad),
        }
        quiet[LEVELLING_RATE] = self._previous.in_it(quiet[LEVELLING_RATE], self._effects.settling, self.counts.dwells)
        self._previous.keep(quiet[LEVELLING_RATE], float(times_s[-1]))
        return {name: self._told(name, values, rate_hz) for name, values in quiet.items()}

    def sensor_degc(self, time_s: float) -> float:
        """Temperature of the platform with the noise of its sensor."""
        drawn = generator(
            self._settings.seed, Stream.THERMOMETER, self.counts.dwells, self.counts.looks
        ).standard_normal()
        noise_k = self._settings.temperature.sensor_noise_k
        return float(self.chamber.unit_degc(np.array([time_s]))[0] + noise_k * drawn)

    def _told(self, name: str, values: FloatArray, rate_hz: float) -> FloatArray:
        """A channel as it is told: with noise, in whole steps, 9.9e37 where it is out of range."""
        s, tilt = self._settings, name in (TILT_GAMMA, TILT_BETA)
        noise = {LEVELLING_RATE: s.noise, AZIMUTH_RATE: s.azimuth_noise}
        sd = s.tilt_noise_deg if tilt else white_deg_h(noise[name], rate_hz)
        stream = Stream.SAMPLES + len(Stream) * (1 + CHANNELS.index(name))
        random = generator(s.seed, stream, self.counts.dwells, self.counts.looks)
        noisy = values + sd * random.standard_normal(len(values))
        step = s.resolution_deg if tilt else s.resolution_deg_h
        shown = np.round(noisy / step) * step if step else noisy
        return shown if tilt else np.where(np.abs(noisy) > s.range_deg_h, OVERLOAD_V, shown)

    def _drift_deg_h(self, placed: Placed, times_s: FloatArray) -> FloatArray:
        since_s = np.maximum(times_s - self._began_s, 0.0)
        drawn = generator(self._settings.seed, Stream.TURN_ON, self.counts.turn_ons).standard_normal()
        steady = self._platform.drift_deg_h(placed, since_s, self.chamber.unit_degc(times_s))
        return steady + self._wandering.at(since_s) + self._effects.realisation_drift * drawn

    def _placed(self, times_s: FloatArray) -> Placed:
        """Where everything points at rising clock times from the beginning of the present move on."""
        reported_deg = np.array([self.head.move.angle_deg(time_s) for time_s in times_s.tolist()])
        delta_rad = self._pickoff.true_rad(reported_deg, self.head.direction) + self._misread_rad()
        return self._platform.placed(self._lean, delta_rad, times_s - self._began_s)

    def _misread_rad(self) -> float:
        misreading = self._effects.misreading
        if misreading is None or not self.counts.in_dwell or self.counts.dwells not in misreading.rows:
            return 0.0
        return float(np.deg2rad(misreading.error_deg))

    def _followed(self, reported_deg: FloatArray) -> tuple[FloatArray, FloatArray]:
        delta_rad = self._pickoff.true_rad(reported_deg, self.head.direction)
        since_s = np.full_like(delta_rad, self._clock.monotonic_s() - self._began_s)
        placed = self._platform.placed(self._lean, delta_rad, since_s)
        return placed.along_x_deg_h, np.unwrap(placed.level_rad)

    def _begin(self, now_s: float) -> None:
        self._lag.follow(self.head.move, now_s)
        if not self.counts.in_dwell:
            self.counts.in_dwell = True
            self.counts.dwells += 1
            self.counts.looks = 0
            self._previous.next_dwell(now_s)
        self.counts.looks += 1

    def _leave(self) -> None:
        """What is to be known before the turntable moves or the base leans otherwise."""
        self._lag.follow(self.head.move, self._clock.monotonic_s())
        self.counts.in_dwell = False


@dataclass(kw_only=True)
class _Previous:
    """What the levelling rate was in the dwell before, of which a part may remain."""

    last_deg_h: float | None = None
    last_s: float = -np.inf
    remaining_deg_h: float | None = None

    def next_dwell(self, now_s: float) -> None:
        """Begin a dwell: what was told last is what may remain."""
        self.remaining_deg_h = self.last_deg_h if now_s - self.last_s <= _PAUSE_S else None

    def keep(self, rate_deg_h: FloatArray, time_s: float) -> None:
        """Remember what was told."""
        self.last_deg_h, self.last_s = float(rate_deg_h.mean()), time_s

    def in_it(self, rate_deg_h: FloatArray, fraction: float, dwell: int) -> FloatArray:
        """The rate with what remains of the dwell before; none in the first."""
        if self.remaining_deg_h is None or dwell < 2:
            return rate_deg_h
        return np.asarray(rate_deg_h + fraction * (self.remaining_deg_h - rate_deg_h))


WORLD: Final = WorldKind(table=SimulatedPlatform, build=PlatformWorld)
