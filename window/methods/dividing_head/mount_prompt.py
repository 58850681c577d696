"""The question for a mount, with a picture of the unit in it."""

from tumble.procedures.layout import Layout
from tumble.procedures.steps import Ask
from tumble.window.look.language import tr
from tumble.window.methods.dividing_head.mounts import mount_name
from tumble.window.methods.dividing_head.pose_picture import PosePicture
from tumble.window.widgets.prompts import ConditionPrompt


class MountPrompt(ConditionPrompt):
    """The mount by name and picture; the head turns once it is confirmed."""

    def __init__(self, layout: Layout) -> None:
        self._picture = PosePicture()
        super().__init__(layout, self._picture)

    def ask(self, ask: Ask) -> None:
        """Ask for a mount."""
        super().ask(ask)
        self._picture.show_mount(ask.value)

    def title(self, ask: Ask) -> str:
        """The mount."""
        return mount_name(ask.value)

    def task(self, ask: Ask) -> str:  # noqa: ARG002  # the same for every mount
        """What there is to do."""
        return tr("Seat the unit as in the picture,\nat head angle 0°.")

    def button_text(self) -> str:
        """What the button says."""
        return tr("It sits there")
