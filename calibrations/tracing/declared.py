"""The declared model as tracing sees it: functions of the rows, and parameters that are fitted before any effect is."""

from dataclasses import dataclass, replace
from typing import Protocol, Self

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import Compressed
from tumble.calibrations.core.solutions import triangular_solution


class Declared(Protocol):
    """A model whose output is a combination of functions, with coefficients that depend on its parameters."""

    @property
    def functions(self) -> FloatArray:
        """Shape (rows, functions)."""
        ...

    @property
    def parameters(self) -> int:
        """How many parameters it has."""
        ...

    def fitted(self, compressed: Compressed) -> FloatArray:
        """Best parameters, then the coefficients of further columns."""
        ...

    def near(self, compressed: Compressed) -> FloatArray:
        """The same with what is nonlinear where effects are seen from."""
        ...

    def coefficients(self, theta: FloatArray) -> FloatArray:
        """Coefficients of the functions and of the further columns."""
        ...

    def slopes(self, theta: FloatArray) -> FloatArray:
        """Derivative of the coefficients of the functions, shape (functions, parameters)."""
        ...

    def with_functions(self, functions: FloatArray) -> Self:
        """The same for other rows, or for rows that are weighted and turned."""
        ...


@dataclass(frozen=True, kw_only=True)
class Linear:
    """A model that is linear in its parameters: each is the coefficient of a function."""

    functions: FloatArray

    @property
    def parameters(self) -> int:
        """One for each function."""
        return int(self.functions.shape[1])

    def fitted(self, compressed: Compressed) -> FloatArray:
        """By linear least squares."""
        return triangular_solution(compressed.r, compressed.z)

    def near(self, compressed: Compressed) -> FloatArray:
        """As fitted: nothing is nonlinear."""
        return self.fitted(compressed)

    def coefficients(self, theta: FloatArray) -> FloatArray:
        """The parameters themselves."""
        return theta

    def slopes(self, theta: FloatArray) -> FloatArray:  # noqa: ARG002
        """One, each of its own."""
        return np.eye(self.parameters)

    def with_functions(self, functions: FloatArray) -> "Linear":
        """The same for other rows, or for rows that are weighted and turned."""
        return replace(self, functions=functions)
