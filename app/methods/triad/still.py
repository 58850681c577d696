"""The still recording that runs of a triad hold: a dwell so long that it tells how the noise falls with averaging."""

from typing import Final

from tumble.app.measurement import Measurement
from tumble.app.still import still_dwell
from tumble.calibrations.allan.recording import StillRecording

STILL_S: Final = 600.0
"""A dwell that lasts so long is a still recording."""


def still_of(measurement: Measurement) -> StillRecording | None:
    """The first dwell of the recording whose dwells are longest; None of tables, and where none lasts long enough."""
    recordings = (each.path for each in (measurement, *measurement.others) if each.header is not None)
    found = [still for path in recordings if (still := still_dwell(path)) and still.duration_s >= STILL_S]
    return max(found, key=lambda still: still.duration_s, default=None)
