"""Which gross errors are misreadings: round amounts, and more of them than chance gives."""

from dataclasses import replace

import numpy as np
from tables import FLIPS, output, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

MOUNTS = (*FLIPS, sweep("face-up"), sweep("face-down"))


def with_rows(rows, changes):
    """A table with single outputs changed, by index of the row."""
    volts = rows.voltage_v.copy()
    for row, added_v in changes.items():
        volts[row] += added_v
    return replace(rows, voltage_v=volts)


def misread_v(rows, row, error_deg):
    """What the output of a row changes by if its angle is off."""
    right, wrong = output(str(rows.mount[row]), rows.angle_deg[row] + np.array([0.0, error_deg]))
    return wrong - right


def steep(rows, count):
    """Rows at which the output changes most with the angle."""
    slope = [abs(misread_v(rows, row, 1.0)) for row in range(len(rows))]
    return np.argsort(slope)[-count:].tolist()


def test_one_degree_wrong_is_a_misreading():
    rows = table(*MOUNTS)
    (row,) = steep(rows, 1)
    loop = close_loop(with_rows(rows, {row: misread_v(rows, row, 1.0)}))

    assert [(entry.row, entry.error_deg) for entry in loop.misread] == [(row + 1, 1.0)]
    assert [effect.name for effect in loop.effects] == ["misreading"]


def test_a_spike_between_two_round_amounts_is_only_set_aside():
    rows = table(*MOUNTS)
    (row,) = steep(rows, 1)
    loop = close_loop(with_rows(rows, {row: misread_v(rows, row, 0.25)}))

    assert loop.misread == ()
    assert [entry.row for entry in loop.augmented.observations.set_aside] == [row + 1]


def test_a_heavy_tail_that_meets_a_round_amount_by_chance_is_no_misreading():
    rows = table(*MOUNTS)
    generator = np.random.default_rng(2)
    tail = 1e-4 / np.sqrt(2.0) * generator.standard_t(3, len(rows))
    loop = close_loop(with_rows(rows, dict(enumerate(tail.tolist()))))

    assert any(entry.reason.startswith("gross") for entry in loop.augmented.observations.set_aside)
    assert loop.misread == ()
