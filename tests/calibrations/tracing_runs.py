"""Programmes carried out on a unit that is made from the contract's formulas, one run after the other."""

import numpy as np
from tables import UNIT, output

from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.procedures.plan import plan
from tumble.procedures.programmes import load_programme, programme_from_text
from tumble.procedures.steps import Dwell

SWEEP = '[[procedure]]\nkind = "sweep"\nmount = "{}"\nstep_deg = 5.0\npoints = 80\norder = "{}"\n'
FLIPS = '[[procedure]]\nkind = "flip"\naxes = ["x", "y", "z"]\n'


def programme(*parts, realisations=3):
    """A programme of its own."""
    return programme_from_text(f'name = "own"\nrealisations = {realisations}\n' + "\n".join(parts), "own.toml")


def dwells(named):
    """Dwells of a programme, or of one that comes along, each with the time that it takes from the one before."""
    wanted = load_programme(named) if isinstance(named, str) else named
    acquisition = wanted.acquisition(samples=100, rate_hz=100.0)
    waited_s = 0.0
    for planned in plan(wanted, acquisition, speeds_deg_s={"head": 20.0}).steps:
        waited_s += planned.duration_s
        if isinstance(planned.step, Dwell):
            yield planned.step, waited_s
            waited_s = 0.0


def runs(*programmes, noise_v=1e-4, seed=1, error_deg=None, extra_v=None, waits_s=(), warmer_k=()):
    """Run programmes one after the other on the same unit.

    `error_deg` and `extra_v` are functions of the columns (a dict of arrays): an error of the angle and an addition to
    the output. `waits_s` pass before each run, for which the unit is warmer by `warmer_k`.
    """
    rows, realisation = [], 0
    for number, named in enumerate(programmes):
        wait_s = waits_s[number] if waits_s else 0.0
        warmer = warmer_k[number] if warmer_k else 0.0
        for dwell, step_s in dwells(named):
            rows.append((dwell, step_s + wait_s, realisation + dwell.realisation, 23.0 + warmer))
            wait_s = 0.0
        realisation = rows[-1][2]
    return _table(rows, np.random.default_rng(seed), noise_v, error_deg, extra_v)


def _table(rows, generator, noise_v, error_deg, extra_v):
    angle_deg = np.array([dwell.targets_deg["head"] for dwell, *_ in rows])
    columns = {
        "angle_deg": angle_deg,
        "mount": np.array([dwell.conditions["mount"] for dwell, *_ in rows]),
        "procedure": np.array([dwell.procedure for dwell, *_ in rows]),
        "realisation": np.array([realisation for _, _, realisation, _ in rows]),
        "time_s": np.cumsum([step_s for _, step_s, *_ in rows]),
        "temperature_degc": np.array([degc for *_, degc in rows]) + 0.02 * generator.normal(size=len(rows)),
        "direction": np.where(np.diff(angle_deg, prepend=-1.0) < 0, -1, 1),
    }
    true_deg = angle_deg + (error_deg(columns) if error_deg else 0.0)
    volts = noise_v * generator.normal(size=len(rows)) + (extra_v(columns) if extra_v else 0.0)
    for mount in np.unique(columns["mount"]):
        here = columns["mount"] == mount
        volts[here] += output(mount, true_deg[here], UNIT)
    return Observations(row=np.arange(1, len(rows) + 1), source="runs", voltage_v=volts, **columns)
