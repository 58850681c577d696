"""An explanation that runs away in rows that are held out is not used to predict them."""

import numpy as np
import pytest
from tables import UNIT, output, table

from tumble.calibrations.methods.dividing_head.loop.loop import explain
from tumble.calibrations.tracing.held_out import held_out_rms

SWEEPS = tuple(("sweep", mount, np.arange(0.0, 360.0, 30.0)) for mount in ("face-up", "face-down"))
THIRD = np.deg2rad(150.0)


def wave(mount, angle_deg):
    """An error of the angle, three to a turn."""
    angle_deg = np.asarray(angle_deg, float)
    off_deg = 0.05 * np.sin(3.0 * np.deg2rad(angle_deg) + THIRD)
    return output(mount, angle_deg + off_deg) - output(mount, angle_deg)


@pytest.mark.parametrize("first_deg", [0.0, 90.0])
def test_an_arc_held_out_is_predicted_no_worse_than_by_the_declared_model(first_deg):
    _, explained = explain(table(*SWEEPS, noise_v=1e-4, unit=UNIT, extra_v=wave))
    rows = explained.table.joint.observations
    out = (rows.angle_deg % 360.0 >= first_deg) & (rows.angle_deg % 360.0 < first_deg + 120.0)
    declared_rms = held_out_rms(explained.tracer, explained.trace.without("graduation"), [out])

    assert held_out_rms(explained.tracer, explained.trace, [out]) <= 1.02 * declared_rms
