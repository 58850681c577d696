"""A closed loop on a triad, as the store takes it."""

from tumble.calibrations.methods.triad.document import document
from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.records.entry import Entry, loop_entry

VERSION = 1


def entry(loop: TriadLoop) -> Entry:
    """A closed loop to be recorded."""
    return loop_entry("triad", VERSION, document(loop))
