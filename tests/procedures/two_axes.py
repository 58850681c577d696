"""A method that exists in the tests only: three channels on two axes, and a base that the operator levels."""

import math
from dataclasses import dataclass
from importlib.resources import files
from typing import ClassVar, Literal

import numpy as np
from fakes import QUICK, FakeDaq, FakeHead, FakeOperator, MemorySink
from pydantic import BaseModel

from tumble.drivers.attention import Attention
from tumble.drivers.clock import VirtualClock
from tumble.drivers.protocols import ChannelBlock, Identity, Stand
from tumble.procedures.engine import Engine
from tumble.procedures.layout import ChannelColumns, Column, Condition, Layout, PositionColumns
from tumble.procedures.method import ProcedurePart
from tumble.procedures.programme import Programme
from tumble.procedures.steps import Dwell

AXES = ("outer", "inner")
MADE = []
"""Axes that a driver file of a test has made."""
CHANNELS = ("u_x_v", "u_y_v", "u_z_v")

LAYOUT = Layout(
    positions={
        name: PositionColumns(
            position_deg=Column(name=f"{name}_deg", meaning=f"angle of the {name} axis, deg"),
            direction=Column(name=f"{name}_direction", meaning=f"sign of the last move of the {name} axis"),
        )
        for name in AXES
    },
    channels={
        name: ChannelColumns(
            mean=Column(name=name, meaning="mean, V"),
            sd=Column(name=name.replace("u_", "sd_"), meaning="standard deviation of the single samples, V"),
            samples=Column(name="samples", meaning="number of samples in the mean"),
        )
        for name in CHANNELS
    },
    conditions={
        "base": Condition(
            meaning="how the base leans",
            step="levelling",
            task="bring the base to {value}",
            remedy="bring it there",
            prompt="Bring the base to {value}; answer yes when it stands so.",
            hint="Type {value} or yes, or no to end the run.",
        )
    },
)


class Positions(BaseModel):
    """Positions of both axes, one after the other."""

    places_deg: tuple[tuple[float, float], ...]
    base: str = "level"

    def dwells(self, realisation):
        for place_deg in self.places_deg:
            yield dwell_at(*place_deg, realisation=realisation, base=self.base)


class TwoAxesProgramme(Programme):
    """Positions of two axes."""

    layout: ClassVar[Layout] = LAYOUT

    method: Literal["two_axes"]
    positions: Positions

    @property
    def parts(self):
        return (self.positions,)

    def nominal(self, dwell):
        return dict.fromkeys(dwell.channels, 0.0)


@dataclass(frozen=True)
class TwoAxesMethod:
    name: str = "two_axes"
    version: int = 2
    procedure_part: ProcedurePart = ProcedurePart(  # noqa: RUF009  # frozen
        programme=TwoAxesProgramme,
        shipped=files("tumble.procedures.recording"),
        table=lambda recording: recording.points,
    )


TWO_AXES = TwoAxesMethod()


def dwell_at(outer_deg, inner_deg, realisation=1, base="level"):
    return Dwell(
        targets_deg={"outer": outer_deg, "inner": inner_deg},
        channels=CHANNELS,
        procedure="position",
        realisation=realisation,
        conditions={"base": base},
    )


class Triad:
    """Three accelerometers of 1 V/g on the inner axis, with a ripple of 1 mV."""

    def __init__(self, clock, outer, inner):
        self._clock, self._outer, self._inner = clock, outer, inner

    def identify(self):
        return Identity(model="fake triad", serial="3")

    def acquire(self, samples, rate_hz):
        began_s = self._clock.monotonic_s()
        outer_rad, inner_rad = (math.radians(axis.status().angle_deg) for axis in (self._outer, self._inner))
        across = -math.sin(outer_rad)
        means_v = (across * math.sin(inner_rad), across * math.cos(inner_rad), -math.cos(outer_rad))
        ripple_v = 1e-3 * (-1.0) ** np.arange(samples)
        self._clock.sleep(samples / rate_hz)
        channels = {name: mean_v + ripple_v for name, mean_v in zip(CHANNELS, means_v, strict=True)}
        return ChannelBlock(channels=channels, rate_hz=rate_hz, device_time_s=began_s, temperature_degc=None)


class TwoAxesStand:
    """Everything that an engine needs for a triad on two axes, and the engine."""

    def __init__(self):
        self.clock = VirtualClock(wall_start_ns=0)
        self.outer, self.inner = FakeHead(self.clock), FakeHead(self.clock)
        self.samplers = {"triad": Triad(self.clock, self.outer, self.inner)}
        self.operator = FakeOperator(FakeDaq(self.clock, self.outer))
        self.sink = MemorySink()
        self.titles = {"outer": "outer axis", "inner": "inner axis"}
        self.attention = Attention()

    def engine(self, acquisition=QUICK, sink=None):
        stand = Stand(
            name="two axes",
            positioners={"outer": self.outer, "inner": self.inner},
            samplers=self.samplers,
            clock=self.clock,
            titles=self.titles,
            attention=self.attention,
        )
        return Engine(stand, self.operator, sink or self.sink, acquisition)
