"""Variables that rows of every method may follow, and the shapes that make sense along each."""

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.coordinate import Coordinate
from tumble.messages import Message


def time_of(hours: FloatArray) -> Coordinate:
    """The time of each row, in hours, shape (rows,)."""
    return Coordinate(
        word="time",
        depends_on="time",
        values=hours,
        shown=shown_in_seconds,
        waves=True,
        overtones=True,
        steps=True,
        kinks=True,
        onsets=True,
        phrase=Message("that follows the time"),
        unit="h",
    )


def pose_of(gravity_g: FloatArray) -> Coordinate:
    """Gravity along the axes of the unit in each row, in g, shape (rows, 3)."""
    return Coordinate(
        word="pose",
        depends_on="acceleration",
        values=gravity_g,
        phrase=Message("that follows the pose of the unit"),
        unit="g",
    )


def temperature_of(degc: FloatArray) -> Coordinate:
    """The temperature of each row, in °C, shape (rows,)."""
    return Coordinate(
        word="temperature",
        depends_on="temperature",
        values=degc,
        shown="{:.1f} °C".format,
        phrase=Message("that follows the temperature"),
        unit="°C",
    )


def shown_in_seconds(hours: float) -> str:
    """A time for a reader."""
    return f"{3600.0 * hours:.0f} s"
