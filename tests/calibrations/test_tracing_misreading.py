"""A gross error by a round amount is a misreading only where the noise has no heavy tails."""

from dataclasses import replace

import numpy as np
import pytest
from tables import FLIPS, output, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

MOUNTS = (*FLIPS, sweep("face-up"), sweep("face-down"))


def with_one_row_a_sixth_of_a_degree_off(rows):
    """Row 41 is 29 standard deviations off, as a reading ten minutes wrong is."""
    volts = rows.voltage_v.copy()
    mount, angle_deg = str(rows.mount[40]), rows.angle_deg[40]
    volts[40] += (output(mount, np.array([angle_deg + 1 / 6])) - output(mount, np.array([angle_deg])))[0]
    return replace(rows, voltage_v=volts)


def test_one_row_far_off_by_a_round_amount_is_a_misreading():
    loop = close_loop(with_one_row_a_sixth_of_a_degree_off(table(*MOUNTS)))

    assert [(entry.row, entry.error_deg) for entry in loop.misread] == [(41, pytest.approx(1 / 6))]


def test_where_tails_are_heavy_one_such_row_is_none():
    rows = table(*MOUNTS, noise_v=0.0)
    tails = 8e-5 * np.random.default_rng(5).standard_t(4, len(rows))
    loop = close_loop(with_one_row_a_sixth_of_a_degree_off(replace(rows, voltage_v=rows.voltage_v + tails)))

    assert loop.misread == ()
    assert 41 in [entry.row for entry in loop.augmented.observations.set_aside]
