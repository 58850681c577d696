"""The columns of a dwell of a triad on two axes."""

from typing import Final

from tumble.messages import translatable
from tumble.procedures.layout import ChannelColumns, Column, Condition, Layout, PositionColumns
from tumble.procedures.steps import Dwell

OUTER: Final = "outer"
INNER: Final = "inner"
"""Names of the positioners."""
CHANNELS: Final = ("u_x_v", "u_y_v", "u_z_v")
CHAMBER: Final = "chamber"
"""The condition that a chamber sets, or a person: the temperature, in °C, as text."""


def _axis(name: str) -> PositionColumns:
    return PositionColumns(
        position_deg=Column(name=f"{name}_deg", meaning=f"angle of the {name} axis as reported, deg"),
        direction=Column(name=f"{name}_direction", meaning=f"sign of the last move of the {name} axis"),
    )


def _channel(axis: str) -> ChannelColumns:
    return ChannelColumns(
        mean=Column(name=f"u_{axis}_v", meaning=f"mean output of channel {axis} over the dwell, V"),
        sd=Column(name=f"sd_{axis}_v", meaning=f"standard deviation of the single samples of channel {axis}, V"),
        samples=Column(name="samples", meaning="number of samples in each mean"),
        temperature=Column(name=f"temperature_{axis}_degc", meaning=f"temperature of accelerometer {axis}, °C"),
    )


LAYOUT: Final = Layout(
    positions={name: _axis(name) for name in (OUTER, INNER)},
    channels={f"u_{axis}_v": _channel(axis) for axis in "xyz"},
    conditions={
        CHAMBER: Condition(
            meaning="temperature to which the unit was soaked, °C",
            step="soak",
            task=translatable("bring the unit to {value} °C"),
            remedy=translatable("soak it"),
            prompt=translatable("Bring the unit to {value} °C; answer yes when it has that temperature throughout."),
            hint=translatable("Type {value} or yes when the unit has that temperature, or no to end the run."),
            optional=True,
        )
    },
)


def dwell_at(outer_deg: float, inner_deg: float, realisation: int) -> Dwell:
    """A dwell of all channels with the axes at two angles, in degrees."""
    return Dwell(
        targets_deg={OUTER: outer_deg, INNER: inner_deg},
        channels=CHANNELS,
        procedure="position",
        realisation=realisation,
    )
