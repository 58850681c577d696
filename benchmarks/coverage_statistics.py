"""How good the estimates and their intervals are: many simulated runs of a programme against theory.

    python benchmarks/coverage_statistics.py [--programme reversal] [--runs 20000] [--noise 2e-5 1e-4 1e-3] [--jobs 2]

For every parameter: standard deviation over the runs divided by the Cramér-Rao bound, and how many of the stated 95%
intervals hold the true value; beside it the published equations. The noise-free output comes from the simulated world,
which shares no code with the analysis; white noise of known size is added to each dwell. The seed is fixed; development
used others.
"""

import argparse
from concurrent.futures import ProcessPoolExecutor
from itertools import repeat

import numpy as np

from tumble.app.running import Job
from tumble.app.stand import load_stand
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.model import PARAMETERS, basis, coefficients_jacobian
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.drivers.simulated import Simulated, noise_free_voltage
from tumble.procedures.programmes import load_programme
from tumble.procedures.steps import Dwell

SEED = 7_301_952
UNIT = {"u0": 2.5, "kx": 1.0, "ky": 0.0098, "kz": 0.002, "kxy": 0.001, "alpha0_deg": 0.1121}
TRUTH = np.array(list(UNIT.values()))


def rows_of(programme):
    """The programme's table without noise."""
    plan = Job(stand=load_stand(), programme=load_programme(programme), serial_number="").plan()
    dwells = [step.step for step in plan.steps if isinstance(step.step, Dwell)]
    angle_deg = np.array([dwell.targets_deg["head"] for dwell in dwells])
    settings = Simulated.model_validate({"preset": "ideal", "parameters": UNIT, "resolution_v": 0.0})
    return Observations(
        row=np.arange(1, len(dwells) + 1),
        angle_deg=angle_deg,
        voltage_v=noise_free_voltage(settings, [dwell.conditions["mount"] for dwell in dwells], angle_deg),
        mount=np.array([dwell.conditions["mount"] for dwell in dwells]),
        realisation=np.array([dwell.realisation for dwell in dwells]),
        procedure=np.array([dwell.procedure for dwell in dwells]),
        direction=np.sign(np.diff(angle_deg, prepend=0.0)).astype(np.int64),
        source=programme,
    )


def simulate(rows, noise_v, runs, seed):
    """Estimates, interval ends and published values of `runs` noisy tables, each of shape (runs, 6)."""
    generator = np.random.default_rng(seed)
    clean = rows.voltage_v
    found = np.full((4, runs, len(PARAMETERS)), np.nan)
    for run in range(runs):
        noisy = Observations(**{**vars(rows), "voltage_v": clean + noise_v * generator.normal(size=len(clean))})
        result = analyse(noisy, trials=0)
        for index, name in enumerate(PARAMETERS):
            parameter, published = result.parameters[name], result.published[name].value
            if parameter.value is not None and not parameter.given:
                found[:3, run, index] = parameter.value, *parameter.interval_95
            found[3, run, index] = np.nan if published is None else published
    return found


def bound(rows, noise_v):
    """Cramér-Rao bound of every parameter."""
    jacobian = basis(rows) @ coefficients_jacobian(TRUTH)
    return noise_v * np.sqrt(np.diag(np.linalg.pinv(jacobian.T @ jacobian, hermitian=True, rcond=1e-14)))


def report(rows, noise_v, found):
    """Print one table."""
    value, low, high, published = found
    print(f"\n{rows.source}: {len(rows)} dwells, noise {noise_v * 1e6:g} µV a dwell, {len(value)} runs, seed {SEED}")
    heads = ("parameter", "bound", "sd / bound", "mean err / sd", "covered", "told", "published rms error / bound")
    print("| " + " | ".join(heads) + " |\n|" + "---|" * len(heads))
    for index, name in enumerate(PARAMETERS):
        told = np.isfinite(value[:, index])
        limit = bound(rows, noise_v)[index]
        spread = value[told, index].std(ddof=1)
        shift = (value[told, index].mean() - TRUTH[index]) / spread
        inside = (low[told, index] <= TRUTH[index]) & (TRUTH[index] <= high[told, index])
        other = np.sqrt(np.nanmean((published[:, index] - TRUTH[index]) ** 2))
        print(
            f"| {name} | {limit:.3g} | {spread / limit:.4f} | {shift:+.4f} | {inside.mean():.2%} "
            f"| {told.mean():.2%} | {other / limit:.4g} |"
        )


def main():
    """Run all noise levels."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--programme", default="reversal")
    parser.add_argument("--runs", type=int, default=20_000)
    parser.add_argument("--noise", type=float, nargs="+", default=[2e-5, 1e-4, 1e-3])
    parser.add_argument("--jobs", type=int, default=2)
    arguments = parser.parse_args()
    rows = rows_of(arguments.programme)
    parts = 8
    with ProcessPoolExecutor(arguments.jobs) as pool:
        for level, noise_v in enumerate(arguments.noise):
            seeds = [[SEED, level, part] for part in range(parts)]
            runs = repeat(-(-arguments.runs // parts))
            found = np.concatenate(list(pool.map(simulate, repeat(rows), repeat(noise_v), runs, seeds)), axis=1)
            report(rows, noise_v, found)


if __name__ == "__main__":
    main()
