"""Runs of simulated units on one stand, for the tests of the stand records."""

from dataclasses import replace
from functools import cache

import numpy as np
from tables import UNIT, output, table

from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.calibrations.methods.dividing_head.loop.loop import explain
from tumble.calibrations.methods.dividing_head.stand.evidence import Run

UP = np.arange(0.0, 360.0, 15.0)
PARTS = tuple(("sweep", mount, angles) for mount in ("face-up", "face-down", "face-up-90") for angles in (UP, UP[::-1]))
ANOTHER = {"u0": 2.45, "kx": 1.02, "ky": -0.006, "kz": 0.004, "kxy": 0.0, "alpha0": -0.2}
STAND = StandUncertainty(head_accuracy_arcsec=5.0, seating_arcsec=1.0)


def eccentric_deg(angle_deg, amplitude_deg=0.05, phase_deg=30.0):
    return amplitude_deg * np.sin(np.deg2rad(angle_deg + phase_deg))


def rows(
    seed=1, unit=UNIT, error_deg=eccentric_deg, backlash_deg=0.0, added_v=lambda volts, mounts: 0.0 * volts, parts=PARTS
):
    """A table whose true angles are the reported ones plus an error, and whose reading adds something to the output."""
    clean = table(*parts, realisations=2, noise_v=0.0, unit=unit)
    direction = np.where(np.diff(clean.angle_deg, prepend=-15.0) < 0, -1, 1)
    true_deg = clean.angle_deg + error_deg(clean.angle_deg) + backlash_deg * (direction < 0)
    volts = np.array([output(mount, [angle], unit)[0] for mount, angle in zip(clean.mounts, true_deg, strict=True)])
    noise_v = np.random.default_rng(seed).normal(0.0, 1e-4, len(volts))
    return replace(clean, direction=direction, voltage_v=volts + added_v(volts, clean.mounts) + noise_v)


def run_on(observations, stand=STAND):
    loop, explained = explain(observations, stand)
    return Run(loop=loop, explained=explained, uncertainty=stand)


@cache
def eccentric_run(seed=1, other=False, amplitude_deg=0.05):
    """A run on a stand whose head is eccentric."""
    return run_on(rows(seed, ANOTHER if other else UNIT, lambda angle: eccentric_deg(angle, amplitude_deg)))
