"""The columns of a dwell of an accelerometer that is shaken."""

from typing import Final

from tumble.drivers.excitation import REST, Excitation
from tumble.drivers.mountings import Mounting
from tumble.drivers.tables import EXCITER, MOUNT
from tumble.messages import Message, translatable
from tumble.procedures.layout import ChannelColumns, Column, Condition, Layout
from tumble.procedures.steps import Dwell

OUTPUT: Final = "output_v"
"""Channel of the unit; those of the references are named in the stand file, and stand in the recording's samples."""
_WORDS: Final = Message.named(OUTPUT, "output")
"""What a reader is shown in its place."""
AT_REST: Final = "rest"
VIBRATED: Final = "vibration"
"""What a dwell belongs to."""

LAYOUT: Final = Layout(
    positions={},
    channels={
        OUTPUT: ChannelColumns(
            mean=Column(name="output_v", meaning="plain mean of the output over the dwell, V"),
            sd=Column(name="sd_v", meaning="standard deviation of the single samples, vibration included, V"),
            samples=Column(name="samples", meaning="number of samples in the mean"),
        )
    },
    conditions={
        MOUNT: Condition(
            meaning="how the unit sits: axes of the table, and down, in the unit",
            step="mount",
            task=translatable("mount the unit with {value} (i: input, o: output, p: pendulous axis)"),
            remedy=translatable("mount it"),
            prompt=translatable("Mount the unit with {value}, then answer yes; nothing shakes meanwhile."),
            hint=translatable("Type yes when the unit is mounted so, or no to end the run."),
        ),
        EXCITER: Condition(
            meaning="what the exciter does: rest, sines, a spectral density, or rates of a centrifuge",
            step="excite",
            task=translatable("set the exciter to {value}"),
            remedy=translatable("set it"),
            prompt=translatable("Set the exciter to: {value}; then answer yes."),
            hint=translatable("Type yes when the exciter does so, or no to end the run."),
        ),
    },
)


def dwell_of(mounting: Mounting, excitation: Excitation, realisation: int) -> Dwell:
    """A dwell in a mounting under an excitation."""
    return Dwell(
        targets_deg={},
        channels=(OUTPUT,),
        procedure=AT_REST if excitation == REST else VIBRATED,
        realisation=realisation,
        conditions={MOUNT: mounting.text, EXCITER: excitation.text},
    )
