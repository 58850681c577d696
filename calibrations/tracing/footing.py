"""The declared model in one kind of noise, with any further columns: the fit that every comparison rests on."""

from dataclasses import dataclass

import numpy as np

from calibrations.compression import Compressed
from calibrations.fit import descended, fit_given_alpha0, joint_fit, squares_v2
from calibrations.geometry import FloatArray
from calibrations.model import BASIS_SIZE
from calibrations.tracing.noise import Whitening


@dataclass(frozen=True, kw_only=True)
class Split:
    """Columns taken apart: what the declared functions can be, and what is left beside them."""

    along: FloatArray
    """Shape (10, n)."""
    beside: FloatArray
    """Shape (rows, n)."""

    def pick(self, columns: list[int]) -> "Split":
        """Some of the columns."""
        return Split(along=self.along[:, columns], beside=self.beside[:, columns])


@dataclass(frozen=True, kw_only=True)
class Fitted:
    """What a comparison needs of a fit."""

    theta: FloatArray
    """Parameters of the declared model, then coefficients of the further columns."""
    squares_v2: float
    """Weighted, whitened sum of squared residuals, in square volts."""


class Footing:
    """A table in white noise once its declared functions are taken out.

    Parameters
    ----------
    declared
        The ten functions of the declared model, shape (rows, 10).
    output_v
        Shape (rows,), in volts.
    weights
        Shape (rows,).
    white
        What makes the weighted noise white.
    alpha0_told
        Whether alpha0 is fitted; it is held at 0 otherwise.
    """

    def __init__(
        self, declared: FloatArray, output_v: FloatArray, weights: FloatArray, white: Whitening, alpha0_told: bool
    ) -> None:
        self._root = np.sqrt(weights)[:, None]
        self._white = white
        padding = max(0, BASIS_SIZE - len(output_v))
        q, self.r = np.linalg.qr(np.pad(white(declared * self._root), ((0, padding), (0, 0))))
        self._q = q[: len(output_v)]
        self._rows = len(output_v)
        self._alpha0_told = alpha0_told
        self.output = self.split(output_v[:, None])

    def split(self, columns: FloatArray) -> Split:
        """Weigh and whiten columns, shape (rows, n), and take out the declared functions."""
        whitened = self._white(columns * self._root)
        along = self._q.T @ whitened
        return Split(along=along, beside=whitened - self._q @ along)

    def compressed(self, further: Split) -> Compressed:
        """The rows as only the declared model and further columns see them; the first ten of `z` are the declared."""
        q, r, z = self._beside(further)
        size = BASIS_SIZE + r.shape[0]
        whole = np.zeros((size, BASIS_SIZE + r.shape[1]))
        whole[:BASIS_SIZE, :BASIS_SIZE] = self.r
        whole[:BASIS_SIZE, BASIS_SIZE:] = further.along
        whole[BASIS_SIZE:, BASIS_SIZE:] = r
        rest = self.output.beside[:, 0] - q @ z
        return Compressed(
            r=whole,
            z=np.concatenate([self.output.along[:, 0], z]),
            rotation=np.empty((0, 0)),
            rest_v2=float(rest @ rest),
        )

    def fit(self, further: Split, near: FloatArray | None = None) -> Fitted:
        """Fit with further columns; `near` are parameters of the declared model near the best, None if none are."""
        compressed = self.compressed(further)
        theta = self._theta(compressed, near)
        return Fitted(theta=theta, squares_v2=squares_v2(compressed, theta))

    def _theta(self, compressed: Compressed, near: FloatArray | None) -> FloatArray:
        if not self._alpha0_told:
            return fit_given_alpha0(compressed, 0.0).theta
        if near is None:
            return joint_fit(compressed).theta
        return descended(compressed, np.concatenate([near, np.zeros(compressed.terms)]))

    def deviance(self, fit: Fitted) -> float:
        """-2 ln L of a fit, up to a constant of the table."""
        return self._rows * float(np.log(max(fit.squares_v2, 1e-300) / self._rows)) + self._white.log_determinant

    def _beside(self, further: Split) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Orthonormal directions of further columns, the columns along them, and the output along them."""
        q, r = np.linalg.qr(further.beside)
        return q, r, np.asarray(q.T @ self.output.beside[:, 0])
