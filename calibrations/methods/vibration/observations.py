"""The table of dwells at rest and under vibration, as it is read: one row a dwell."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import ClassVar, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import BoolArray, FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.core.rows import Kind, Rows, SetAside, column
from tumble.calibrations.core.screening import beyond, with_likely_temperatures, without_missing
from tumble.calibrations.core.table import read_rows
from tumble.messages import Message

SHAKER: Final = "shaker"
DOUBLE_CENTRIFUGE: Final = "double-centrifuge"
MULTI_SHAKER: Final = "multi-shaker"
TILTED_TURNTABLE: Final = "tilted-turntable"
APPARATUS: Final = (SHAKER, DOUBLE_CENTRIFUGE, MULTI_SHAKER, TILTED_TURNTABLE)
AXES: Final = ("i", "o", "p")
_MOST_G: Final = 10_000.0
"""No exciter of a laboratory reaches it."""
"""Input, output and pendulous axis of the unit (IEEE Std 1293-2018)."""


@dataclass(frozen=True, kw_only=True)
class VibrationObservations(Rows):
    """One row a dwell, at rest or under vibration; None where the table does not say.

    Sines are A = a sin(2π f t + phase) with t from the start of the dwell. Mean products over whole periods stand in
    their place where the vibration is no sine, or beside them where samples say more than the fundamental. All g have
    tumble's sign: the projection of gravity.
    """

    settings: ClassVar = ("output_ug",)
    outputs: ClassVar = ("ai_g", "mii_g2")

    apparatus: NDArray[np.str_] | None = column("apparatus", kind=Kind.TEXT, default=SHAKER, choices=APPARATUS)
    mounting: NDArray[np.int64] | None = column("mounting", kind=Kind.WHOLE, default=1)
    """Number of the mounting, the first being 1; each has a rest output of its own."""
    drive_i: FloatArray | None = column("drive_i", unknown=np.nan)
    """Direction of the drive in the unit, a unit vector; zero where there is no single one."""
    drive_o: FloatArray | None = column("drive_o", unknown=np.nan)
    drive_p: FloatArray | None = column("drive_p", unknown=np.nan)
    lateral_i: FloatArray | None = column("lateral_i", unknown=np.nan)
    """Direction of the sideways axis of the shaker table in the unit, a unit vector."""
    lateral_o: FloatArray | None = column("lateral_o", unknown=np.nan)
    lateral_p: FloatArray | None = column("lateral_p", unknown=np.nan)
    gi_g: FloatArray | None = column("gi_g", unknown=np.nan)
    """Static projection of gravity on the input axis, in g."""
    go_g: FloatArray | None = column("go_g", unknown=np.nan)
    gp_g: FloatArray | None = column("gp_g", unknown=np.nan)
    level_g: FloatArray | None = column("level_g", unknown=np.nan)
    """Drive level as commanded: peak of a sine, root mean square of random vibration, in g."""
    ai_g: FloatArray | None = column("ai_g", unknown=np.nan)
    """Peak of the sine along the input axis, in g."""
    ao_g: FloatArray | None = column("ao_g", unknown=np.nan)
    ap_g: FloatArray | None = column("ap_g", unknown=np.nan)
    fi_hz: FloatArray | None = column("fi_Hz", unknown=np.nan)
    fo_hz: FloatArray | None = column("fo_Hz", unknown=np.nan)
    fp_hz: FloatArray | None = column("fp_Hz", unknown=np.nan)
    phase_i_deg: FloatArray | None = column("phase_i_deg", unknown=np.nan)
    phase_o_deg: FloatArray | None = column("phase_o_deg", unknown=np.nan)
    phase_p_deg: FloatArray | None = column("phase_p_deg", unknown=np.nan)
    main_rad_s: FloatArray | None = column("main_rad_s", unknown=np.nan)
    """Rate Ω of the main axis of a double centrifuge, in rad/s."""
    sub_rad_s: FloatArray | None = column("sub_rad_s", unknown=np.nan)
    """Rate ω2 of its second axis relative to the main one, with its sense."""
    dwell_s: FloatArray | None = column("dwell_s", unknown=np.nan)
    temperature_degc: FloatArray | None = column("temperature_degC", unknown=np.nan)
    output_ug: FloatArray = column("output_ug", needed=True, required=True)
    """Mean output over the dwell divided by the scale factor, in µg."""
    output_u_ug: FloatArray | None = column("output_u_ug", unknown=np.nan)
    """Its standard uncertainty."""
    mii_g2: FloatArray | None = column("mii_g2", unknown=np.nan)
    """Whole-period mean of Ai² without its static part, in g²; a variance for random vibration."""
    moo_g2: FloatArray | None = column("moo_g2", unknown=np.nan)
    mpp_g2: FloatArray | None = column("mpp_g2", unknown=np.nan)
    mio_g2: FloatArray | None = column("mio_g2", unknown=np.nan)
    mip_g2: FloatArray | None = column("mip_g2", unknown=np.nan)

    def filled(self, name: str) -> FloatArray:
        """A column of numbers by its field, with 0 where the table does not say."""
        values: FloatArray | None = getattr(self, name)
        return np.zeros(len(self)) if values is None else np.nan_to_num(values, nan=0.0)

    def along(self, prefix: str, suffix: str = "") -> FloatArray:
        """Columns of the three axes side by side, shape (rows, 3), with 0 where the table does not say."""
        return np.column_stack([self.filled(f"{prefix}{axis}{suffix}") for axis in AXES])

    @cached_property
    def stated(self) -> BoolArray:
        """Which rows state mean products; those of the samples go before those of the sines. Shape (rows,)."""
        return np.zeros(len(self), dtype=bool) if self.mii_g2 is None else np.isfinite(self.mii_g2)

    @cached_property
    def random(self) -> BoolArray:
        """Which rows state mean products and no sine, and are no rest, shape (rows,)."""
        products = np.column_stack([self.filled(f"m{axis}{axis}_g2") for axis in AXES])
        return np.asarray(self.stated & products.any(axis=1) & ~self.along("a", "_g").any(axis=1))

    @cached_property
    def vibrated(self) -> BoolArray:
        """Which rows are no rest, shape (rows,)."""
        return np.asarray(self.along("a", "_g").any(axis=1) | self.random)

    @property
    def level(self) -> FloatArray:
        """Drive level of every row, in g; where the table does not say, that of the largest sine, or the r.m.s."""
        if self.level_g is not None and np.isfinite(self.level_g).all():
            return self.level_g
        products = sum(self.filled(f"m{axis}{axis}_g2") for axis in AXES)
        own = np.where(self.random, np.sqrt(np.maximum(products, 0.0)), np.abs(self.along("a", "_g")).max(axis=1))
        said = np.full(len(self), np.nan) if self.level_g is None else self.level_g
        return np.where(np.isfinite(said), said, own)

    @property
    def of_apparatus(self) -> NDArray[np.str_]:
        """Apparatus of every row; a shaker where the table does not say."""
        return np.full(len(self), SHAKER) if self.apparatus is None else self.apparatus

    @cached_property
    def mountings(self) -> NDArray[np.int64]:
        """Number of the mounting of each row, from 0, mountings of each run apart."""
        said = np.ones(len(self), dtype=np.int64) if self.mounting is None else self.mounting
        return labels(self.runs, said)


def read_vibration_table(path: Path) -> VibrationObservations:
    """Read the table of dwells at rest and under vibration.

    Rows without a finite output or time, and rows that state neither a sine nor mean products, are set aside.

    Raises
    ------
    TableError
        Missing, unreadable or malformed file: one sentence with file, line, column and remedy.
    """
    rows = without_missing(read_rows(path, VibrationObservations), ("output_ug",))
    for name in rows.columns():
        if name.endswith(("_g", "_g2")):
            rows = rows.without(_violent(rows, name))
    return with_likely_temperatures(rows.without(_unstated(rows)))


def _violent(rows: VibrationObservations, name: str) -> tuple[SetAside, ...]:
    """Rows that no exciter could have vibrated so."""
    values = getattr(rows, name)
    if values is None:
        return ()
    most = _MOST_G**2 if name.endswith("_g2") else _MOST_G
    return beyond(rows, name, np.abs(values) > most, "any shaker or centrifuge")


def _unstated(rows: VibrationObservations) -> tuple[SetAside, ...]:
    """Rows of which nobody knows how they were vibrated."""
    said = np.zeros(len(rows), dtype=bool)
    for values in (rows.ai_g, rows.mii_g2):
        said |= np.zeros(len(rows), dtype=bool) if values is None else np.isfinite(values)
    return tuple(
        SetAside(row=row, reason=Message("neither ai_g nor mii_g2 is stated")) for row in rows.row[~said].tolist()
    )
