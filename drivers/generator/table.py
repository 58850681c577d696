"""A function generator in a stand file."""

from typing import Final, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, model_validator

from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.generator.models import LEAST_V_PP, MOST_V_PP
from tumble.drivers.tables import OnSerialLine
from tumble.messages import Message

SINGLE: Final = ""
"""Name in an excitation of the only shaker that there is."""


class OutputTable(BaseModel):
    """One output of the generator, with the amplifier and the shaker behind it."""

    model_config = ConfigDict(frozen=True, extra="forbid", allow_inf_nan=False)

    channel: Literal[1, 2] = 1
    g_per_v: float = Field(gt=0.0)
    """Acceleration of the table, in g, for each volt of the output, peak for peak."""
    load_ohm: float | None = Field(default=None, ge=1.0, le=10_000.0)
    """Input impedance of the amplifier; without it, high."""

    def peak_v(self, level_g: float) -> float:
        """Peak of the output for a level."""
        return level_g / self.g_per_v


class GeneratorTable(OnSerialLine, ExciterTable):
    """`driver = "generator"`."""

    outputs: dict[Literal["x", "y", "z"], OutputTable] = Field(min_length=1, max_length=2)
    """By the axis of the table along which its shaker shakes; one alone is that along x."""
    timeout_s: float = Field(default=2.0, gt=0.0, le=60.0)
    """How long an answer may take, in real time."""

    @model_validator(mode="after")
    def _of_its_own(self) -> Self:
        channels = [output.channel for output in self.outputs.values()]
        if len(set(channels)) < len(channels):
            raise ValueError(Message("outputs: both shakers have channel {channel}", channel=channels[0]))
        if self.arm_m is not None:
            raise ValueError(Message("a generator turns no centrifuge: leave arm_m out"))
        for axis, output in self.outputs.items():
            most_v_pp = 2.0 * output.peak_v(self.level_limit_g)
            if not LEAST_V_PP < most_v_pp <= MOST_V_PP:
                raise ValueError(
                    Message(
                        "outputs: {axis}: {level:g} g need {most:.3g} V peak to peak, and the generator has up to "
                        "{limit:g} V; correct g_per_v or level_limit_g",
                        axis=axis,
                        level=self.level_limit_g,
                        most=most_v_pp,
                        limit=MOST_V_PP,
                    )
                )
        return self

    def output_of(self, shaker: str) -> OutputTable | None:
        """The output of a shaker by its name in an excitation; None where there is none."""
        if shaker == SINGLE:
            return next(iter(self.outputs.values())) if len(self.outputs) == 1 else self.outputs.get("x")
        return next((output for axis, output in self.outputs.items() if axis == shaker), None)
