"""Standard deviation of both fits over their Cramér-Rao bounds, and coverage, on simulated single passes.

`python -m benchmarks.triad.bounds --runs 20000`; weights are known. The vector fit has fourteen parameters. The scalar
fit has nine, from (u - b)ᵀ M⁻¹ (u - b) = 1 of each dwell, with M_ii = norm_i² and M_ij = norm_i norm_j sin of the
orthogonality.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Final

import click
import numpy as np

from benchmarks.triad.world import ARCSEC, Array, Made, make
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.methods.triad.geometry import directions
from tumble.calibrations.methods.triad.model import INTERNAL, NAMES, Triad, functions, stated, stated_slopes
from tumble.calibrations.methods.triad.programmes import POSITIONS
from tumble.calibrations.methods.triad.scalar import NAMES as SCALAR_NAMES
from tumble.calibrations.methods.triad.scalar import fit_scalar

NOISE_V: Final = (1.6e-5, 1e-5, 2.5e-5)
PROGRAMMES: Final = {"vector": ("24", "18", "12", "8o", "16o"), "scalar": ("24", "18", "12", "16o")}
_SEED: Final = 9_000_000
_PAIRS: Final = ((0, 1), (0, 2), (1, 2))


@dataclass(frozen=True)
class Run:
    """A fit of one table, in units of the bound."""

    error: Array
    """Stated less true, shape (parameters,)."""
    half: Array
    """Half of the 95% intervals, shape (parameters,)."""


def vector_run(made: Made) -> Run:
    """The fourteen parameters of a table."""
    columns = made.columns
    shown = functions(directions(columns["outer_deg"], columns["inner_deg"]))
    model = Triad(functions=shown)
    weights = np.tile(made.noise_v**-2.0, len(columns["outer_deg"]))
    output_v = _outputs_v(made).ravel()
    theta = model.fitted(compress(shown, output_v, weights))
    jacobian = (shown @ model.slopes(theta)) * np.sqrt(weights)[:, None]
    slopes = stated_slopes(theta)
    bound = np.sqrt(np.diag(slopes @ np.linalg.inv(jacobian.T @ jacobian) @ slopes.T))
    truth = np.array([made.triad.stated[name] for name in NAMES])
    freedom = len(output_v) - INTERNAL
    scale = np.sqrt(np.sum(weights * (output_v - shown @ model.coefficients(theta)) ** 2) / freedom)
    error = (stated(theta) - truth) / bound
    return Run(error, np.full(INTERNAL, coverage_factor(freedom) * scale))


def scalar_run(made: Made) -> Run:
    """The nine parameters of a table."""
    fit = fit_scalar(_outputs_v(made), made.noise_v**2)
    assert fit is not None, "every programme here tells all nine"
    truth, bound = scalar_truth(made), scalar_bound(made)
    parameters = [fit.parameters[name] for name in SCALAR_NAMES]
    values = np.array([each.value for each in parameters], dtype=float)
    intervals = np.array([each.interval_95 for each in parameters], dtype=float)
    return Run((values - truth) / bound, np.ptp(intervals, axis=1) / 2.0 / bound)


def scalar_truth(made: Made) -> Array:
    """Biases in V, norms in V/g, orthogonalities in arc seconds."""
    response = _response(made)
    norm = np.linalg.norm(response, axis=1)
    sines = [response[i] @ response[j] / (norm[i] * norm[j]) for i, j in _PAIRS]
    return np.concatenate([made.triad.bias_v, norm, np.arcsin(sines) / ARCSEC])


def scalar_bound(made: Made) -> Array:
    """Cramér-Rao bound of the nine, each direction of gravity a nuisance."""
    gram = _response(made) @ _response(made).T
    norm = np.sqrt(np.diag(gram))
    w = np.linalg.solve(gram, (made.clean_v - made.triad.bias_v).T).T
    lengths = [w[:, i] * (w @ gram)[:, i] / norm[i] for i in range(3)]
    angles = [w[:, i] * w[:, j] * np.sqrt((norm[i] * norm[j]) ** 2 - gram[i, j] ** 2) for i, j in _PAIRS]
    white = np.column_stack([w, *lengths, *angles]) / np.linalg.norm(w * made.noise_v, axis=1)[:, None]
    return np.asarray(np.sqrt(np.diag(np.linalg.inv(white.T @ white))) / np.repeat([1.0, ARCSEC], [6, 3]))


def _response(made: Made) -> Array:
    """K, V/g, shape (3, 3)."""
    return np.asarray(made.triad.scale[:, None] * (np.eye(3) + ARCSEC * made.triad.m))


def _outputs_v(made: Made) -> Array:
    """Shape (dwells, 3)."""
    return np.column_stack([made.columns[f"u_{c}_V"] for c in "xyz"])


FITS: Final[Mapping[str, Callable[[Made], Run]]] = {"vector": vector_run, "scalar": scalar_run}


def runs_of(fit: str, programme: str, runs: int) -> tuple[Array, float]:
    """Standard deviation of each parameter over its bound, and the part of all that is inside the 95% intervals."""
    done = [
        FITS[fit](make(np.random.default_rng([_SEED, number]), POSITIONS[programme], 1, NOISE_V))
        for number in range(runs)
    ]
    errors = np.array([each.error for each in done])
    return errors.std(axis=0), float(np.mean(np.abs(errors) <= np.array([each.half for each in done])))


@click.command()
@click.option("--runs", default=2_000)
def main(runs: int) -> None:
    """Say the ratio, parameter by parameter, and how often the intervals hold."""
    for fit, programmes in PROGRAMMES.items():
        for programme in programmes:
            ratio, inside = runs_of(fit, programme, runs)
            spread = f"{ratio.mean():.4f} on average, {ratio.min():.3f} to {ratio.max():.3f}"
            print(f"{fit} {programme}: sd / bound {spread}; inside {inside:.2%} of {runs * len(ratio)}", flush=True)


if __name__ == "__main__":
    main()
