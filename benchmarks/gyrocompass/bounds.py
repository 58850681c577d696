"""The estimator against its bound, and coverage of its intervals, in white and in autocorrelated noise.

`python -m benchmarks.gyrocompass.bounds --runs 20000`. Each run is estimated from nothing: the circle of headings is
searched whole. Rates are made by rotation matrices, on a base that leans, see `world`; the noise of the drift is known,
as declared by N, B, K or a Gauss-Markov process.
"""

from collections.abc import Mapping
from typing import Final

import click
import numpy as np

from benchmarks.gyrocompass.world import U_DEG_H, Array, Design, Platform, axis, dwells_of
from tumble.calibrations.methods.gyrocompass.expected import DriftNoise
from tumble.calibrations.methods.gyrocompass.heading import estimated
from tumble.calibrations.methods.gyrocompass.lean import Lean

NOISES: Final[Mapping[str, DriftNoise]] = {
    "white": DriftNoise(angle_random_walk_deg_sqrt_h=0.01),
    "Gauss-Markov": DriftNoise(gauss_markov_deg_h=0.2, correlation_s=1000.0),
    "flicker and white": DriftNoise(angle_random_walk_deg_sqrt_h=0.005, bias_instability_deg_h=0.05),
    "rate random walk": DriftNoise(angle_random_walk_deg_sqrt_h=0.005, rate_random_walk_deg_h_sqrt_h=0.1),
}
ORDERS: Final = {
    "0/90/180": (0.0, 90.0, 180.0),
    "0/180/90/270": (0.0, 180.0, 90.0, 270.0),
}
DWELL_S, TURN_S = 10.0, 10.0
_K95 = 1.959964


@click.command()
@click.option("--runs", default=20_000)
@click.option("--seed", default=9_000_000)
def main(runs: int, seed: int) -> None:
    """Print r.m.s. error over bound, and coverage of 95% intervals."""
    for order, angles in ORDERS.items():
        for name, noise in NOISES.items():
            ratio, covered = measured(angles * 4, noise, runs, np.random.default_rng(seed))
            print(
                f"4 x {order}, {name}: heading {ratio[0]:.3f} of the bound, covered {100 * covered[0]:.2f} %; "
                f"drift {ratio[1]:.3f}, covered {100 * covered[1]:.2f} %"
            )


def measured(
    angles_deg: tuple[float, ...], noise: DriftNoise, runs: int, rng: np.random.Generator
) -> tuple[Array, Array]:
    """R.m.s. error over the bound and coverage, of heading and drift; the heading is anywhere in each run."""
    count = len(angles_deg)
    starts: Array = (DWELL_S + TURN_S) * np.arange(count, dtype=float)
    covariance = noise.covariance(starts, starts + DWELL_S)
    values, vectors = np.linalg.eigh(covariance)
    errors = rng.normal(size=(runs, count)) @ (vectors * np.sqrt(np.maximum(values, 0.0))).T
    off, bound = np.zeros((runs, 2)), np.zeros((runs, 2))
    headings = rng.uniform(-180.0, 180.0, 40)
    for part, alpha0_deg in zip(np.array_split(np.arange(runs), len(headings)), headings.tolist(), strict=True):
        platform = Platform(alpha0_deg=alpha0_deg, drift_deg_h=5.0, latitude_deg=50.45, leans_deg=((2.0, -3.0),))
        clean, lean = _rates(angles_deg, platform)
        found = estimated(
            clean + errors[part], np.deg2rad(np.array(angles_deg)), np.full(count, 50.45), lean, covariance
        )
        wrong = (found.alpha0_deg - alpha0_deg + 180.0) % 360.0 - 180.0
        off[part] = np.column_stack([wrong, found.drift_deg_h - 5.0])
        bound[part] = found.standard_uncertainties
    return np.sqrt(np.mean((off / bound) ** 2, axis=0)), np.mean(np.abs(off) < _K95 * bound, axis=0)


def _rates(angles_deg: tuple[float, ...], platform: Platform) -> tuple[Array, Lean]:
    """Rates without noise, and the lean as tilts without noise tell it."""
    design = Design(angles_deg=(*angles_deg, 0.0, 90.0), passes=1, there_and_back=False)
    dwells = dwells_of(np.random.default_rng(0), design, 0.0)
    along = axis(dwells, platform)
    clean = U_DEG_H * np.cos(np.deg2rad(platform.latitude_deg)) * along[:, 1] + platform.drift_deg_h
    count = len(angles_deg)
    return clean[:count], Lean(cosine=np.full(count, -along[-2, 2]), sine=np.full(count, -along[-1, 2]))


if __name__ == "__main__":
    main()
