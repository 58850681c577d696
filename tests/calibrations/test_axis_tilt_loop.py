"""A tilt of the head's axis beyond what is linear in it."""

from functools import cache

import numpy as np
import pytest
from tables import FLIPS, UNIT, gravity_on, output, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

TILT_DEG = 1.5
_ALONG_AXIS = {"face-up": (0, 0, 1), "face-down": (0, 0, -1), "edge": (0, -1, 0), "end": (1, 0, 0)}
"""The head's axis in the frame of the unit: third column of each mount."""


def tilted(mount, angle_deg):
    """What a tilt adds to equation (1): gravity keeps cos τ in the plane and has sin τ along the axis."""
    angle_deg = np.asarray(angle_deg, float) + UNIT["alpha0"]
    level, raised = np.cos(np.deg2rad(TILT_DEG)), np.sin(np.deg2rad(TILT_DEG))
    ax, ay, az = (level * p + raised * a for p, a in zip(gravity_on(mount, angle_deg), _ALONG_AXIS[mount], strict=True))
    volts = UNIT["u0"] + UNIT["kx"] * ax + UNIT["ky"] * ay + UNIT["kz"] * az + UNIT["kxy"] * ax * ay
    return volts - output(mount, angle_deg - UNIT["alpha0"])


@cache
def traced():
    return close_loop(table(*FLIPS, *map(sweep, _ALONG_AXIS), realisations=2, noise_v=1e-5, extra_v=tilted))


def test_a_tilt_is_found():
    (effect,) = traced().effects

    assert effect.name == "axis_tilt"
    assert effect.coefficients["axis_tilt"].value == pytest.approx(TILT_DEG, abs=2e-3)


@pytest.mark.parametrize("name", UNIT)
def test_what_gravity_loses_in_the_plane_is_not_taken_from_the_parameters(name):
    low, high = traced().augmented.parameters[name].interval_95

    assert low <= UNIT[name] <= high


def test_that_the_tilt_is_not_known_exactly_is_among_the_sources():
    (line,) = [each for each in traced().augmented.budget if each.name == "tilt of the head's axis"]

    assert line.contributions["kx"] == pytest.approx(
        np.tan(np.deg2rad(TILT_DEG)) * np.deg2rad(traced().effects[0].coefficients["axis_tilt"].standard_uncertainty),
        rel=0.02,
    )
