"""What no fit of a dwell mends: a channel that is clipped or stuck, another drive, or one locked to the clock."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.dwells.samples import REST, Samples
from tumble.calibrations.methods.vibration.dwells.sine import DwellFit
from tumble.messages import Message

_ORDERS: Final = (1, 2, 3, 4)
"""Powers of the acceleration whose mean must not be falsified."""
_APART: Final = 1.0
"""Lines of the spectrum: nearer to zero than this an alias is no wave but an offset."""
_WINDOWS_RAD: Final = (0.06, 0.12, 0.25, 0.5)
"""About a peak; in one of them a clipped wave is flat."""
_FLAT: Final = 0.5
"""Of the curvature of a sine; less is a flat top."""
_SURE: Final = 6.0
"""Standard deviations by which a top must be flatter."""
_FEWEST: Final = 12
"""Phases in a window."""
_LINES: Final = 2.0
"""Lines of the spectrum; a sine that is nearer to the nominal one is that."""
_UNEXPLAINED: Final = 0.5
"""Of the variance of a channel; a fit that leaves more of it is of another sine."""
_ANOTHER_UNIT: Final = 30.0
"""In no resonance or roll-off that a unit is calibrated in its output vibrates so many times as much, or less."""
_EQUAL: Final = 5
"""So many samples that are the extreme value exactly, of a wave that is nowhere else so often the same, are a limit."""


def refused(time_s: FloatArray, fit: DwellFit, channels: dict[str, FloatArray]) -> str:
    """Why a vibrated dwell gives no mean; empty where it does. `channels` by the names of their columns."""
    if reason := few_phases(time_s, fit.frequency_hz):
        return reason
    clipped = [name for name, values in channels.items() if _is_clipped(time_s, fit.frequency_hz, values)]
    if not clipped:
        return ""
    return Message(
        "clipping: the wave of {channel} is cut at its peak, and its mean with it; lower the level or widen the range",
        channel=clipped[0],
    )


def constant(output_g: FloatArray, references_g: Sequence[FloatArray]) -> str:
    """That an output, or every reference, never changes in a dwell; empty where they do."""
    still = [name for name, channels in (("output_g", [output_g]), ("reference_i_g", references_g)) if channels and
             not any(np.ptp(each) for each in channels)]  # fmt: skip
    if not still:
        return ""
    return Message(
        "{channel} never changes: it is stuck, or its noise is below its resolution, and its mean is not known",
        channel=still[0],
    )


def wrong_drive(time_s: FloatArray, fit: DwellFit, channels: Sequence[FloatArray], line_hz: float) -> str:
    """That a dwell vibrates at another frequency than its nominal one; empty where it does not.

    `channels` are those of the fit, `line_hz` is the frequency of the strongest sine in them, 0 without one.
    """
    shown, values = fit.channels[-1], channels[-1]
    apart_hz = abs(line_hz - fit.frequency_hz)
    if not line_hz or apart_hz * np.ptp(time_s) < _LINES or np.var(shown.residual) < _UNEXPLAINED * np.var(values):
        return ""
    return Message(
        "drive_Hz is wrong: the vibration is at {line_hz:.4g} Hz, and next to nothing at {frequency_hz:.4g} Hz; "
        "correct it",
        line_hz=line_hz,
        frequency_hz=fit.frequency_hz,
    )


def asked(samples: Samples) -> str:
    """Whether an output is in another unit than the reference; empty where it is not."""
    sizes = [float(np.std(each)) for each in samples.references_g]
    if samples.kind == REST or not sizes or sizes[0] == 0.0 or sizes[0] < max(sizes):
        return ""
    times = float(np.std(samples.output_g)) / sizes[0]
    if 1.0 / _ANOTHER_UNIT < times < _ANOTHER_UNIT:
        return ""
    return Message(
        "output_g vibrates {times:g} times as much as reference_i_g; is it in g, divided by the scale factor?",
        times=float(f"{times:.2g}"),
    )


def few_phases(time_s: FloatArray, frequency_hz: float) -> str:
    """That the samples see too few phases of the drive; empty where they see enough.

    With fs/f = 2 the mean square is falsified, with 3 the mean cube, with 4 that of the fourth power.
    """
    step_s, duration_s = float(np.median(np.diff(time_s))), float(np.ptp(time_s))
    for order in _ORDERS:
        turns = order * frequency_hz * step_s
        if abs(turns - round(turns)) / step_s * duration_s < _APART and round(turns) > 0:
            return Message(
                "too few phases: {ratio:.4g} samples a period, locked to the clock, falsify the mean of the power "
                "{order}; take a drive frequency that shares no short period with the sampling rate",
                ratio=1.0 / (frequency_hz * step_s),
                order=order,
            )
    return ""


def _is_clipped(time_s: FloatArray, frequency_hz: float, values: FloatArray) -> bool:
    """Whether the top or the bottom of a wave is cut."""
    if np.ptp(values) == 0.0:
        return False
    return any(_stands_still(side * values) or _is_flat(time_s, frequency_hz, side * values) for side in (1.0, -1.0))


def _stands_still(values: FloatArray) -> bool:
    """Whether the largest value comes far more often than any of those below it."""
    distinct, counts = np.unique(values, return_counts=True)
    return bool(len(distinct) > _FEWEST and counts[-1] > max(_EQUAL, 4 * np.percentile(counts[:-1], 99)))


def _is_flat(time_s: FloatArray, frequency_hz: float, values: FloatArray) -> bool:
    """Whether the curvature about the upper peak is far below that of a sine."""
    phase = 2.0 * np.pi * frequency_hz * (time_s - time_s[0])
    columns = np.column_stack([np.ones(len(phase)), np.cos(phase), np.sin(phase)])
    _, cosine, sine = np.linalg.lstsq(columns, values, rcond=None)[0]
    amplitude, peak_rad = float(np.hypot(cosine, sine)), float(np.arctan2(sine, cosine))
    away = (phase - peak_rad + np.pi) % (2.0 * np.pi) - np.pi
    return any(_flat_within(away, values, amplitude, width) for width in _WINDOWS_RAD)


def _flat_within(away: FloatArray, values: FloatArray, amplitude: float, width_rad: float) -> bool:
    near = np.abs(away) < width_rad
    if len(np.unique(np.round(away[near], 3))) < _FEWEST:
        return False
    columns = np.column_stack([np.ones(np.count_nonzero(near)), away[near], away[near] ** 2 / 2.0])
    coefficients = np.linalg.lstsq(columns, values[near], rcond=None)[0]
    residual = values[near] - columns @ coefficients
    variance = float(residual @ residual) / (len(residual) - 3)
    uncertainty = float(np.sqrt(variance * np.linalg.inv(columns.T @ columns)[2, 2]))
    expected = amplitude * float(np.mean(np.cos(away[near])))
    curvature = -float(coefficients[2])
    return curvature < _FLAT * expected and expected - curvature > _SURE * uncertainty
