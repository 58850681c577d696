"""A closed loop on a gyrocompass, as the store takes it."""

from tumble.calibrations.methods.gyrocompass.document import document
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.records.entry import Entry, loop_entry

VERSION = 1


def entry(loop: GyrocompassLoop) -> Entry:
    """A closed loop to be recorded."""
    return loop_entry("gyrocompass", VERSION, document(loop))
