"""Parameters of a linear declared model, as a result states them."""

import numpy as np
import pytest

from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.linear import fit_linear
from tumble.calibrations.tracing.linear_loop import as_stated
from tumble.calibrations.tracing.noise import Memory
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import nothing_found


def mean_of(*volts):
    count = len(volts)

    class Scene:
        rows, hours = count, None

    table = Table(
        model=Linear(functions=np.ones((count, 1))),
        output=np.array(volts),
        unit="V",
        weights=np.ones(count),
        scene=Scene(),
        effects=(),
        structures=(),
        memory=Memory(modes=np.empty((count, 0))),
    )
    return as_stated(fit_linear(table, nothing_found(table), {"mean": "V"}))["mean"]


def test_the_interval_of_a_mean_is_students():
    """Of 1, 2, 3 and 4 the standard deviation is 1.29099, and t for 3 degrees of freedom 3.18245 (GUM, table G.2)."""
    mean = mean_of(1.0, 2.0, 3.0, 4.0)
    assert mean.degrees_of_freedom == 3
    assert mean.standard_uncertainty == pytest.approx(0.645497, rel=1e-5)
    assert mean.interval_95 == pytest.approx((2.5 - 2.05426, 2.5 + 2.05426), rel=1e-5)


def test_rows_that_are_all_used_up_leave_no_interval():
    mean = mean_of(1.0)
    assert (mean.degrees_of_freedom, mean.interval_95) == (None, None)
