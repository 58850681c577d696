"""What is told of the stand while it is at work."""

from PySide6.QtCore import QObject, Signal


class StandSignals(QObject):
    """The signals of whoever works at the stand, emitted in the event loop."""

    chosen = Signal(object)
    """`LoadedStand`, in place of the one before."""
    connected = Signal(object)
    """`StandIdentity`."""
    disconnected = Signal()
    position_seen = Signal(str, object)
    """Name and `PositionerStatus` of a positioner that nobody moves."""
    reading_seen = Signal(str, object)
    """Name and samples of a sampler or an environment, or None where it has none, while somebody watches."""
    working = Signal(bool)
    """Whether an order is under way; leaving a stand is none."""
    stage = Signal(str)
    """What an activity does before its run."""
    recorded = Signal(object)
    """Path of the recording of a run that is over, however it ended."""
    measured = Signal(object)
    """`Conclusion`: an activity needs the stand no longer."""
    broken_off = Signal(object)
    """The exception that ended an activity."""
    stopping = Signal()
    """Everything is told to stop."""
    failed = Signal(object)
    """The exception that ended any other order."""
    restless = Signal()
    """The standstill of the head could not be read back."""
    rested = Signal()
    """The stand was left with its head at rest, as `retire` demanded."""
    stuck = Signal(object)
    """The exception for which it was not."""
