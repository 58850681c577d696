"""The narrow interfaces through which the engine sees a stand.

Adding an instrument means writing one class that fits one of these and declaring it (`tumble.drivers.driver`); nothing
inherits from anything.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Protocol, TypeAlias, runtime_checkable

import numpy as np
from numpy.typing import NDArray

from tumble.drivers.attention import Attention, AttentiveClock
from tumble.drivers.clock import Clock
from tumble.drivers.excitation import Excitation

FloatArray: TypeAlias = NDArray[np.float64]

VOLTAGE: Final = "voltage_v"
"""Name of the channel of a sampler that has only one."""


@dataclass(frozen=True, kw_only=True)
class Identity:
    """Who an instrument says it is, for example `Identity(model="X-RST120", serial="51234", firmware="7.32")`."""

    model: str
    serial: str
    firmware: str = ""
    remarks: tuple[str, ...] = field(default=(), compare=False)
    """What this instrument cannot do, or cannot be asked, as others of its kind can: told and recorded with the run."""


@dataclass(frozen=True, kw_only=True)
class PositionerStatus:
    """What a positioner reports at one moment."""

    angle_deg: float
    """Angle as the head reads it, in degrees; any revolution (395 stays 395)."""
    moving: bool
    device_time_s: float
    """The head's own clock, or the computer's where the head has none."""
    referenced: bool = True
    """Whether the head knows its angle; false from the loss of its power until it has been homed."""
    by_hand: bool = False
    """Whether a person turns the head and reads it: who may take any time, and whose reading is where it stands."""
    target_deg: float | None = None
    """Where it was sent; None where it was not, or is to find its reference. Who sent it says so, and no driver."""

    @property
    def turning(self) -> bool:
        """Whether it moves by itself: one that is turned by hand is awaited."""
        return self.moving and not self.by_hand


@dataclass(frozen=True, kw_only=True)
class SampleBlock:
    """Voltage samples of a sampler with one channel, taken at an even rate while everything stood still."""

    voltage_v: FloatArray
    """Shape (samples,), in volts. Overload is what the instrument says (9.9e37 on SCPI meters), never clipped."""
    rate_hz: float
    device_time_s: float
    """The DAQ's own time of the first sample."""
    temperature_degc: float | None
    """Mean of the temperature channel over the block; None where the DAQ has no such channel."""

    @property
    def channels(self) -> Mapping[str, FloatArray]:
        """The one channel, by its name."""
        return {VOLTAGE: self.voltage_v}

    @property
    def temperatures_degc(self) -> Mapping[str, float]:
        """The one thermometer is that of the whole."""
        return {}


@dataclass(frozen=True, kw_only=True)
class ChannelBlock:
    """Samples of several channels, or of one that is no voltage, taken together."""

    channels: Mapping[str, FloatArray]
    """By name, the unit in it (`rate_deg_h`); each of the shape (samples,)."""
    rate_hz: float
    device_time_s: float
    """The sampler's own time of the first sample."""
    temperature_degc: float | None
    """As in `SampleBlock`."""
    temperatures_degc: Mapping[str, float] = field(default_factory=dict)
    """Of what each channel measures, by channel, as far as it has a thermometer of its own."""


Block: TypeAlias = SampleBlock | ChannelBlock
"""What a sampler gives."""


class Positioner(Protocol):
    """What turns the unit about one axis, as a dividing head does. Angles in degrees, positive as it counts."""

    @property
    def limits_deg(self) -> tuple[float, float]:
        """Soft limits; there is no 'unlimited'."""
        ...

    @property
    def speed_deg_s(self) -> float:
        """Speed of a move, for planning."""
        ...

    def identify(self) -> Identity:
        """Ask the instrument who it is. Raises `DeviceError`."""
        ...

    def home(self) -> None:
        """Find the reference; returns at once, `status` tells when it is done. Raises `DeviceError`."""
        ...

    def start_move(self, angle_deg: float) -> None:
        """Begin to move to `angle_deg`; returns at once. Raises `LimitError`, `DeviceError`."""
        ...

    def status(self) -> PositionerStatus:
        """Read position and motion back from the instrument. Raises `DeviceError`."""
        ...

    def stop(self) -> None:
        """Brake to a standstill; returns at once, `status` tells when it stands. Raises `DeviceError`."""
        ...


class Sampler(Protocol):
    """What takes samples of one channel or several, as a voltmeter does, with an optional temperature."""

    def identify(self) -> Identity:
        """Ask the instrument who it is. Raises `DeviceError`."""
        ...

    def acquire(self, samples: int, rate_hz: float) -> Block:
        """Take `samples` readings at `rate_hz`, beginning now; returns when the last is there. Raises `DeviceError`."""
        ...


@dataclass(frozen=True, kw_only=True)
class EnvironmentStatus:
    """What a temperature chamber reports at one moment."""

    temperature_degc: float
    """Of its air, as it measures it."""
    setpoint_degc: float
    """What it was told."""
    door_open: bool = False
    alarm: bool = False
    """Whether it complains of a fault of its own."""
    running: bool = True
    """Whether it follows its set point; true where it cannot be asked."""


