"""A closed loop on vibrated dwells, as the store takes it."""

from typing import Final

from tumble.calibrations.methods.vibration.document import NAME, document
from tumble.calibrations.methods.vibration.loop import VibrationLoop
from tumble.calibrations.records.entry import Entry, loop_entry

VERSION: Final = 1


def entry(loop: VibrationLoop) -> Entry:
    """A closed loop to be recorded."""
    return loop_entry(NAME, VERSION, document(loop))
