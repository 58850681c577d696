"""Tables for the tests of the analysis, made from the contract's formulas and not from the code under test."""

import numpy as np

from tumble.calibrations.methods.dividing_head.observations import Observations

UNIT = {"u0": 2.5, "kx": 1.0, "ky": 0.0098, "kz": 0.002, "kxy": 0.001, "alpha0": 0.1121}


def gravity_on(mount, angle_deg):
    """(ax, ay, az) as the table of mounts prints them."""
    s, c, o = np.sin(np.deg2rad(angle_deg)), np.cos(np.deg2rad(angle_deg)), np.zeros(len(angle_deg))
    return {
        "face-up": (-s, -c, o),
        "face-up-90": (-c, s, o),
        "face-down": (-s, c, o),
        "edge": (-s, o, -c),
        "edge-back": (-s, o, c),
        "end": (o, -s, -c),
    }[mount]


def output(mount, angle_deg, unit=UNIT):
    """Equation (1) at the true angle, angle_deg + alpha0."""
    ax, ay, az = gravity_on(mount, np.asarray(angle_deg, float) + unit["alpha0"])
    return unit["u0"] + unit["kx"] * ax + unit["ky"] * ay + unit["kz"] * az + unit["kxy"] * ax * ay


FLIPS = (
    ("flip", "face-up", [-90.0, 90.0]),
    ("flip", "face-up", [180.0, 0.0]),
    ("flip", "edge", [180.0, 0.0]),
)


def sweep(mount, step_deg=5.0):
    """One sweep over 400 degrees, down where the step is negative."""
    return ("sweep", mount, np.arange(0.0, np.copysign(400.0, step_deg), step_deg))


def table(*parts, realisations=5, noise_v=1e-4, seed=1, unit=UNIT, extra_v=None):
    """Parts, in order, as many times as there are realisations; `extra_v(mount, angle_deg)` is an undeclared effect."""
    generator = np.random.default_rng(seed)
    rows = {"procedure": [], "mount": [], "angle_deg": [], "voltage_v": [], "realisation": []}
    for realisation in range(1, realisations + 1):
        for procedure, mount, angles in parts:
            volts = output(mount, angles, unit) + generator.normal(size=len(angles)) * noise_v
            if extra_v is not None:
                volts = volts + extra_v(mount, np.asarray(angles))
            rows["procedure"] += [procedure] * len(angles)
            rows["mount"] += [mount] * len(angles)
            rows["angle_deg"] += list(angles)
            rows["voltage_v"] += list(volts)
            rows["realisation"] += [realisation] * len(angles)
    columns = {name: np.array(values) for name, values in rows.items()}
    return Observations(row=np.arange(1, len(columns["angle_deg"]) + 1), source="table", **columns)
