"""The declared model in one kind of noise, with any further columns: the fit that every comparison rests on."""

from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed, triangular_factor
from tumble.calibrations.tracing.declared import Declared
from tumble.calibrations.tracing.noise import Whitening


@dataclass(frozen=True, kw_only=True)
class Split:
    """Columns taken apart: what the declared functions can be, and what is left orthogonal to them."""

    projected: FloatArray
    """Shape (functions, n)."""
    orthogonal: FloatArray
    """Shape (turned rows, n)."""

    def pick(self, columns: list[int]) -> "Split":
        """Some of the columns."""
        return Split(projected=self.projected[:, columns], orthogonal=self.orthogonal.T.take(columns, axis=0).T)

    def by_columns(self) -> "Split":
        """The same, each column in one piece of memory, so that some of them are picked fast."""
        return Split(projected=self.projected, orthogonal=np.asfortranarray(self.orthogonal))

    def with_further(self, other: "Split") -> "Split":
        """These columns, then those of another."""
        return Split(
            projected=np.hstack([self.projected, other.projected]),
            orthogonal=np.hstack([self.orthogonal, other.orthogonal]),
        )


@dataclass(frozen=True, kw_only=True)
class Fitted:
    """What a comparison needs of a fit."""

    theta: FloatArray
    """Parameters of the declared model, then coefficients of the further columns."""
    parameters: int
    """How many of them are of the declared model."""
    squares: float
    """Weighted, whitened sum of squared residuals."""

    @property
    def declared(self) -> FloatArray:
        """Parameters of the declared model."""
        return self.theta[: self.parameters]


class WhitenedFit:
    """A table in white noise once its declared functions are taken out.

    Parameters
    ----------
    declared
        The declared model, its functions weighted and turned as in `noise.Memory.turned`.
    output
        The output likewise, shape (turned rows,).
    white
        What makes the noise white.
    rows
        How many rows the table has.
    """

    def __init__(self, declared: Declared, output: FloatArray, white: Whitening, rows: int) -> None:
        self.declared = declared
        self._white = white
        self._size = declared.functions.shape[1]
        padding = max(0, self._size - len(output))
        q, self.r = np.linalg.qr(np.pad(white.turned(declared.functions), ((0, padding), (0, 0))))
        self._q = q[: len(output)]
        self.rows = rows
        self.output = self.split(output[:, None])

    def split(self, columns: FloatArray) -> Split:
        """Make columns white that are weighted and turned, shape (turned rows, n); take out the declared functions."""
        whitened = self._white.turned(columns)
        projected = self._q.T @ whitened
        return Split(projected=projected, orthogonal=whitened - self._q @ projected)

    def compressed(self, further: Split) -> Compressed:
        """The rows as only the declared model and further columns see them; those of the declared come first."""
        size, terms = self._size, further.projected.shape[1]
        triangular = triangular_factor(np.hstack([further.orthogonal, self.output.orthogonal]))
        r, z, rest = triangular[:terms, :terms], triangular[:terms, terms], triangular[terms:, terms]
        whole = np.zeros((size + r.shape[0], size + terms))
        whole[:size, :size] = self.r
        whole[:size, size:] = further.projected
        whole[size:, size:] = r
        return Compressed(
            r=whole,
            z=np.concatenate([self.output.projected[:, 0], z]),
            rotation=np.empty((0, 0)),
            rest_v2=float(rest @ rest),
        )

    def fit(self, further: Split) -> Fitted:
        """Fit with further columns."""
        compressed = self.compressed(further)
        theta = self.declared.fitted(compressed)
        misfit = compressed.z - compressed.r @ self.declared.coefficients(theta)
        squares = compressed.rest_v2 + float(misfit @ misfit)
        return Fitted(theta=theta, parameters=self.declared.parameters, squares=squares)

    def deviance(self, fit: Fitted) -> float:
        """-2 ln L of a fit, up to a constant of the table."""
        return self.rows * float(np.log(max(fit.squares, 1e-300) / self.rows)) + self._white.log_determinant
