"""What a programme may do with a unit in its mountings: rest, vibration, rest, for a list of excitations."""

from collections.abc import Iterator, Mapping, Sequence
from itertools import product
from math import pi
from typing import Annotated, Literal, Self, TypeAlias

import numpy as np
from pydantic import BaseModel, ConfigDict, Field, model_validator

from tumble.drivers.excitation import REST, Excitation, Random, Rotation, Sines, Tone, random_of
from tumble.drivers.mountings import Mounting
from tumble.messages import Message
from tumble.procedures.composition import Dwells
from tumble.procedures.methods.vibration.layout import dwell_of
from tumble.procedures.methods.vibration.profiles import PROFILES

Order: TypeAlias = Literal["as-listed", "there-and-back", "shuffled"]
_Level: TypeAlias = Annotated[float, Field(gt=0.0, le=1e5)]
_Hz: TypeAlias = Annotated[float, Field(gt=0.0, le=1e6)]
_STRICT = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False, populate_by_name=True)


class MountingTable(BaseModel):
    """How the unit sits: directions in the unit, `i`, `-o`, `i+o`."""

    model_config = _STRICT

    x: str = "i"
    """Along which the table is driven."""
    y: str = "o"
    """Sideways."""
    down: str = "p"

    @model_validator(mode="after")
    def _possible(self) -> Self:
        assert self.mounting
        return self

    @property
    def mounting(self) -> Mounting:
        """The same. Raises `ValueError` where x and y are not square to each other."""
        return Mounting(x=self.x, y=self.y, down=self.down)


class Excited(BaseModel):
    """What all kinds have in common: in each mounting a rest, and after every excitation another."""

    model_config = _STRICT

    mountings: tuple[MountingTable, ...] = Field(default=(MountingTable(),), min_length=1, max_length=1000)
    repeats: int = Field(default=1, ge=1, le=10_000)
    """How often the excitations are taken in each mounting."""
    order: Order = "as-listed"
    """`there-and-back` takes them, and then again from the last."""
    seed: int = Field(default=0, ge=0)
    """Seed of the order `shuffled`; the others do not use it."""

    @property
    def excitations(self) -> Sequence[Excitation]:
        """As listed, once."""
        raise NotImplementedError

    @property
    def poses(self) -> int:
        """Number of dwells."""
        times = self.repeats * (2 if self.order == "there-and-back" else 1)
        return len(self.mountings) * (1 + 2 * times * len(self.excitations))

    def dwells(self, realisation: int) -> Dwells:
        """Take every mounting in turn."""
        for number, table in enumerate(self.mountings):
            mounting = table.mounting
            yield dwell_of(mounting, REST, realisation)
            for excitation in self._ordered(realisation * len(self.mountings) + number):
                yield dwell_of(mounting, excitation, realisation)
                yield dwell_of(mounting, REST, realisation)

    def _ordered(self, number: int) -> Iterator[Excitation]:
        random = np.random.default_rng((self.seed, number))
        for _ in range(self.repeats):
            listed = list(self.excitations)
            match self.order:
                case "as-listed":
                    yield from listed
                case "there-and-back":
                    yield from listed + listed[::-1]
                case "shuffled":
                    yield from (listed[place] for place in random.permutation(len(listed)))


class SineProcedure(Excited):
    """A shaker along x: every level at every frequency, or pairs of both."""

    kind: Literal["sine"] = "sine"
    levels_g: tuple[_Level, ...] = Field(default=(), max_length=1000)
    """Peak."""
    frequencies_hz: tuple[_Hz, ...] = Field(default=(), alias="frequencies_Hz", max_length=1000)
    sines: tuple[tuple[_Level, _Hz], ...] = Field(default=(), max_length=10_000)
    """Level and frequency of each, in place of both lists."""

    @model_validator(mode="after")
    def _one_list(self) -> Self:
        if bool(self.sines) == bool(self.levels_g and self.frequencies_hz) or (
            self.sines and (self.levels_g or self.frequencies_hz)
        ):
            raise ValueError(Message("give levels_g and frequencies_Hz, or sines, and not both"))
        return self

    @property
    def excitations(self) -> list[Excitation]:
        """Frequency by frequency, or pair by pair."""
        pairs = self.sines or [(level_g, hz) for hz, level_g in product(self.frequencies_hz, self.levels_g)]
        return [Sines(tones=(Tone(level_g=level_g, frequency_hz=hz),)) for level_g, hz in pairs]


