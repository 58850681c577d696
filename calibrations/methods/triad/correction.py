"""What a user of the triad loads: a = C (u - b), with its covariance, as JSON and as constants of a program."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.fit import TriadFit


@dataclass(frozen=True, kw_only=True)
class Correction:
    """From outputs in volts to accelerations along the axes of the case, in units of the local gravity at the stand."""

    matrix_g_per_v: FloatArray
    """C, shape (3, 3)."""
    bias_v: FloatArray
    """b, shape (3,)."""
    covariance: FloatArray
    """Of b, then C by rows, shape (12, 12)."""

    def as_json(self) -> dict[str, Any]:
        """Matrix, bias and covariance."""
        return {
            "matrix_g_per_V": self.matrix_g_per_v.tolist(),
            "bias_V": self.bias_v.tolist(),
            "covariance": self.covariance.tolist(),
            "order": "bias_x, bias_y, bias_z, then the matrix by rows",
        }

    def as_c(self) -> str:
        """Constants in C."""
        rows = ",\n".join("    {" + ", ".join(f"{value:.9e}" for value in row) + "}" for row in self.matrix_g_per_v)
        bias = ", ".join(f"{value:.9e}" for value in self.bias_v)
        return (
            f"static const double triad_bias_V[3] = {{{bias}}};\n"
            f"static const double triad_matrix_g_per_V[3][3] = {{\n{rows}}};\n"
        )

    def as_python(self) -> str:
        """Constants in Python."""
        rows = ",\n".join("    (" + ", ".join(f"{value:.9e}" for value in row) + ")" for row in self.matrix_g_per_v)
        bias = ", ".join(f"{value:.9e}" for value in self.bias_v)
        return f"TRIAD_BIAS_V = ({bias})\nTRIAD_MATRIX_G_PER_V = (\n{rows},\n)\n"


def correction(fit: TriadFit) -> Correction:
    """The correction of a fit; dC = -C dK C."""
    inverse = fit.correction
    slopes = np.zeros((12, 12))
    slopes[:3, :3] = np.eye(3)
    slopes[3:, 3:] = -np.kron(inverse, inverse.T)
    return Correction(
        matrix_g_per_v=inverse,
        bias_v=fit.theta[:3],
        covariance=slopes @ fit.internal_covariance[:12, :12] @ slopes.T,
    )
