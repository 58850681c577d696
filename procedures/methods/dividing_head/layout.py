"""The columns of a dwell on a dividing head."""

from typing import Final

from tumble.drivers.protocols import VOLTAGE
from tumble.drivers.tables import MOUNT as MOUNT
from tumble.messages import translatable
from tumble.procedures.layout import ChannelColumns, Column, Condition, Layout, PositionColumns
from tumble.procedures.steps import Ask, Dwell

HEAD: Final = "head"
"""Name of the positioner."""
LAYOUT: Final = Layout(
    positions={
        HEAD: PositionColumns(
            position_deg=Column(name="angle_deg", meaning="angle as the head reports it, deg; any revolution"),
            direction=Column(name="direction", meaning="sign of the last move of the head; 0 before the first"),
        )
    },
    channels={
        VOLTAGE: ChannelColumns(
            mean=Column(name="voltage_v", meaning="mean output over the dwell, V"),
            sd=Column(name="voltage_sd_v", meaning="standard deviation of the single samples, V"),
            samples=Column(name="samples", meaning="number of samples in the mean"),
        )
    },
    conditions={
        MOUNT: Condition(
            meaning="how the unit sits on the head",
            step="mounting",
            task=translatable("seat the unit in {value}"),
            remedy=translatable("seat it"),
            prompt=translatable("Seat the unit in the mount {value}; answer {value} or yes when it sits there."),
            hint=translatable("Type {value} or yes when the unit sits there, or no to end the run."),
        )
    },
)


def dwell_at(*, angle_deg: float, procedure: str, realisation: int, mount: str) -> Dwell:
    """A dwell at a head angle, any revolution, of the unit in a mount."""
    return Dwell(
        targets_deg={HEAD: angle_deg},
        channels=(VOLTAGE,),
        procedure=procedure,
        realisation=realisation,
        conditions={MOUNT: mount},
    )


def mounting(mount: str) -> Ask:
    """Have the unit seated in a mount, a key of `tumble.calibrations.methods.dividing_head.geometry.MOUNTS`."""
    return LAYOUT.ask(MOUNT, mount)
