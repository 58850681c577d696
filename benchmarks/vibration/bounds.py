"""Standard deviation of the coefficients over their Cramér-Rao bound, and coverage, on simulated tables.

`python -m benchmarks.vibration.bounds --runs 20000`; every table states its uncertainties with a scatter of 12%, and is
weighed by what the analysis makes of them. `--dwells 1000` reduces as many simulated dwells of 4 s too.
"""

from dataclasses import replace

import click
import numpy as np

from benchmarks.vibration.__main__ import read
from benchmarks.vibration.designs import DESIGNS, Array
from benchmarks.vibration.world import NOISE_UG, SPREAD, make
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.methods.vibration.dwells.reduction import reduced
from tumble.calibrations.methods.vibration.dwells.samples import SampledDwells, Samples
from tumble.calibrations.methods.vibration.fit import fit_vibration
from tumble.calibrations.methods.vibration.model import COEFFICIENTS
from tumble.calibrations.methods.vibration.table import vibration_table
from tumble.calibrations.methods.vibration.weights import row_weights
from tumble.calibrations.tracing.trace import nothing_found

_SEED = 9_000_000


@click.command()
@click.option("--runs", default=20_000)
@click.option("--dwells", default=0)
def main(runs: int, dwells: int) -> None:
    """Say the ratio and how often the intervals hold, programme by programme, then dwell by dwell."""
    for number, name in enumerate(DESIGNS):
        ratio, inside, told = _of(name, runs, _SEED + number)
        spread = f"{ratio.mean():.4f} on average, {ratio.min():.4f} to {ratio.max():.4f}"
        print(f"{name}: sd / bound {spread}; coverage {inside:.2%} of {runs * told}")
    for kind in ("off nominal", "few periods", "dropouts", "random", "coloured") if dwells else ():
        ratio_, covered = _reduced(kind, dwells)
        print(f"{kind}: sd / stated {ratio_:.3f}; coverage {covered:.2%} of {dwells}")


def _of(name: str, runs: int, seed: int) -> tuple[Array, float, int]:
    """Standard deviations in units of the bound, part inside the 95% intervals, and how many coefficients are told."""
    rows = read(make(seed, name, {}))
    table = vibration_table(rows, rows)
    fit = fit_vibration(table, nothing_found(table))
    sums = [(place,) for place in range(COEFFICIENTS) if fit.told((place,))] + list(fit.sums)
    picked = np.array([[float(place in each) for place in range(COEFFICIENTS)] for each in sums])
    columns = table.declared
    rng, errors, inside = np.random.default_rng(seed), np.empty((runs, len(sums))), 0
    factor = coverage_factor(fit.degrees_of_freedom)
    bound = np.sqrt(np.diag(_covariance(columns, picked, np.ones(len(rows))))) * NOISE_UG
    for run in range(runs):
        noise = rng.normal(0.0, NOISE_UG, len(rows))
        stated = NOISE_UG * np.exp(rng.normal(0.0, SPREAD, len(rows)))
        weights = row_weights(replace(rows, output_u_ug=stated))
        root = np.sqrt(weights)
        inverse = np.linalg.pinv(columns * root[:, None], rcond=1e-9)
        theta = inverse @ (noise * root)
        left = (noise - columns @ theta) * root
        scale = np.sqrt(left @ left / fit.degrees_of_freedom)
        errors[run] = picked @ theta[:COEFFICIENTS]
        own = np.sqrt(np.diag(_covariance(columns, picked, weights))) * scale
        inside += int(np.sum(np.abs(errors[run]) <= factor * own))
    return errors.std(axis=0) / bound, inside / errors.size, len(sums)


def _covariance(columns: Array, picked: Array, weights: Array) -> Array:
    inverse = np.linalg.pinv(columns.T @ (columns * weights[:, None]), rcond=1e-12)
    return np.asarray(picked @ inverse[:COEFFICIENTS, :COEFFICIENTS] @ picked.T)


def _reduced(kind: str, dwells: int) -> tuple[float, float]:
    """Standard deviation of the rectification in stated uncertainties, and how often it is within 1.96 of them."""
    errors = []
    for number in range(dwells):
        sampled, truth_ug = sampled_dwells(kind, np.random.default_rng([_SEED, number]))
        found = reduced(sampled).rectification
        assert found.value_ug is not None and found.standard_uncertainty_ug is not None
        errors.append((found.value_ug - truth_ug) / found.standard_uncertainty_ug)
    whole = np.array(errors)
    return float(whole.std()), float(np.mean(np.abs(whole) < 1.96))


def sampled_dwells(kind: str, rng: np.random.Generator, rate_hz: float = 500.0) -> tuple[SampledDwells, float]:
    """Rest, vibration, rest of 4 s each with the rectification that was put in, in µg."""
    count = int(4.0 * rate_hz)
    time_s = np.arange(count) / rate_hz
    k_ug, noise_g, rest_g = rng.normal(0.0, 40.0), 4e-4, rng.normal(0.0, 1e-3)
    nominal = 0.9 if kind == "few periods" else float(rng.uniform(20.0, 60.0))
    frequency = nominal * (1.0 + rng.uniform(-0.006, 0.006))
    phase = 2.0 * np.pi * frequency * time_s + rng.uniform(0.0, 2.0 * np.pi)
    amplitude_g = rng.uniform(4.0, 9.0)
    moved = amplitude_g * (np.sin(phase) + 0.02 * np.sin(2.0 * phase + 0.7))
    square = amplitude_g**2 * (1.0 + 0.02**2) / 2.0
    if kind == "random":
        moved = np.diff(np.diff(rng.normal(0.0, 1.0, count + 2)))
        square = float(np.mean(moved**2))
    made = []
    for place, motion in enumerate((np.zeros(count), moved, np.zeros(count)), start=1):
        noise = rng.normal(0.0, noise_g, count + 200)
        if kind == "coloured":
            noise = np.convolve(noise, 0.9 ** np.arange(60))
        noise = noise[100 : 100 + count]
        output = rest_g + motion + k_ug * 1e-6 * motion**2 + noise
        kept = rng.random(count) > (0.1 if kind == "dropouts" else -1.0)
        vibrated = place == 2
        made.append(
            Samples(
                dwell=place,
                kind=("random" if kind == "random" else "vibration") if vibrated else "rest",
                drive_hz=nominal if vibrated and kind != "random" else 0.0,
                time_s=(time_s + 6.0 * place)[kept],
                output_g=output[kept],
                references_g=((motion + rng.normal(0.0, 1e-4, count))[kept],),
            )
        )
    return SampledDwells(dwells=tuple(made)), k_ug * square


if __name__ == "__main__":
    main()
