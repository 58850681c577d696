from dataclasses import replace

import numpy as np
from tables import FLIPS, sweep, table

from tumble.calibrations.methods.dividing_head.gross import gross_errors
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.model import basis
from tumble.calibrations.methods.dividing_head.poses import pose_groups


def found(rows):
    return gross_errors(rows, basis(rows), pose_groups(rows), 6)


def test_clean_rows_are_kept():
    assert found(table(*FLIPS, sweep("face-up"), seed=8)) == ()


def test_a_gross_error_is_listed_with_its_row_and_size():
    rows = table(*FLIPS, sweep("face-up"), seed=8)
    rows.voltage_v[100] += 20e-4

    (entry,) = found(rows)
    assert entry.row == 101
    assert entry.reason in {"gross error: 19 sigma", "gross error: 20 sigma", "gross error: 21 sigma"}


def test_many_gross_errors_do_not_hide_each_other():
    rows = table(*FLIPS, sweep("face-up"), seed=8)
    wrong = np.arange(20, 420, 25)
    rows.voltage_v[wrong] += 0.01

    assert [entry.row for entry in found(rows)] == (wrong + 1).tolist()


def test_what_comes_back_at_every_visit_is_structure_and_kept():
    def bump(mount, angle_deg):
        return np.where((mount == "face-up") & (angle_deg == 140.0), 30e-4, 0.0)

    assert found(table(*FLIPS, sweep("face-up"), extra_v=bump)) == ()


def test_without_repeats_a_row_is_judged_by_the_model_alone():
    rows = table(sweep("face-up"), realisations=1, seed=9)
    rows.voltage_v[30] += 20e-4

    assert [entry.row for entry in found(rows)] == [31]


def test_good_rows_of_short_tables_stay():
    angles = np.arange(0.0, 360.0, 36.0)

    assert [found(table(("sweep", "face-up", angles), realisations=1, seed=seed)) for seed in range(200)] == [()] * 200


def test_what_comes_back_at_the_only_other_visit_is_structure_too():
    def bump(mount, angle_deg):
        return np.where((mount == "face-up") & (angle_deg == 140.0), 30e-4, 0.0)

    assert found(table(*FLIPS, sweep("face-up"), extra_v=bump, realisations=2)) == ()


def test_a_seat_that_is_off_is_no_gross_error_of_the_one_row_that_is_further_off():
    rows = table(*FLIPS, sweep("face-up"), sweep("face-down"), realisations=1)
    off_v = np.zeros(len(rows))
    off_v[4:6] = 9e-4, -5e-4

    assert found(replace(rows, voltage_v=rows.voltage_v + off_v)) == ()


def test_rows_of_a_kind_of_dwell_that_scatters_more_are_no_gross_errors():
    """Twelve times the noise in the three sweeps of few samples."""
    quiet = table(("sweep", "face-up", np.arange(0.0, 360.0, 5.0)), noise_v=2e-5)
    noise = np.random.default_rng(2).normal(size=len(quiet))
    few = np.arange(len(quiet)) < 216
    rows = replace(quiet, voltage_v=quiet.voltage_v + np.where(few, 2.5e-4 * noise, 0.0), samples=np.where(few, 4, 400))

    assert found(rows) == ()


def test_a_realisation_that_was_disturbed_as_a_whole_is_named():
    rows = table(*FLIPS, sweep("face-up"), seed=8)
    third = rows.realisation == 3
    rows.voltage_v[third] += np.random.default_rng(9).normal(0.0, 20e-4, third.sum())

    (warning,) = fit_jointly(rows).observations.warnings
    assert "realisation 3 was disturbed as a whole" in warning


def test_a_few_gross_errors_disturb_no_realisation():
    rows = table(*FLIPS, sweep("face-up"), seed=8)
    rows.voltage_v[100:104] += 20e-4

    assert fit_jointly(rows).observations.warnings == ()
