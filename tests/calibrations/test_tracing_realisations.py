"""What makes a realisation: a pass through the settings, whatever the column says."""

from dataclasses import replace

import numpy as np
import pytest
from sparse_tables import nine_settings, with_labels
from tables import FLIPS, sweep, table

from tumble.calibrations.methods.dividing_head.realisations import with_passes

PASSES = table(*FLIPS, sweep("face-up", 30.0), realisations=3)


def numbered(observations):
    found = with_passes(observations).observations.realisation
    return None if found is None else found.tolist()


@pytest.mark.parametrize("names", [(1, 2, 3), (3, 1, 2), (7, 9, 8)])
def test_passes_are_numbered_in_the_order_in_which_they_were_taken(names):
    relabelled = with_labels(PASSES, np.array(names)[PASSES.realisation - 1])
    assert numbered(relabelled) == PASSES.realisation.tolist()


def test_passes_are_found_where_nobody_numbered_them():
    found = with_passes(replace(PASSES, realisation=None))
    assert found.observations.realisation.tolist() == PASSES.realisation.tolist()
    assert "every pose comes back 3 times" in found.remark


@pytest.mark.parametrize(
    "numbers",
    [np.tile([1, 2, 3, 4], 9), np.repeat(np.arange(1, 10), 4), np.arange(1, 37)],
    ids=["pieces", "settings", "rows"],
)
def test_pieces_of_a_dwell_are_repeats_of_its_setting(numbers):
    found = with_passes(with_labels(nine_settings(), numbers))
    assert found.observations.realisation is None
    assert found.remark.endswith("realisation numbers repeats, not passes through the settings; taken as repeats")


def test_one_number_for_all_rows_says_nothing():
    assert with_passes(with_labels(nine_settings(), np.ones(36, int))).remark == ""


def test_a_sweep_there_and_back_is_one_pass():
    there = np.arange(0.0, 360.0, 30.0)
    rows = table(("sweep", "face-up", np.concatenate([there, there[::-1]])), realisations=1)
    assert numbered(replace(rows, realisation=None)) is None


def test_two_runs_over_other_settings_are_no_repeats_of_each_other():
    rows = table(("sweep", "face-up", np.arange(0.0, 170.0, 10.0)), ("sweep", "face-up", np.arange(180.0, 350.0, 10.0)))
    halves = np.where(rows.angle_deg < 175.0, 1, 2)[:34]
    first = rows.select(np.arange(len(rows)) < 34)
    assert numbered(with_labels(first, halves)) is None
