"""Names of mounts as words for the operator, in the language of the window.

The words of the contracts (`face-down`) stay what they are in programmes, tables and documents.
"""

from typing import Final

from tumble.messages import translatable, translate
from tumble.window.look.conditions import ConditionWords
from tumble.window.look.language import spoken, tr

MOUNT_NAMES: Final = {
    "face-up": translatable("face up"),
    "face-up-90": translatable("face up, turned by 90°"),
    "face-down": translatable("face down"),
    "edge": translatable("on edge"),
    "edge-back": translatable("on the other edge"),
    "end": translatable("on end"),
}
"""Every mount of the catalogue."""


def mount_name(mount: str) -> str:
    """A mount as an operator reads it."""
    return translate(MOUNT_NAMES.get(mount, mount), spoken())


class MountWords(ConditionWords):
    """What is said of how the unit sits."""

    def requested(self, condition: str, value: str) -> str:  # noqa: ARG002  # there is one condition
        """That the unit is to be seated."""
        return tr("The unit is to be seated in the mount {mount}.", mount=mount_name(value))

    def confirmed(self, condition: str, value: str) -> str:  # noqa: ARG002
        """That the unit is seated."""
        return tr("The unit sits in the mount {mount}.", mount=mount_name(value))
