"""Propagation of distributions (JCGM 101): what errors are drawn, and what is said of the parameters that follow."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final, TypeAlias

import numpy as np

from tumble.calibrations.core.arrays import FloatArray

TRIALS: Final = 20_000
SEED: Final = 20081
_DRAWN_EACH: Final = 1000
"""Up to so many errors are drawn one by one; 20,000 trials of a million would be 160 gigabytes."""
Simulated: TypeAlias = tuple[float, tuple[float, float]]
"""Standard uncertainty and 95% interval of a parameter."""


@dataclass(frozen=True, kw_only=True)
class MonteCarlo:
    """What repeated simulated calibrations of the fitted unit give."""

    trials: int
    standard_uncertainty: FloatArray
    """Root mean square deviation of each parameter from the fitted value, bias included, shape (parameters,)."""
    interval_95: FloatArray
    """Probabilistically symmetric 95% interval (JCGM 101, 7.7), shape (parameters, 2)."""

    def by_name(self, names: Sequence[str], stated: Sequence[str]) -> dict[str, Simulated]:
        """The same by name, of those that are stated."""
        return {
            name: (
                float(self.standard_uncertainty[i]),
                (float(self.interval_95[i, 0]), float(self.interval_95[i, 1])),
            )
            for i, name in enumerate(names)
            if name in stated
        }


def drawn_errors_v(scatter_v: float, degrees_of_freedom: int, errors_v: FloatArray, trials: int) -> FloatArray:
    """Errors of white rows in every trial, shape (trials, rows).

    `scatter_v` is that of a row, with few degrees of freedom a Student distribution (JCGM 101, 6.4.9); `errors_v`,
    shape (rows, n), are the independent errors of type B, one standard uncertainty each. Many errors are drawn as
    their sum is distributed: normal, with their covariance.
    """
    generator = np.random.default_rng(SEED)
    effect = errors_v if errors_v.shape[1] <= _DRAWN_EACH else _root(errors_v @ errors_v.T)
    freedom = max(degrees_of_freedom, 1)
    ruler_v = scatter_v * np.sqrt(freedom / generator.chisquare(freedom, size=(trials, 1)))
    noise = generator.normal(size=(trials, len(errors_v))) * ruler_v
    return np.asarray(noise + generator.normal(size=(trials, effect.shape[1])) @ effect.T)


def summarised(refitted: FloatArray, fitted: FloatArray) -> MonteCarlo:
    """What parameters refitted in each trial, shape (trials, parameters), say of those that were fitted."""
    low, high = np.quantile(refitted, [0.025, 0.975], axis=0)
    return MonteCarlo(
        trials=len(refitted),
        standard_uncertainty=np.sqrt(np.mean((refitted - fitted) ** 2, axis=0)),
        interval_95=np.column_stack([low, high]),
    )


def simulated_json(simulated: Mapping[str, Simulated]) -> dict[str, Any]:
    """The check as a result has it."""
    return {
        name: {"standard_uncertainty": u, "interval_95": list(interval)} for name, (u, interval) in simulated.items()
    }


def _root(covariance: FloatArray) -> FloatArray:
    """Independent columns that give a covariance."""
    values, vectors = np.linalg.eigh(covariance)
    return np.asarray(vectors * np.sqrt(np.maximum(values, 0.0)))
