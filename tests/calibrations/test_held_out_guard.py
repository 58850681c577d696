"""An explanation that runs away in rows that are held out is not used to predict them."""

import numpy as np
import pytest
from tables import UNIT, gravity_on, output, table

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


def even(mount, angle_deg):
    """An effect that the sweeps tell, and one that only the edge does."""
    ax, _, az = gravity_on(mount, angle_deg)
    return 1e-3 * np.abs(ax) + 2e-3 * az**2


def test_rows_that_alone_part_an_effect_from_a_parameter_are_predicted_without_that_effect():
    """Of an axis up once and down once, kz is the difference and k_zz the sum: one of the two tells neither."""
    sweeps = tuple(("sweep", mount, np.arange(0.0, 360.0, 10.0)) for mount in ("face-up", "face-down"))
    edges = ("flip", "edge", np.array([0.0, 180.0]))
    _, explained = explain(table(*sweeps, edges, noise_v=1e-4, unit=UNIT, extra_v=even))
    used = explained.table.joint.observations
    out = (used.mount == "edge") & (used.angle_deg == 0.0)
    others = frozenset(effect.name for effect in explained.tracer.effects) - {"scale_asymmetry"}
    without = explained.trace.without("k_zz")

    assert set(explained.trace.names) == {"scale_asymmetry", "k_zz"}
    assert held_out_rms(explained.tracer, explained.trace, [out]) == pytest.approx(
        held_out_rms(explained.tracer.without(others), without, [out])
    )
