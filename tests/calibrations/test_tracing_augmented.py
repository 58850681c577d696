"""What was found, seen in other rows of the same table."""

from dataclasses import replace

import numpy as np
from tables import FLIPS, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import explain
from tumble.calibrations.methods.dividing_head.loop.table import scene_of

MOUNTS = (*FLIPS, sweep("face-up"), sweep("face-down"))


def bump(_, angle_deg):
    return 5e-4 * np.exp(-0.5 * ((angle_deg - 140.0) / 10.0) ** 2)


def test_what_has_no_name_is_carried_to_rows_that_were_not_fitted():
    rows = table(*MOUNTS, extra_v=bump)
    _, explained = explain(rows)
    longer = table(*MOUNTS, ("sweep", "face-down", [141.0]), extra_v=bump)
    residual_v = explained.best.residual_v(scene_of(longer, explained.table.joint.fit.theta))

    assert [component.depends_on for component in explained.trace.components] == ["angle"]
    assert np.abs(residual_v[longer.angle_deg == 141.0]).max() < 4e-4


def test_a_gross_error_on_structure_without_a_name_is_still_one():
    rows = table(*MOUNTS, extra_v=bump)
    voltage_v = rows.voltage_v.copy()
    voltage_v[40] += 3e-3
    loop, explained = explain(replace(rows, voltage_v=voltage_v))

    assert [entry.row for entry in explained.table.observations.set_aside] == [41]
    assert loop.unexplained.depends_on == "angle"
