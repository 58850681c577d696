"""Random vibration by its power spectral density."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.rows import Rows, column
from tumble.calibrations.core.table import read_rows
from tumble.messages import Message

_SHIPPED: Final = Path(__file__).parent / "profiles"
_ALIKE: Final = 1e-9
_LEAST, _MOST = 1e-15, 1e9
"""Between these lie frequencies in Hz and densities in g²/Hz of any vibration."""


@dataclass(frozen=True, kw_only=True)
class ProfileRows(Rows):
    """Break points of a spectrum."""

    settings: ClassVar = ("f_Hz", "G_g2_Hz")

    f_hz: FloatArray = column("f_Hz", needed=True, required=True)
    g_g2_hz: FloatArray = column("G_g2_Hz", needed=True, required=True)


@dataclass(frozen=True, kw_only=True)
class Profile:
    """A one-sided power spectral density, straight between break points in both logarithms (MIL-STD-810H, 514.8)."""

    name: str
    f_hz: FloatArray
    """Ascending, above 0."""
    g_g2_hz: FloatArray
    """In g²/Hz, above 0."""

    @property
    def mean_square_g2(self) -> float:
        """Area, the square of the r.m.s."""
        return self.within(float(self.f_hz[0]), float(self.f_hz[-1]))

    @property
    def rms_g(self) -> float:
        """Root of the area."""
        return float(np.sqrt(self.mean_square_g2))

    def density(self, frequency_hz: FloatArray) -> FloatArray:
        """At frequencies within its ends, in g²/Hz."""
        return np.asarray(np.exp(np.interp(np.log(frequency_hz), np.log(self.f_hz), np.log(self.g_g2_hz))))

    def within(self, low_hz: float, high_hz: float) -> float:
        """Area between two frequencies, exactly, in g²."""
        low_hz, high_hz = max(low_hz, float(self.f_hz[0])), min(high_hz, float(self.f_hz[-1]))
        if not low_hz < high_hz:
            return 0.0
        inside = self.f_hz[(self.f_hz > low_hz) & (self.f_hz < high_hz)]
        points = np.concatenate([[low_hz], inside, [high_hz]])
        density = self.density(points)
        return float(np.sum([_area(*each) for each in zip(points, points[1:], density, density[1:], strict=False)]))


def _area(low_hz: float, high_hz: float, low: float, high: float) -> float:
    """Area under a power law."""
    power = np.log(high / low) / np.log(high_hz / low_hz)
    if abs(power + 1.0) < _ALIKE:
        return float(low * low_hz * np.log(high_hz / low_hz))
    return float((high * high_hz - low * low_hz) / (power + 1.0))


def read_profile(path: Path) -> Profile:
    """Read break points (CSV: f_Hz, G_g2_Hz).

    Raises
    ------
    TableError
        Unreadable or malformed; fewer than two points; frequencies that do not ascend; a value that
        is missing, or that no spectrum has.
    """
    rows = read_rows(path, ProfileRows)
    points = np.column_stack([rows.f_hz, rows.g_g2_hz])
    ascending = len(rows) > 1 and bool(np.all(np.diff(rows.f_hz) > 0))
    if not ascending or not np.all((points >= _LEAST) & (points <= _MOST)):
        raise TableError(
            Message(
                "{path}: the break points of a spectrum are two rows at least, f_Hz ascending and both columns from "
                "{least:g} to {most:g}, none missing",
                path=path,
                least=_LEAST,
                most=_MOST,
            )
        )
    return Profile(name=path.stem, f_hz=rows.f_hz, g_g2_hz=rows.g_g2_hz)


def shipped_profiles() -> list[str]:
    """Names of the profiles that come along."""
    return sorted(path.stem for path in _SHIPPED.glob("*.csv"))


def read_spectrum(spectrum: str) -> Profile:
    """A profile by its name, or read from a file. Raises `TableError`, `ValueError` where there is neither."""
    if spectrum in shipped_profiles():
        return read_profile(_SHIPPED / f"{spectrum}.csv")
    if not Path(spectrum).exists():
        known = ", ".join(shipped_profiles())
        raise ValueError(
            Message("{spectrum}: no such file, nor a profile; known are {known}", spectrum=spectrum, known=known)
        )
    return read_profile(Path(spectrum))
