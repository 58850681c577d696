"""The columns of a dwell of a gyro platform on an azimuth turntable."""

from typing import Final

from tumble.messages import Message, translatable
from tumble.procedures.layout import ChannelColumns, Column, Condition, Layout, PositionColumns
from tumble.procedures.steps import Dwell

AZIMUTH: Final = "azimuth"
"""Name of the positioner."""
BASE: Final = "base"
"""The condition that a person sets: the number of the way in which the base leans, as text."""
LEVELLING_RATE: Final = "levelling_rate_deg_h"
AZIMUTH_RATE: Final = "azimuth_rate_deg_h"
TILT_GAMMA: Final = "tilt_gamma_deg"
TILT_BETA: Final = "tilt_beta_deg"
"""How far the platform is off level; heeded while it settles, where the stand has such a channel."""
_WORDS: Final = (
    Message.named(LEVELLING_RATE, "levelling rate"),
    Message.named(AZIMUTH_RATE, "azimuth rate"),
    Message.named(TILT_GAMMA, "tilt γ"),
    Message.named(TILT_BETA, "tilt β"),
)
"""What a reader is shown in the place of these."""
_SAMPLES: Final = Column(name="samples", meaning="number of samples in each mean")


LAYOUT: Final = Layout(
    positions={
        AZIMUTH: PositionColumns(
            position_deg=Column(name="azimuth_deg", meaning="pickoff angle of the turntable, counterclockwise, deg"),
            direction=Column(name="direction", meaning="sign of the last move of the turntable"),
        )
    },
    channels={
        LEVELLING_RATE: ChannelColumns(
            mean=Column(name=LEVELLING_RATE, meaning="mean levelling-correction rate over the dwell, °/h"),
            sd=Column(name="rate_sd_deg_h", meaning="standard deviation of the single samples of it, °/h"),
            samples=_SAMPLES,
        ),
        AZIMUTH_RATE: ChannelColumns(
            mean=Column(name=AZIMUTH_RATE, meaning="mean rate of the azimuth channel over the dwell, °/h"),
            sd=Column(name="azimuth_rate_sd_deg_h", meaning="standard deviation of the single samples of it, °/h"),
            samples=_SAMPLES,
            optional=True,
        ),
        TILT_GAMMA: ChannelColumns(
            mean=Column(name=TILT_GAMMA, meaning="mean tilt of the levelling axis, positive where it points down, deg"),
            sd=Column(name="tilt_gamma_sd_deg", meaning="standard deviation of the single samples of it, deg"),
            samples=_SAMPLES,
        ),
    },
    conditions={
        BASE: Condition(
            meaning="number of the way in which the base leans",
            step="lean",
            task=translatable("lean the base as number {value}"),
            remedy=translatable("lean it"),
            prompt=translatable(
                "Lean the base as number {value} (1: as it stands) without turning it in azimuth; "
                "answer yes when it rests."
            ),
            hint=translatable("Type {value} or yes when the base leans so and rests, or no to end the run."),
            optional=True,
        )
    },
)


def dwell_at(azimuth_deg: float, realisation: int, base: int | None) -> Dwell:
    """A dwell of rate, tilt and any azimuth channel with the turntable at an angle, `base` leaning; None for any."""
    return Dwell(
        targets_deg={AZIMUTH: azimuth_deg},
        channels=(LEVELLING_RATE, TILT_GAMMA),
        further=(AZIMUTH_RATE,),
        procedure="position",
        realisation=realisation,
        conditions={} if base is None else {BASE: str(base)},
    )
