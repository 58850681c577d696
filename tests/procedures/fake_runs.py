"""Steps for runs at a fake stand, and what is heard of them."""

from tumble.procedures.events import StateChanged
from tumble.procedures.methods.dividing_head.layout import dwell_at, mounting


def dwells(*angles_deg):
    """A procedure that dwells at angles in one mount."""

    def begin():
        yield mounting("face-up")
        for angle_deg in angles_deg:
            yield dwell_at(angle_deg=angle_deg, procedure="sweep", realisation=1, mount="face-up")

    return begin


def states(stand):
    return [event.state for event in stand.sink.of(StateChanged)]


def when(kind, do):
    """A listener that does something at the first event of a kind."""
    events = []

    def listen(event):
        if isinstance(event, kind) and not events:
            events.append(event)
            do()

    return listen
