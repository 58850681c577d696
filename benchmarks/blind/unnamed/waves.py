"""Shapes of which the kinds are made."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike

from benchmarks.blind.geometry import FloatArray


def saw(turns: ArrayLike) -> FloatArray:
    """A saw-tooth of the argument in turns, from -1 up to 1, then back at once."""
    return 2.0 * np.mod(np.asarray(turns, dtype=np.float64), 1.0) - 1.0


def square(turns: ArrayLike) -> FloatArray:
    """1 in the first half of each turn, -1 in the second."""
    return np.where(np.mod(np.asarray(turns, dtype=np.float64), 1.0) < 0.5, 1.0, -1.0)


def sine(turns: ArrayLike) -> FloatArray:
    """A sine of the argument in turns."""
    return np.sin(2.0 * np.pi * np.asarray(turns, dtype=np.float64))


def harmonics(turns: ArrayLike, orders: Sequence[int], rng: np.random.Generator) -> FloatArray:
    """A sum of harmonics with weights and phases drawn."""
    weights, phases = rng.uniform(0.4, 1.0, len(orders)), rng.uniform(0.0, 1.0, len(orders))
    turns = np.asarray(turns, dtype=np.float64)
    parts = [weight * sine(order * turns + phase) for order, weight, phase in zip(orders, weights, phases, strict=True)]
    return np.asarray(np.sum(parts, axis=0))


def bump(values: FloatArray, centre: float, width: float) -> FloatArray:
    """A raised cosine around a centre, 1 there, 0 further out than the width."""
    off = np.clip(np.abs(values - centre) / width, 0.0, 1.0)
    return np.asarray(0.5 * (1.0 + np.cos(np.pi * off)))


def lagged(values: FloatArray, time_s: FloatArray, lag_s: float) -> FloatArray:
    """A first-order lag behind values, from rest at the first."""
    course = np.empty_like(values)
    course[0] = values[0]
    keep = np.exp(-np.diff(time_s) / lag_s)
    for row in range(1, len(values)):
        course[row] = keep[row - 1] * course[row - 1] + (1.0 - keep[row - 1]) * values[row]
    return course
