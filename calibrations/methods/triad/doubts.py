"""What a table of a triad is asked about before anything is stated: channels, senses of rotation, units of angles."""

from collections.abc import Sequence
from itertools import permutations, product

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.sentences import series
from tumble.calibrations.methods.triad.model import response
from tumble.calibrations.methods.triad.observations import CHANNELS, TriadObservations
from tumble.calibrations.methods.triad.table import TriadTable
from tumble.messages import Message

_BAD = 0.02
"""Outputs that miss gravity by more than this part of their range do not follow the positions as given."""
_TURN_RAD = 2 * np.pi


def doubts(table: TriadTable, residual_v: FloatArray) -> tuple[str, ...]:
    """Questions that must be answered before any parameter or effect is stated; none of a table in order.

    `residual_v` is what the declared model leaves, shape (dwells, 3).
    """
    observations = table.observations
    ranges_v = np.ptp(observations.outputs_v, axis=0)
    if np.any(ranges_v == 0.0):
        return (_dead([channel for channel, range_v in zip(CHANNELS, ranges_v, strict=True) if range_v == 0.0]),)
    range_v = float(np.ptp(observations.outputs_v))
    if float(np.sqrt(np.mean(residual_v**2))) > _BAD * range_v:
        return (_misfit(observations),)
    matched = _nearest_axes(response(table.scene.theta))
    return (matched,) if matched else ()


def _dead(channels: Sequence[str]) -> str:
    """What is asked of outputs that never change."""
    return Message.counted(
        "the output of channel {channels} is the same in every row, however the unit is turned; is it connected?",
        "the outputs of channels {channels} are the same in every row, however the unit is turned; are they connected?",
        count=len(channels),
        channels=series(channels),
    )


def _misfit(observations: TriadObservations) -> str:
    """What may be wrong where the outputs do not follow gravity at all."""
    largest = max(float(np.abs(angle).max()) for angle in (observations.outer_deg, observations.inner_deg))
    if largest <= _TURN_RAD + 1e-6:
        return Message(
            "the outputs do not follow gravity by these angles, none of which is beyond {largest:.3g}: are they in "
            "radians? Write outer_deg and inner_deg in degrees",
            largest=largest,
        )
    return Message(
        "the outputs do not follow gravity by these angles: are outer_deg and inner_deg in the order of the two axes, "
        "and is the unit seated with z along the inner axis?"
    )


def _nearest_axes(k: FloatArray) -> str:
    """Which axis each channel follows, where that is not its own in its own sense; empty where all is as it should."""
    unit = k / np.linalg.norm(k, axis=1, keepdims=True)
    choices = list(product(permutations(range(3)), product((1.0, -1.0), repeat=3)))
    order, signs = max(
        choices, key=lambda each: sum(s * unit[i, j] for i, (j, s) in enumerate(zip(*each, strict=True)))
    )
    if order == (0, 1, 2) and min(signs) > 0:
        return ""
    follows = ", ".join(
        f"{CHANNELS[i]} → {'-' if s < 0 else '+'}{CHANNELS[j]}"
        for i, (j, s) in enumerate(zip(order, signs, strict=True))
    )
    turned = _handedness(order, signs) < 0
    if turned:
        return Message(
            "channels and axes do not match ({follows}), in a way that no seating of the unit explains: an axis turns "
            "the other way, or a channel is reversed. Correct the sign of that column",
            follows=follows,
        )
    return Message(
        "channels and axes do not match ({follows}): two channels are swapped, or the unit is seated otherwise. Name "
        "the columns by the axes of the case as it is seated",
        follows=follows,
    )


def _handedness(order: tuple[int, ...], signs: tuple[float, ...]) -> float:
    """+1 where channels form a right-handed frame, -1 where not."""
    matrix = np.zeros((3, 3))
    for row, (column, sign) in enumerate(zip(order, signs, strict=True)):
        matrix[row, column] = sign
    return float(np.linalg.det(matrix))
