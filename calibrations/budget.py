"""Uncertainty by the GUM: what the stand adds to the scatter of the data."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from calibrations.geometry import FloatArray
from calibrations.gravity import Gravity
from calibrations.observations import Observations
from calibrations.repeats import mountings, settings

_ARCSEC_DEG = 1.0 / 3600.0


@dataclass(frozen=True, kw_only=True)
class StandUncertainty:
    """Standard uncertainties (type B) that a stand file states; zero where it states nothing."""

    head_accuracy_arcsec: float = 0.0
    """Reading of the head: one error for every setting, the same whenever it is set."""
    seating_arcsec: float = 0.0
    """Repeatability of the unit in its seat: one error for every mounting."""
    daq_gain: float = 0.0
    """Relative, common to all readings."""
    daq_offset_v: float = 0.0
    """Common to all readings, in volts."""
    gravity: Gravity | None = None
    """Local gravity; it enters the coefficients per m/s² only."""


@dataclass(frozen=True, kw_only=True)
class Source:
    """One independent source of uncertainty, as errors of the rows."""

    name: str
    symbol: str
    """What is uncertain, as a short text with its unit and size."""
    errors_v: FloatArray
    """One column per independent error, shape (rows, errors): what one standard uncertainty of it does to each row."""


def sources(observations: Observations, slope_v_per_deg: FloatArray, stand: StandUncertainty) -> tuple[Source, ...]:
    """Sources of type B with a size above zero.

    `slope_v_per_deg`, shape (rows,), is the change of the output with the head angle.
    """
    settled = settings(np.mod(observations.angle_deg, 360.0))
    listed = (
        Source(
            name="head reading",
            symbol=f"{stand.head_accuracy_arcsec:g}″ at every setting",
            errors_v=_shared(slope_v_per_deg * stand.head_accuracy_arcsec * _ARCSEC_DEG, settled),
        ),
        Source(
            name="seating",
            symbol=f"{stand.seating_arcsec:g}″ at every mounting",
            errors_v=_shared(slope_v_per_deg * stand.seating_arcsec * _ARCSEC_DEG, mountings(observations)),
        ),
        Source(
            name="DAQ gain",
            symbol=f"{stand.daq_gain:g} relative",
            errors_v=(observations.output_v * stand.daq_gain)[:, None],
        ),
        Source(
            name="DAQ offset",
            symbol=f"{stand.daq_offset_v * 1e6:g} µV",
            errors_v=np.full((len(observations), 1), stand.daq_offset_v),
        ),
    )
    return tuple(source for source in listed if np.any(source.errors_v))


def _shared(errors_v: FloatArray, groups: NDArray[np.int64]) -> FloatArray:
    """Errors that the rows of a group share, one column per group."""
    columns = np.zeros((len(errors_v), groups.max(initial=0) + 1))
    columns[np.arange(len(errors_v)), groups] = errors_v
    return columns


def effective_freedom(contributions: list[tuple[float, float]]) -> float:
    """Welch-Satterthwaite degrees of freedom (GUM, G.4.1) of (standard uncertainty, degrees of freedom) pairs."""
    total = sum(u**2 for u, _ in contributions)
    denominator = sum(u**4 / freedom for u, freedom in contributions if freedom > 0 and np.isfinite(freedom))
    return float(total**2 / denominator) if denominator > 0 else float("inf")
