"""The course of an adopted effect over its variable."""

from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np

from tumble.calibrations.adopted.knots import Knots
from tumble.calibrations.core.arrays import FloatArray

_NOTHING: Final = 1e-9
"""Directions with less than this part of the largest variance are known for certain."""


@dataclass(frozen=True, kw_only=True, eq=False)
class Curve:
    """What an effect of mean size adds to its channel, at every knot, with what is not known of it.

    What the declared model could be as well (a mean, say, which is a bias) is left to it: it stands in `covariance`.
    """

    knots: Knots
    values: FloatArray
    """Shape (knots,), in the unit of the channel."""
    covariance: FloatArray
    """Shape (knots, knots)."""

    def at(self, values: FloatArray) -> FloatArray:
        """The course at values of the variable, shape (rows,)."""
        return np.asarray(self.knots.basis(values) @ self.values)

    def unknown_at(self, values: FloatArray) -> FloatArray:
        """One standard uncertainty of each independent part of it there, shape (rows, parts)."""
        return np.asarray(self.knots.basis(values) @ self.parts)

    @cached_property
    def parts(self) -> FloatArray:
        """The same at the knots: with their transpose they give the covariance."""
        variances, vectors = np.linalg.eigh(self.covariance)
        kept = variances > _NOTHING * max(float(variances[-1]), 0.0)
        return np.asarray(vectors[:, kept] * np.sqrt(variances[kept]))

    @property
    def standard_uncertainty(self) -> FloatArray:
        """At every knot, shape (knots,)."""
        return np.asarray(np.sqrt(np.maximum(np.diag(self.covariance), 0.0)))
