"""The accelerometer's model as tracing sees it."""

from dataclasses import dataclass, replace

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.methods.dividing_head.best_alpha0 import quick_parameters
from tumble.calibrations.methods.dividing_head.fit import fit_given_alpha0
from tumble.calibrations.methods.dividing_head.model import BASIS_SIZE, PARAMETERS, coefficients, coefficients_jacobian


@dataclass(frozen=True, kw_only=True)
class Accelerometer:
    """The model of `dividing_head.model`: ten functions, six parameters, alpha0 the nonlinear one."""

    functions: FloatArray
    alpha0_fitted: bool
    """Whether alpha0 is fitted; it is held at 0 otherwise."""
    linearised_at_deg: float = 0.0
    """The alpha0 at which effects are linearised: where it rests on a curvature alone, not its best value."""

    @property
    def parameters(self) -> int:
        """u0, kx, ky, kz, kxy, alpha0."""
        return len(PARAMETERS)

    def fitted(self, compressed: Compressed) -> FloatArray:
        """With the best alpha0, or with none where it is not identifiable."""
        return quick_parameters(compressed) if self.alpha0_fitted else fit_given_alpha0(compressed, 0.0).theta

    def near(self, compressed: Compressed) -> FloatArray:
        """With the alpha0 at which effects are linearised."""
        return fit_given_alpha0(compressed, self.linearised_at_deg).theta

    def coefficients(self, theta: FloatArray) -> FloatArray:
        """As in `dividing_head.model`."""
        return coefficients(theta)

    def slopes(self, theta: FloatArray) -> FloatArray:
        """As in `dividing_head.model`."""
        return coefficients_jacobian(theta)[:BASIS_SIZE, : len(PARAMETERS)]

    def with_functions(self, functions: FloatArray) -> "Accelerometer":
        """The same for other rows, or for rows that are weighted and turned."""
        return replace(self, functions=functions)
