"""Names of mounts as words for the operator, in the language of the window.

The words of the contracts (`face-down`) stay what they are in programmes, tables and documents.
"""

from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.window.look.conditions import ConditionWords
from tumble.window.look.language import tr
from tumble.window.look.names import in_words


def mount_name(mount: str) -> str:
    """A mount as an operator reads it; one that nobody declared by its own word."""
    return in_words(mount) if mount in MOUNTS else mount


class MountWords(ConditionWords):
    """What is said of how the unit sits."""

    def requested(self, condition: str, value: str) -> str:  # noqa: ARG002  # there is one condition
        """That the unit is to be seated."""
        return tr("The unit is to be seated in the mount {mount}.", mount=mount_name(value))

    def confirmed(self, condition: str, value: str) -> str:  # noqa: ARG002
        """That the unit is seated."""
        return tr("The unit sits in the mount {mount}.", mount=mount_name(value))
