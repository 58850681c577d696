"""Effects that are not linear start from the best of several minima."""

import numpy as np
import pytest
from vibration_tables import FIXTURES, HALF, dwells, measured

from tumble.calibrations.methods.vibration.effects.curved import CROSS, magnification
from tumble.calibrations.methods.vibration.probes import shaken
from tumble.calibrations.methods.vibration.scene import VibrationScene
from tumble.calibrations.methods.vibration.table import best_point, vibration_table

SMALL = np.array([38.0, 3.7, 0.3, -1.5, -4.9])
"""With small cross coefficients a ratio of 0.23 looks, by its slope at zero, like one of -0.04 with large ones."""


@pytest.mark.parametrize("ratio", [0.23, -0.37, 0.06])
def test_sideways_motion_starts_in_the_right_minimum(ratio):
    rows = dwells(*FIXTURES, shaken((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)), shaken((HALF, 0.0, HALF), (0.0, 1.0, 0.0)))
    shares = CROSS.shares(VibrationScene(observations=rows, history=rows), ratio)
    rows = measured(rows, shares.added(SMALL), k=SMALL)
    point = best_point(vibration_table(rows, rows), CROSS, ())
    assert point.value == pytest.approx(ratio, abs=0.02)


def test_a_resonance_without_damping_is_bounded():
    assert magnification(np.array([0.0, 50.0]), 100.0) == pytest.approx([1.0, 4.0 / 3.0])
    assert np.isfinite(magnification(np.array([100.0, 300.0]), 100.0)).all()
