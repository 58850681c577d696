"""The question for a mount, with a picture of the unit in it."""

from typing import Final

from tumble.drivers.manual import on_the_circle
from tumble.drivers.protocols import PositionerStatus
from tumble.procedures.layout import Layout
from tumble.procedures.steps import Ask
from tumble.window.look.language import tr
from tumble.window.look.numbers import local
from tumble.window.methods.dividing_head.mounts import mount_name
from tumble.window.methods.dividing_head.pose_picture import PosePicture
from tumble.window.widgets.prompts import ConditionPrompt

_ZERO_DEG: Final = 0.01
"""As near as a person can seat a unit to 0°."""


class MountPrompt(ConditionPrompt):
    """The mount by name and picture; the head turns once it is confirmed."""

    def __init__(self, layout: Layout) -> None:
        self._picture = PosePicture()
        self._status: PositionerStatus | None = None
        super().__init__(layout, self._picture)

    def ask(self, ask: Ask) -> None:
        """Ask for a mount."""
        super().ask(ask)
        self._picture.show_mount(ask.value)

    def see(self, name: str, status: PositionerStatus) -> None:  # noqa: ARG002  # there is one head
        """Say where the head stands, and who turns it."""
        self._status = status
        self._task.setText(self._instruction())

    def title(self, ask: Ask) -> str:
        """The mount."""
        return mount_name(ask.value)

    def task(self, ask: Ask) -> str:  # noqa: ARG002  # the same for every mount
        """What there is to do."""
        return self._instruction()

    def _instruction(self) -> str:
        status = self._status
        if status is None or not status.referenced or _at_zero(status.angle_deg):
            return tr("Seat the unit as in the picture,\nat head angle 0°.")
        here = local(on_the_circle(status.angle_deg))
        if status.by_hand:
            return tr(
                "The head is at {here}: turn it to 0° yourself,\nthen seat the unit as in the picture.", here=here
            )
        return tr(
            "The head stands at {here}, and turns by itself once you confirm:\n"
            "seat the unit to the 0° mark of the faceplate as in the picture.",
            here=here,
        )

    def button_text(self) -> str:
        """What the button says."""
        return tr("It sits there")


def _at_zero(angle_deg: float) -> bool:
    """Whether an angle is that of the picture, after any number of turns."""
    return abs((angle_deg + 180.0) % 360.0 - 180.0) <= _ZERO_DEG
