"""Bounds of both fits of a triad, as the benchmark counts them."""

import numpy as np
import pytest

from benchmarks.triad.bounds import PROGRAMMES, runs_of, scalar_bound
from benchmarks.triad.world import make
from tumble.calibrations.methods.triad.programmes import POSITIONS


@pytest.mark.parametrize("fit", PROGRAMMES)
def test_errors_are_as_large_as_the_bound(fit):
    ratio, inside = runs_of(fit, "24", 100)

    assert ratio.mean() == pytest.approx(1.0, abs=0.1)
    assert inside == pytest.approx(0.95, abs=0.03)


def test_scalar_bound_of_24_is_that_of_equal_channels():
    made = make(np.random.default_rng(1), POSITIONS["24"], 1, (1e-5, 1e-5, 1e-5))

    bound = scalar_bound(made) / 1e-5 * np.repeat([1.0, np.pi / 648000], [6, 3])

    # digest of the source: 0.354, 0.418 and 1.00 standard deviations of a dwell, for an ideal unit
    assert bound == pytest.approx(np.repeat([0.354, 0.418, 1.0], 3), rel=0.06)