class RandomProcedure(Excited):
    """A shaker along x: a spectral density, at several r.m.s. values where they are named."""

    kind: Literal["random"]
    psd: tuple[tuple[float, float], ...] = ()
    """Points (Hz, g²/Hz), straight between on logarithmic scales."""
    profile: str = ""
    """A spectral density that comes along, in place of `psd`."""
    levels_g: tuple[_Level, ...] = Field(default=(), max_length=1000)
    """R.m.s. values to which it is brought; without them its own."""

    @model_validator(mode="after")
    def _one_density(self) -> Self:
        if bool(self.psd) == bool(self.profile):
            raise ValueError(Message("name one profile, or give psd, and not both"))
        if self.profile and self.profile not in PROFILES:
            known = ", ".join(PROFILES)
            raise ValueError(
                Message("no profile is called {name!r}; known are {known}", name=self.profile, known=known)
            )
        assert self.density
        return self

    @property
    def density(self) -> Random:
        """The density. Raises `ValueError`."""
        return random_of(PROFILES[self.profile] if self.profile else self.psd)

    @property
    def excitations(self) -> list[Excitation]:
        """At every r.m.s. value."""
        density = self.density
        own_g = density.rms_g
        return [density.scaled(level_g / own_g) for level_g in self.levels_g or (own_g,)]


class ShakersProcedure(Excited):
    """Several shakers at once, along x, y and z of the table."""

    kind: Literal["shakers"]
    levels_g: dict[Literal["x", "y", "z"], _Level] = Field(min_length=1)
    frequencies_hz: dict[Literal["x", "y", "z"], _Hz] = Field(alias="frequencies_Hz", min_length=1)
    phases_deg: tuple[dict[Literal["x", "y", "z"], float], ...] = Field(default=({},), min_length=1, max_length=1000)
    """A dwell for each; a shaker that is not named has 0°."""

    @model_validator(mode="after")
    def _same_shakers(self) -> Self:
        if self.levels_g.keys() != self.frequencies_hz.keys():
            raise ValueError(Message("levels_g and frequencies_Hz name different shakers"))
        return self

    @property
    def excitations(self) -> list[Excitation]:
        """For each set of phases."""
        return [Sines(tones=tuple(self._tones(phases))) for phases in self.phases_deg]

    def _tones(self, phases: Mapping[Literal["x", "y", "z"], float]) -> Iterator[Tone]:
        for name, level_g in sorted(self.levels_g.items()):
            hz = self.frequencies_hz[name]
            yield Tone(shaker=name, level_g=level_g, frequency_hz=hz, phase_deg=phases.get(name, 0.0))


class CentrifugeProcedure(Excited):
    """A double centrifuge: every rate of its arm with every rate of its table."""

    kind: Literal["centrifuge"]
    main_rad_s: tuple[Annotated[float, Field(gt=-1e3, lt=1e3)], ...] = Field(min_length=1, max_length=1000)
    frequencies_hz: tuple[Annotated[float, Field(gt=-1e3, lt=1e3)], ...] = Field(
        alias="frequencies_Hz", min_length=1, max_length=1000
    )
    """Of the table against the arm, with its sense."""

    @property
    def excitations(self) -> list[Excitation]:
        """Rate by rate."""
        return [
            Rotation(main_rad_s=main_rad_s, sub_rad_s=2.0 * pi * hz)
            for main_rad_s, hz in product(self.main_rad_s, self.frequencies_hz)
        ]


VibrationProcedure: TypeAlias = Annotated[
    SineProcedure | RandomProcedure | ShakersProcedure | CentrifugeProcedure, Field(discriminator="kind")
]
