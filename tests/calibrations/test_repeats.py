from dataclasses import replace

import numpy as np
import pytest
from tables import FLIPS, sweep, table

from tumble.calibrations.core.repeats import labels, pure_error, settings, without_levels
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import mountings, pose_groups
from tumble.calibrations.methods.dividing_head.weights import dwell_weights


def test_angles_within_a_few_thousandths_are_one_setting():
    assert settings(np.array([5.001, 10.0, 4.999, 395.0])).tolist() == [0, 1, 0, 2]


def test_the_seed_programme_has_344_degrees_of_freedom_for_pure_error():
    rows = table(*FLIPS, sweep("face-up"))
    error = pure_error(rows.voltage_v, pose_groups(rows), np.ones(len(rows)))

    assert error.degrees_of_freedom == 430 - 86
    assert error.standard_deviation == pytest.approx(1e-4, rel=0.1)


def test_rows_of_other_direction_are_other_poses():
    rows = Observations(row=np.arange(4), angle_deg=np.zeros(4), direction=np.array([1, 1, -1, -1]))

    assert pose_groups(rows).tolist() == [1, 1, 0, 0]


def test_labels_tell_every_combination_apart():
    assert len(set(labels(np.array([0, 0, 1, 1]), np.array(["a", "b", "a", "b"])).tolist())) == 4


def test_a_mounting_is_an_unbroken_run_of_one_mount():
    mount = np.array(["face-up", "face-up", "edge", "face-up"])
    rows = Observations(row=np.arange(4), angle_deg=np.zeros(4), mount=mount)

    assert mountings(rows).tolist() == [0, 0, 1, 2]


def test_even_noise_weighs_all_rows_alike():
    rows = table(*FLIPS, sweep("face-up"))

    assert dwell_weights(rows, rows.voltage_v - rows.voltage_v.mean(), pose_groups(rows)).tolist() == [1.0] * 430


def test_a_noisier_procedure_weighs_less():
    rows = table(*FLIPS, sweep("face-up"), noise_v=0.0, realisations=20)
    flip = rows.procedure == "flip"
    residual = np.random.default_rng(5).normal(size=len(rows)) * np.where(flip, 3e-4, 1e-4)
    weights = dwell_weights(rows, residual, pose_groups(rows))

    assert weights[~flip][0] / weights[flip][0] == pytest.approx(9.0, rel=0.4)
    assert weights.mean() == pytest.approx(1.0)


def test_a_drift_between_runs_is_no_noise_of_the_procedure_that_was_repeated():
    rows = table(*FLIPS, sweep("face-up"), noise_v=0.0, realisations=6)
    drifted = (rows.procedure != "flip") & (rows.realisation > 3)
    residual = np.random.default_rng(5).normal(0.0, 1e-4, len(rows)) + 2e-3 * drifted
    rows = replace(rows, realisation=np.where(drifted, rows.realisation, np.minimum(rows.realisation, 3)))

    assert dwell_weights(rows, residual, pose_groups(rows)).tolist() == [1.0] * len(rows)


def test_levels_go_from_values_and_what_groups_differ_by_stays():
    groups, level = np.array([0, 1, 0, 1, 1]), np.array([0, 0, 1, 1, 2])

    left = without_levels(np.array([1.0, 5.0, 3.0, 7.0, 4.0]), groups, level)

    assert left[[0, 1]] == pytest.approx(left[[2, 3]])
    assert left[4] == pytest.approx(left[1])
    assert left[1] - left[0] == pytest.approx(4.0)
