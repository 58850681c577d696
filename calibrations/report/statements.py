"""What stands below the values of a first page: how they are stated, and to what they relate."""

import re
from collections.abc import Iterator
from typing import Final

from tumble.calibrations.report.document import Front
from tumble.messages import Message

_PER_GRAVITY: Final = re.compile(r"(?<![A-Za-z])[mµ]?g\b")
"""A unit that holds g."""

_EXPANDED: Final = Message(
    "U is the expanded uncertainty for a coverage probability of 95%, k times the standard uncertainty; where both "
    "sides differ, each is stated."
)
_STANDARD: Final = Message(
    "In brackets stands the standard uncertainty, in units of the last digits; no expanded uncertainty is stated."
)
_GRAVITY: Final = Message("g is local gravity.")
_RELATE: Final = Message("The results relate only to the unit named above, as it was when it was measured.")
_CHANGES: Final = Message(
    "Below a value stands its change since the last calibration of the unit by the same method that has a value of the "
    "same definition; its ± is the expanded uncertainty of the difference, both values taken as independent."
)


def states_expanded(front: Front) -> bool:
    """Whether some value has its expanded uncertainty."""
    return any(each.interval_95 is not None for each in front.parameters.values() if each.value is not None)


def statements(front: Front) -> Iterator[Message]:
    """A sentence or two each; only what these values need."""
    shown = [each for each in front.parameters.values() if each.value is not None]
    said = [
        *([_EXPANDED] if states_expanded(front) else []),
        *([_STANDARD] if any(each.interval_95 is None and each.standard_uncertainty for each in shown) else []),
        *([_GRAVITY] if any(_PER_GRAVITY.search(each.unit) for each in shown) else []),
    ]
    if said:
        yield Message.joined(" ", said)
    yield _RELATE
    if front.changes:
        yield _CHANGES
