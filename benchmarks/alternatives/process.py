"""A Gaussian process without physics: what the declared model leaves, over all that the table has (scikit-learn)."""

import warnings
from collections.abc import Mapping
from typing import Final

import numpy as np
from numpy.typing import NDArray
from sklearn.exceptions import ConvergenceWarning
from sklearn.gaussian_process import GaussianProcessRegressor
from sklearn.gaussian_process.kernels import RBF, ConstantKernel, WhiteKernel

from benchmarks.alternatives.columns import Problem
from benchmarks.blind.right import COARSE
from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.observations import Observations

_LENGTHS: Final = (0.05, 1e3)
"""Bounds of a length, in standard deviations of its input; of one at the upper bound the input does not matter."""

_MOST: Final = 400
"""Of so many rows, at even distances, is the likelihood: that of 1,230 takes half a minute on one core."""


class Process:
    """A smooth function of all inputs with a length for each, and white noise; hyperparameters by likelihood.

    They are fitted once, also to rows that are held out afterwards, which can only help it.
    """

    def __init__(self, problem: Problem) -> None:
        self._problem, inputs = problem, inputs_of(problem.observations)
        self._names = [name for name, columns in inputs.items() for _ in columns.T]
        self._inputs = np.column_stack([_standard(columns) for columns in inputs.values()])
        self._scale = float(np.std(problem.residual)) or 1.0
        kernel = ConstantKernel(1.0, (1e-4, 1e4)) * RBF(np.ones(len(self._names)), _LENGTHS) + WhiteKernel(0.5)
        count = len(problem.residual)
        some = np.zeros(count, dtype=bool)
        some[np.linspace(0, count - 1, min(count, _MOST)).round().astype(int)] = True
        self._kernel = self._fitted(kernel, some).kernel_

    @property
    def variable(self) -> str:
        """The input with the shortest length, as `depends_on` of a result calls it; empty where all is white."""
        lengths = np.atleast_1d(self._kernel.k1.k2.length_scale)
        shortest = int(np.argmin(lengths))
        noise, signal = self._kernel.k2.noise_level, self._kernel.k1.k1.constant_value
        if lengths[shortest] > 0.9 * _LENGTHS[1] or signal < 1e-2 * noise:
            return ""
        return COARSE.get(self._names[shortest], self._names[shortest])

    def errors(self, out: NDArray[np.bool_]) -> FloatArray:
        """Weighted output of rows that are held out less what the others predict, the declared fit made among them."""
        nothing = np.empty(0, dtype=np.intp)
        alone = self._problem.errors(out, nothing)
        process = self._fitted(self._kernel, ~out, optimizer=None)
        return np.asarray(alone - self._scale * process.predict(self._inputs[out]))

    def _fitted(
        self, kernel: object, rows: NDArray[np.bool_], optimizer: str | None = "fmin_l_bfgs_b"
    ) -> GaussianProcessRegressor:
        process = GaussianProcessRegressor(kernel, optimizer=optimizer, alpha=1e-8)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)
            return process.fit(self._inputs[rows], self._problem.residual[rows] / self._scale)


def inputs_of(observations: Observations) -> Mapping[str, FloatArray]:
    """All that the table says of its rows, by the variable it is: columns of shape (rows, n)."""
    turn = np.deg2rad(observations.angle_deg)
    mounts = np.unique(observations.mounts, return_inverse=True)[1]
    order = np.arange(len(observations), dtype=float)
    told: dict[str, FloatArray] = {
        "angle": np.column_stack([np.cos(turn), np.sin(turn)]),
        "unwrapped_angle": observations.angle_deg[:, None],
        "acceleration": (mounts[:, None] == np.arange(mounts.max() + 1)).astype(float),
        "order": order[:, None],
    }
    for name, values in (
        ("time", observations.time_s),
        ("temperature", observations.temperature_degc),
        ("direction", observations.direction),
        ("realisation", observations.realisation),
    ):
        if values is not None and np.all(np.isfinite(np.asarray(values, dtype=float))):
            told[name] = np.asarray(values, dtype=float)[:, None]
    return {name: columns for name, columns in told.items() if np.ptp(columns, axis=0).any()}


def _standard(columns: FloatArray) -> FloatArray:
    spread = np.std(columns, axis=0)
    return np.asarray((columns - np.mean(columns, axis=0)) / np.where(spread > 0.0, spread, 1.0))
