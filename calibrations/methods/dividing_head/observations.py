"""The table that the analysis of an accelerometer reads: one row per dwell, in the order in which they were taken."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.rows import Kind, Rows, column
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Observations(Rows):
    """Dwells as arrays of equal length; None where the table does not say.

    Rows that hold NaN, infinity or an overload are already out and listed in `set_aside`.
    """

    settings: ClassVar = ("angle_deg",)
    outputs: ClassVar = ("voltage_V", "reference_deg")

    procedure: NDArray[np.str_] | None = column("procedure", kind=Kind.TEXT, unknown="")
    mount: NDArray[np.str_] | None = column("mount", kind=Kind.TEXT, default="face-up", choices=tuple(MOUNTS))
    angle_deg: FloatArray = column("angle_deg", needed=True, required=True)
    """Head angle as reported, in degrees; any revolution."""
    direction: NDArray[np.int64] | None = column("direction", kind=Kind.WHOLE, unknown=0, choices=(1, -1, 0))
    """Sign of the last move of the head; 0 where unknown."""
    temperature_degc: FloatArray | None = column("temperature_degC", unknown=np.nan)
    voltage_v: FloatArray | None = column("voltage_V", needed=True)
    """Mean output over the dwell, in volts."""
    voltage_sd_v: FloatArray | None = column("voltage_sd_V", unknown=np.nan)
    """Standard deviation of the single samples within the dwell, in volts."""
    samples: NDArray[np.int64] | None = column("samples", kind=Kind.WHOLE)
    reference_deg: FloatArray | None = column("reference_deg", needed=True)
    """What a reference says of the angle, in degrees; may wrap."""
    velocity_deg_s: FloatArray | None = column("velocity_deg_s", needed=True)
    correction_deg: FloatArray | None = column()
    """What a stand record adds to the reported angle, in degrees."""

    @property
    def output_v(self) -> FloatArray:
        """Output of every row, in volts. Raises `ValueError` where the table holds none."""
        if self.voltage_v is None:
            raise ValueError(
                Message(
                    "{source}: there is no column voltage_V; a calibration needs the unit's output", source=self.source
                )
            )
        return self.voltage_v

    @property
    def true_angle_deg(self) -> FloatArray:
        """Head angle as far as it is known: as reported, and corrected where a stand record says by how much."""
        return self.angle_deg if self.correction_deg is None else self.angle_deg + self.correction_deg

    @property
    def mounts(self) -> NDArray[np.str_]:
        """Mount of every row; face-up where the table does not say."""
        return np.full(len(self), "face-up") if self.mount is None else self.mount
