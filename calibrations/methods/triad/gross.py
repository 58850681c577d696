"""Gross errors of a triad: dwells of which no position near the stated one explains the outputs."""

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.gross import gross_sigmas
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.triad.geometry import directions
from tumble.calibrations.methods.triad.model import INTERNAL, Triad, functions
from tumble.calibrations.methods.triad.observations import CHANNELS, TriadObservations
from tumble.calibrations.methods.triad.weights import channel_weights
from tumble.messages import Message

_HUBER = 1.345
"""Tuning of Huber's weights: 95% efficient on normal noise (Huber and Ronchetti, Robust Statistics, 4.5)."""
_ROUNDS = 40


def gross_errors(observations: TriadObservations) -> tuple[SetAside, ...]:
    """Dwells to set aside, each with the channel that is furthest off.

    Residuals are weighed by channel, so that a channel that scatters more is not taken for one that errs. Where a
    position was visited more than once, a dwell must also differ as much from the median of the other visits: what
    comes back at every visit is no gross error but structure; and where most dwells are far off, as of channels that
    are not connected, none is.
    """
    weighted = _robust_residual(observations)
    spare = weighted.size - INTERNAL
    scale = max(float(1.4826 * np.median(np.abs(weighted)) * np.sqrt(weighted.size / max(spare, 1))), 1e-12)
    limit = gross_sigmas(spare) * scale
    worst = np.abs(weighted).argmax(axis=1)
    far = np.flatnonzero(np.abs(weighted).max(axis=1) > limit).tolist()
    if 2 * len(far) > len(observations):
        return ()
    return tuple(
        SetAside(
            row=int(observations.row[dwell]),
            reason=Message(
                "gross error in channel {channel}: {sigmas:.0f} sigma",
                channel=CHANNELS[worst[dwell]],
                sigmas=abs(weighted[dwell, worst[dwell]]) / scale,
            ),
            gross=True,
        )
        for dwell in far
        if _differs_from_repeats(observations, weighted, dwell, limit)
    )


def _robust_residual(observations: TriadObservations) -> FloatArray:
    """Residuals of Huber's M-estimate, weighed by channel, shape (dwells, 3), in volts."""
    model = Triad(functions=functions(directions(observations.outer_deg, observations.inner_deg)))
    output_v = observations.outputs_v.ravel()
    by_channel = np.tile(channel_weights(observations), len(observations))
    root = np.sqrt(by_channel)
    robust = np.ones(len(output_v))
    residual = output_v
    for _ in range(_ROUNDS):
        theta = model.fitted(compress(model.functions, output_v, by_channel * robust))
        residual = root * (output_v - model.functions @ model.coefficients(theta))
        limit = _HUBER * max(float(1.4826 * np.median(np.abs(residual))), 1e-12)
        previous, robust = robust, np.minimum(1.0, limit / np.maximum(np.abs(residual), limit))
        if np.abs(robust - previous).max(initial=0.0) < 1e-3:
            break
    return np.asarray(residual.reshape(-1, 3))


def _differs_from_repeats(observations: TriadObservations, weighted: FloatArray, dwell: int, limit: float) -> bool:
    positions = observations.positions
    others = np.flatnonzero(positions == positions[dwell])
    others = others[others != dwell]
    if not len(others):
        return True
    return bool(np.abs(weighted[dwell] - np.median(weighted[others], axis=0)).max() > limit)