class Environment(Protocol):
    """What gives the unit a temperature, as a chamber does."""

    @property
    def limits_degc(self) -> tuple[float, float]:
        """Set points that may be asked for."""
        ...

    @property
    def ramp_k_per_min(self) -> float | None:
        """The steepest change of the set point that unit and chamber may be given; None for a step at once."""
        ...

    def identify(self) -> Identity:
        """Ask the instrument who it is. Raises `DeviceError`."""
        ...

    def begin(self, setpoint_degc: float) -> None:
        """Run, towards a set point; returns at once. Raises `LimitError`, `DeviceError`."""
        ...

    def status(self) -> EnvironmentStatus:
        """Read temperature, set point and door back. Raises `DeviceError`."""
        ...

    def lock_door(self, locked: bool) -> None:
        """Keep the door shut, or let it be opened; nothing where it has no lock. Raises `DeviceError`."""
        ...

    def make_safe(self) -> None:
        """Bring it to the state in which it may be left alone; returns at once. Raises `DeviceError`."""
        ...


@dataclass(frozen=True, kw_only=True)
class ExciterStatus:
    """What an exciter reports at one moment."""

    excitation: Excitation
    """What it is set to, as it says itself; a level of zero where it gives none."""
    on: bool
    """Whether it drives."""
    overload: bool = False
    """Whether it, or its amplifier, complains."""


class Exciter(Protocol):
    """What shakes the unit, or turns it in a centrifuge, while dwells are taken."""

    @property
    def ramp_s(self) -> float:
        """Time from rest to a level, and back."""
        ...

    def identify(self) -> Identity:
        """Ask the instrument who it is. Raises `DeviceError`."""
        ...

    def drive(self, excitation: Excitation) -> None:
        """Drive so from now on; returns at once. Raises `LimitError`, `DeviceError`."""
        ...

    def status(self) -> ExciterStatus:
        """Read level, frequency and output back from the instrument. Raises `DeviceError`."""
        ...

    def make_safe(self) -> None:
        """Drive at zero, output off; returns at once, `status` tells whether it is so. Raises `DeviceError`."""
        ...


@runtime_checkable
class Reconnectable(Protocol):
    """An instrument behind a link that can vanish and return."""

    def reconnect(self) -> None:
        """Open the link anew and forget what was under way on the old one. Raises `LinkLostError` while it is away."""
        ...


@runtime_checkable
class Resettable(Protocol):
    """An instrument that stays in fault until it is told that the cause is gone."""

    def reset_fault(self) -> str:
        """Reset the fault that it was left in; returns which, and nothing where there was none.

        To be called only where somebody has seen to the cause: when a run begins. Raises `DeviceError` where the cause
        is still there.
        """
        ...


@runtime_checkable
class Remarking(Protocol):
    """An instrument that counts what it or its link put right: spoilt frames dropped, sendings tried again."""

    def remarks(self) -> Sequence[str]:
        """Sentences for whoever reads the result; what happens often is told again only now and then."""
        ...

    def last_remarks(self) -> Sequence[str]:
        """Sentences on everything that has grown since it was told; asked when a run ends."""
        ...


Instrument: TypeAlias = Positioner | Sampler | Environment | Exciter
"""Any instrument of a stand."""

DividingHead: TypeAlias = Positioner
Daq: TypeAlias = Sampler
HeadStatus: TypeAlias = PositionerStatus
"""The names of version 0.1, which drivers of others import."""


@dataclass(frozen=True, kw_only=True)
class Stand:
    """Instruments by name and the clock by which they live: all that the engine needs to know of a stand.

    No positioner has the name of a sampler.
    """

    name: str
    positioners: Mapping[str, Positioner]
    samplers: Mapping[str, Sampler]
    clock: Clock
    serials: Mapping[str, str] = field(default_factory=dict)
    """Serial numbers that the instruments must have, by name; any where nothing is said."""
    titles: Mapping[str, str] = field(default_factory=dict)
    """What sentences call the instruments, by name; the name itself where nothing is said."""
    environments: Mapping[str, Environment] = field(default_factory=dict)
    """What sets a condition of dwells by itself, by the condition, whose name is that of the instrument, too."""
    exciters: Mapping[str, Exciter] = field(default_factory=dict)
    """What shakes the unit, by the condition that it sets, whose name is that of the instrument, too."""
    most: Mapping[str, float] = field(default_factory=dict)
    """The greatest magnitude that a sample of a channel may have, by its name; beyond it the excitation is ended."""
    quiet: Mapping[str, float] = field(default_factory=dict)
    """The greatest standard deviation of the samples of a channel while every exciter rests."""
    channels: Mapping[str, Sequence[str]] = field(default_factory=dict)
    """Names of the channels of a sampler, in their order, by its name; those that it gives where nothing is said."""
    attention: Attention = field(default_factory=Attention)
    """Paid by the instruments while their answers are awaited, as far as these can be done without."""

    @property
    def instruments(self) -> Mapping[str, "Instrument"]:
        """All of them, by name."""
        return {**self.positioners, **self.samplers, **self.environments, **self.exciters}

    @property
    def attentive_clock(self) -> Clock:
        """The clock, whose waits are broken off as those for an instrument are."""
        return AttentiveClock(self.clock, self.attention.check)

    def title(self, name: str) -> str:
        """What sentences call an instrument."""
        return self.titles.get(name) or name
