"""White noise N, flicker B and random walk K, fitted to the Allan variance (IEEE Std 952, annex C).

σ²(τ) = N²/τ + (2 ln 2 / π) B² + K² τ/3. The logarithms of the estimates are fitted, since at long averaging times an
estimate has a handful of degrees of freedom and most of them are below the mean, by least squares with the covariance
that such noise gives them. What the recording does not tell from nothing is withheld: an upper limit stands for it.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import numpy as np
from scipy.optimize import least_squares
from scipy.special import digamma, polygamma
from scipy.stats import chi2

from tumble.calibrations.allan.deviations import Deviation
from tumble.calibrations.allan.spectrum import Lines, lines
from tumble.calibrations.core.arrays import FloatArray

NAMES: Final = ("N", "B", "K")
FLAT: Final = 2.0 * np.log(2.0) / np.pi
"""σ² of flicker over B²: the floor of the deviation is 0.664 B."""
_CLEAR: Final = 1.96
"""Standard deviations from nothing at which a coefficient is told."""
_ROUNDS: Final = 4
_STEP: Final = 1.2
"""Ratio of the squares that are tried for an upper limit."""


@dataclass(frozen=True, kw_only=True)
class Coefficient:
    """One of N (unit·√s), B (unit) and K (unit/√s)."""

    name: str
    value: float | None
    """None where the recording does not tell it from nothing."""
    standard_uncertainty: float | None
    at_most: float | None
    """Upper limit, 97.5%, of what is withheld."""


@dataclass(frozen=True, kw_only=True)
class NoiseModel:
    """The three coefficients of one output, and how well they describe it."""

    coefficients: tuple[Coefficient, ...]
    squares: FloatArray
    """N², B² and K² that fit best, whether told from nothing or not, shape (3,)."""
    p_value: float
    """Of distances from the model as large as those found."""
    rate_hz: float

    def deviation(self, tau_s: FloatArray) -> FloatArray:
        """The deviation by the model."""
        return np.asarray(
            np.sqrt(np.column_stack([1.0 / tau_s, np.full_like(tau_s, FLAT), tau_s / 3.0]) @ self.squares)
        )

    def power(self, frequency_hz: FloatArray) -> FloatArray:
        """The two-sided spectrum by the model, unit²/Hz."""
        return np.asarray(_spectra(frequency_hz, self.rate_hz) @ self.squares)


@dataclass(frozen=True, kw_only=True)
class _Fit:
    squares: FloatArray
    deviations: FloatArray
    """Standard deviations of the squares."""
    distance: float


@dataclass(frozen=True)
class _Estimates:
    """Estimated variances, and what each coefficient adds to them."""

    variances: FloatArray
    lines: Lines
    rate_hz: float

    @cached_property
    def spectra(self) -> FloatArray:
        return _spectra(self.lines.frequency_hz, self.rate_hz)

    @cached_property
    def shapes(self) -> FloatArray:
        return np.asarray(self.lines.gains_hz @ self.spectra)

    def fitted(self, terms: Sequence[int], start: FloatArray, held: FloatArray) -> _Fit:
        """Fit some of the squares from a start; the others are held."""
        squares = held.copy()
        squares[terms] = np.maximum(start[terms], 1e-12 * start.max())
        shapes = self.shapes[:, terms]
        others = self.shapes @ held - shapes @ held[terms]
        for _ in range(_ROUNDS):
            root, expected = self._scatter(squares)
            found = _closest(root, np.log(self.variances) - expected, shapes, others, squares[terms])
            squares[terms] = found.squares
        deviations = np.zeros(3)
        deviations[terms] = found.deviations
        return _Fit(squares=squares, deviations=deviations, distance=found.distance)

    def _scatter(self, squares: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Root of the covariance of the logarithms, and their means below that of the variance (of χ²)."""
        covariance = self.lines.covariance(self.spectra @ squares)
        deviation = np.sqrt(np.diag(covariance))
        half_freedom = (self.shapes @ squares / deviation) ** 2
        wider = np.sqrt(polygamma(1, half_freedom)) / deviation
        root = np.asarray(np.linalg.cholesky(covariance * np.outer(wider, wider)), dtype=float)
        return root, np.asarray(digamma(half_freedom) - np.log(half_freedom))


def _closest(root: FloatArray, target: FloatArray, shapes: FloatArray, others: FloatArray, start: FloatArray) -> _Fit:
    """The squares with which the logarithm of others + shapes × squares comes closest to the target."""

    def distances(squares: FloatArray) -> FloatArray:
        return np.asarray(np.linalg.solve(root, target - np.log(others + shapes @ squares)))

    def slopes(squares: FloatArray) -> FloatArray:
        return np.asarray(np.linalg.solve(root, -shapes / (others + shapes @ squares)[:, np.newaxis]))

    size = np.exp(target)[:, np.newaxis]
    found = least_squares(distances, start, slopes, bounds=(0.0, np.inf), x_scale=1.0 / np.max(shapes / size, axis=0))
    jacobian = slopes(found.x)
    scale = 1.0 / np.linalg.norm(jacobian, axis=0)
    scaled = jacobian * scale
    deviations = np.sqrt(np.diag(np.linalg.inv(scaled.T @ scaled))) * scale
    return _Fit(squares=found.x, deviations=deviations, distance=2.0 * float(found.cost))


def noise_model(found: Sequence[Deviation], samples: int, rate_hz: float) -> NoiseModel:
    """Fit the coefficients to deviations in the order of their averaging times."""
    tau_s = np.array([each.tau_s for each in found])
    variances = np.array([each.value for each in found]) ** 2
    spectrum = lines(samples, rate_hz, [round(each * rate_hz) for each in tau_s])
    estimates = _Estimates(variances, spectrum, rate_hz)
    start = np.array([variances[0] * tau_s[0], variances.min() / FLAT, 3.0 * variances[-1] / tau_s[-1]])
    fit = estimates.fitted([0, 1, 2], start, np.zeros(3))
    return NoiseModel(
        coefficients=tuple(_coefficient(term, fit, estimates) for term in range(3)),
        squares=fit.squares,
        p_value=float(chi2.sf(fit.distance, len(found) - 3)),
        rate_hz=rate_hz,
    )


def _coefficient(term: int, fit: _Fit, estimates: _Estimates) -> Coefficient:
    """One coefficient, told from nothing where the fit without it is worse."""
    others = [other for other in range(3) if other != term]

    def serves(square: float) -> bool:
        """Whether the coefficient may be as large as that."""
        held = np.where(np.arange(3) == term, square, 0.0)
        return estimates.fitted(others, fit.squares, held).distance - fit.distance <= _CLEAR**2

    if not serves(0.0):
        value = float(np.sqrt(fit.squares[term]))
        deviation = float(fit.deviations[term]) / (2.0 * value)
        return Coefficient(name=NAMES[term], value=value, standard_uncertainty=deviation, at_most=None)
    most = float(fit.squares[term] + _CLEAR * fit.deviations[term])
    while serves(most):
        most *= _STEP
    return Coefficient(name=NAMES[term], value=None, standard_uncertainty=None, at_most=float(np.sqrt(most)))


def _spectra(frequency_hz: FloatArray, rate_hz: float) -> FloatArray:
    """Two-sided spectra of N = 1, B = 1 and K = 1; the walk takes a step a sample."""
    walk = 2.0 * rate_hz * np.sin(np.pi * frequency_hz / rate_hz)
    return np.column_stack([np.ones_like(frequency_hz), 1.0 / (2.0 * np.pi * frequency_hz), 1.0 / walk**2])
