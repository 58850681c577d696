"""The question for a mount, with a picture of the unit in it."""

from typing import Final

from tumble.procedures.layout import Layout
from tumble.procedures.steps import Ask
from tumble.window.look.language import tr
from tumble.window.methods.dividing_head.mounts import mount_name
from tumble.window.methods.dividing_head.pose_picture import PosePicture
from tumble.window.widgets.prompts import ConditionPrompt, angle_words

_ZERO_DEG: Final = 0.01
"""As near as a person can seat a unit to 0°."""


class MountPrompt(ConditionPrompt):
    """The mount by name and picture; the head turns once it is confirmed."""

    def __init__(self, layout: Layout) -> None:
        self._picture = PosePicture()
        super().__init__(layout, self._picture)

    def ask(self, ask: Ask) -> None:
        """Ask for a mount."""
        super().ask(ask)
        self._picture.show_mount(ask.value)

    def instruction(self, ask: Ask) -> str:
        """The mount, where the head is, and who turns it."""
        mount = mount_name(ask.value)
        status = next(iter(self.statuses.values()), None)
        if status is None or not status.referenced:
            return tr("Seat the unit {mount}, as in the picture.", mount=mount)
        if _at_zero(status.angle_deg):
            return tr("Seat the unit {mount}, as in the picture. The head is at 0°.", mount=mount)
        here = angle_words(status)
        if status.by_hand:
            return tr(
                "The head is at {here}: turn it to 0° yourself. Then seat the unit {mount}, as in the picture.",
                here=here,
                mount=mount,
            )
        return tr(
            "Seat the unit {mount}, at the 0° mark. The head is at {here} and turns by itself once you confirm.",
            here=here,
            mount=mount,
        )

    def button_text(self) -> str:
        """What the button says."""
        return tr("It sits there")


def _at_zero(angle_deg: float) -> bool:
    """Whether an angle is that of the picture, after any number of turns."""
    return abs((angle_deg + 180.0) % 360.0 - 180.0) <= _ZERO_DEG
