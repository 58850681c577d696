"""Standard deviation of the vector fit over its Cramér-Rao bound, and coverage, on simulated passes.

`python -m benchmarks.triad.bounds --runs 2000`; weights are known from the scatter of the samples.
"""

import click
import numpy as np

from benchmarks.triad.world import Array, make
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.methods.triad.geometry import directions
from tumble.calibrations.methods.triad.model import INTERNAL, NAMES, Triad, functions, stated, stated_slopes
from tumble.calibrations.methods.triad.programmes import POSITIONS

NOISE_V = (1.6e-5, 1e-5, 2.5e-5)
_SEED = 9_000_000


@click.command()
@click.option("--runs", default=2_000)
@click.option("--programme", "programmes", multiple=True, default=("24", "18", "12", "8o", "16o"))
def main(runs: int, programmes: tuple[str, ...]) -> None:
    """Say the ratio, parameter by parameter, and how often the intervals hold."""
    for programme in programmes:
        errors, ratio, inside = _of(programme, runs)
        spread = f"{errors.std(axis=0).mean():.4f} on average, {ratio.min():.3f} to {ratio.max():.3f}"
        print(f"{programme}: sd / bound {spread}; coverage {inside:.2%} of {runs * INTERNAL}")


def _of(programme: str, runs: int) -> tuple[Array, Array, float]:
    """Errors in units of the bound, shape (runs, 14); their standard deviations; part inside the 95% intervals."""
    errors, inside = [], 0
    for number in range(runs):
        made = make(np.random.default_rng([_SEED, number]), POSITIONS[programme], 1, NOISE_V)
        columns = made.columns
        shown = functions(directions(columns["outer_deg"], columns["inner_deg"]))
        model = Triad(functions=shown)
        dwells = len(columns["outer_deg"])
        weights = np.repeat(1.0 / made.noise_v**2, dwells)
        output_v = np.concatenate([columns[f"u_{c}_V"] for c in "xyz"])
        theta = model.fitted(compress(shown, output_v, weights))
        jacobian = (shown @ model.slopes(theta)) * np.sqrt(weights)[:, None]
        slopes = stated_slopes(theta)
        bound = np.sqrt(np.diag(slopes @ np.linalg.inv(jacobian.T @ jacobian) @ slopes.T))
        truth = np.array([made.triad.stated[name] for name in NAMES])
        error = (stated(theta) - truth) / bound
        freedom = 3 * dwells - INTERNAL
        scale = np.sqrt(np.sum(weights * (output_v - shown @ model.coefficients(theta)) ** 2) / freedom)
        inside += int(np.sum(np.abs(error) <= coverage_factor(freedom) * scale))
        errors.append(error)
    whole = np.array(errors)
    return whole, whole.std(axis=0), inside / whole.size


if __name__ == "__main__":
    main()
