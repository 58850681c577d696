"""The error of a dividing head: true angle = reported angle + error."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A head map drawn over one turn, after moves in one direction."""

    angle_deg: FloatArray
    """As reported."""
    error_deg: FloatArray
    """True minus reported."""
    standard_uncertainty_deg: FloatArray


@dataclass(frozen=True, kw_only=True)
class HeadMap:
    """Error of a head as harmonics of the reported angle, and backlash after moves in - direction.

    error = Σ s_n sin(n φ) + c_n cos(n φ), plus b where the last move went in - direction. Its mean over a turn is no
    part of it: that is the zero of the head, and alpha0's.
    """

    orders: tuple[int, ...]
    """Periods a turn, each once."""
    coefficients_deg: FloatArray
    """Sine and cosine of each order in turn, then the backlash, shape (2 orders + 1,)."""
    covariance_deg2: FloatArray
    """Shape (2 orders + 1, 2 orders + 1); zero where there is no backlash."""

    @property
    def backlash_deg(self) -> float:
        """Error after a move in - direction beside that after one in + direction."""
        return float(self.coefficients_deg[-1])

    @property
    def rms_deg(self) -> float:
        """Root mean square over a turn, without backlash."""
        return float(np.sqrt(self.coefficients_deg[:-1] @ self.coefficients_deg[:-1] / 2.0))

    def error_deg(self, angle_deg: FloatArray, direction: NDArray[np.int64] | int = 1) -> FloatArray:
        """True minus reported angle, shape (rows,).

        Parameters
        ----------
        angle_deg
            Reported angles, any revolution, shape (rows,).
        direction
            Sign of the last move; 0, where it is unknown, counts as +.
        """
        return np.asarray(self._columns(angle_deg, direction) @ self.coefficients_deg)

    def standard_uncertainty_deg(self, angle_deg: FloatArray, direction: NDArray[np.int64] | int = 1) -> FloatArray:
        """Standard uncertainty of `error_deg`, shape (rows,)."""
        columns = self._columns(angle_deg, direction)
        return np.asarray(np.sqrt(np.einsum("ri,ij,rj->r", columns, self.covariance_deg2, columns)))

    def curve(self, direction: int = 1, step_deg: float = 1.0) -> Curve:
        """The map over one turn, for a plot."""
        angle_deg = np.arange(0.0, 360.0 + step_deg / 2, step_deg)
        return Curve(
            angle_deg=angle_deg,
            error_deg=self.error_deg(angle_deg, direction),
            standard_uncertainty_deg=self.standard_uncertainty_deg(angle_deg, direction),
        )

    def _columns(self, angle_deg: FloatArray, direction: NDArray[np.int64] | int) -> FloatArray:
        back = np.broadcast_to(np.asarray(direction) < 0, np.shape(angle_deg)).astype(float)
        return np.column_stack([harmonics(angle_deg, self.orders), back])

    def as_json(self) -> dict[str, Any]:
        """The map as plain data; the inverse of `head_map_from_json`."""
        return {
            "orders": list(self.orders),
            "coefficients_deg": self.coefficients_deg.tolist(),
            "covariance_deg2": self.covariance_deg2.tolist(),
        }


def head_map_from_json(content: Mapping[str, Any]) -> HeadMap:
    """Undo `HeadMap.as_json`."""
    return HeadMap(
        orders=tuple(content["orders"]),
        coefficients_deg=np.array(content["coefficients_deg"], dtype=float),
        covariance_deg2=np.array(content["covariance_deg2"], dtype=float),
    )


def harmonics(angle_deg: FloatArray, orders: Sequence[int]) -> FloatArray:
    """Sine and cosine of each order in turn, shape (rows, 2 orders)."""
    phase = np.deg2rad(np.multiply.outer(np.asarray(angle_deg, dtype=float), np.array(orders, dtype=float)))
    return np.asarray(np.stack([np.sin(phase), np.cos(phase)], axis=-1).reshape(len(phase), -1))
