"""Points of a dividing head as rows of its observation table."""

from dataclasses import asdict, dataclass

from tumble.procedures.methods.dividing_head.layout import LAYOUT
from tumble.procedures.steps import Direction, Point


@dataclass(frozen=True, kw_only=True)
class Row:
    """A dwell, reduced: one row of the observation table."""

    index: int
    """Number of the point in the run, from 0."""
    angle_deg: float
    """Head angle as the head reported it, in degrees."""
    voltage_v: float
    """Mean output over the dwell, in volts."""
    voltage_sd_v: float
    """Standard deviation of the single samples (divisor n - 1), in volts."""
    samples: int
    """Number of samples in the mean."""
    time_s: float
    """Middle of the dwell, in seconds since the run began, by the stand's clock."""
    direction: Direction
    """Sign of the last move of the head; 0 before the first."""
    temperature_degc: float | None
    realisation: int
    procedure: str
    mount: str
    settled: bool
    """False where the output was still moving when the time allowed for settling was over."""
    take: int = 1
    """Which taking of the dwell, from 1; more where the operator had it taken again."""

    @property
    def point(self) -> Point:
        """The point of the row."""
        return LAYOUT.point(asdict(self))


def row_of(point: Point) -> Row:
    """The row of a point. Raises `KeyError` where it is of another method."""
    return Row(**LAYOUT.point_fields(point))
