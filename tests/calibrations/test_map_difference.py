from dataclasses import replace

import numpy as np
import pytest
from head_tables import rests
from public_heads import backwards, five_settings, joint

from tumble.calibrations.methods.head_reference.changes import compare
from tumble.calibrations.methods.head_reference.comparison_document import comparison_json
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.sentences import part_rows, sentences


def compared(first, second):
    return compare(close_reference_loop(first), close_reference_loop(second))


def sine(angle_deg, order, amplitude_deg, phase_deg=0.0):
    return amplitude_deg * np.sin(np.deg2rad(order * angle_deg + phase_deg))


@pytest.fixture(scope="module")
def joints():
    return compared(joint(loaded=False), joint(loaded=True))


def test_a_load_changes_the_error_of_a_joint_above_zero_and_hardly_below(joints):
    above = [part.mean_deg for part in joints.parts if part.direction > 0]
    below = [part.mean_deg for part in joints.parts if part.direction < 0]
    assert -1.2 < min(above) < max(above) < -0.35
    assert max(abs(mean) for mean in below) < 0.35
    assert joints.difference.varies


def test_coefficients_of_two_lists_are_not_held_against_each_other(joints):
    assert "graduation" not in [change.name for change in joints.changes]
    for change in joints.changes:
        assert {"head_eccentricity", "head_second_harmonic"} & {change.name, *change.also_possible}


def test_the_slopes_of_both_are_nearly_the_same(joints):
    assert [slope for slope, _ in joints.slopes] == pytest.approx([0.050, 0.039], abs=6e-4)
    assert any("0.0495" in sentence and "0.0387" in sentence for sentence in sentences(joints, "a.csv", "b.csv"))


def test_where_side_and_direction_are_the_same_rows_that_is_said(joints):
    said = " ".join(sentences(joints, "a.csv", "b.csv"))
    assert "backlash and the shape of the error are the same rows and not distinguishable" in said
    assert "backlash" not in [change.name for change in joints.changes]
    assert "the weaker test" in said


def test_a_constant_is_the_set_ups_and_no_change_of_the_head():
    def error(a, d, t):
        return sine(a, 1, 0.02, 30) + sine(a, 5, 0.004)

    comparison = compared(rests(error), rests(lambda a, d, t: 0.7 + error(a, d, t), seed=2))
    assert not comparison.changed
    assert comparison.changes == ()
    assert comparison.difference.constant_deg == pytest.approx(0.7, abs=5e-4)
    assert "the set-up moved by 0.7°" in sentences(comparison, "a", "b")[1]
    assert not any(part.differs for part in comparison.parts)


def test_repeats_give_the_uncertainty_of_a_difference():
    table = five_settings()
    moved = replace(table, reference_deg=table.reference_deg + 0.01 * (table.angle_deg == 35.4))
    comparison = compared(table, moved)
    at = comparison.difference.angle_deg == 35.4
    assert comparison.difference.difference_deg[at] == pytest.approx([0.01, 0.01], abs=1e-9)
    assert comparison.difference.difference_deg[~at] == pytest.approx(np.zeros(8), abs=1e-9)
    assert comparison.difference.uncertainty_deg == pytest.approx(np.full(10, 0.0013), abs=1.5e-4)
    assert comparison.difference.degrees_of_freedom == 38
    assert [part.from_deg for part in comparison.parts if part.differs] == pytest.approx([35.4, 35.4])


def test_the_same_table_twice_changed_by_nothing():
    comparison = compared(five_settings(), five_settings())
    assert not comparison.changed
    assert comparison.difference.constant_deg == pytest.approx(0.0, abs=1e-9)


def test_other_angles_are_interpolated_on_the_common_arc_alone():
    whole = rests(lambda a, d, t: sine(a, 1, 0.02))
    short = rests(lambda a, d, t: 0.1 + sine(a, 1, 0.02), step_deg=4.0, seed=3)
    short = short.select((short.angle_deg >= 100.0) & (short.angle_deg <= 220.0))
    comparison = compared(whole, short)
    assert comparison.difference.angle_deg.min() >= 100.0
    assert comparison.difference.angle_deg.max() <= 220.0
    assert comparison.difference.constant_deg == pytest.approx(0.1, abs=1e-3)
    assert not comparison.changed


def test_a_bump_that_appeared_is_found_where_it_is():
    comparison = compared(
        rests(lambda a, d, t: sine(a, 1, 0.02)),
        rests(lambda a, d, t: sine(a, 1, 0.02) + 0.02 * np.exp(-0.5 * ((a - 140.0) / 12.0) ** 2), seed=4),
    )
    assert comparison.changed
    assert comparison.changes == ()
    assert "near 140°" in comparison.unexplained[0].description
    most = max(comparison.parts, key=lambda part: part.mean_deg)
    assert most.from_deg < 140.0 < most.to_deg


def test_a_backlash_that_appeared_is_the_change():
    (change,) = compared(rests(lambda a, d, t: 0 * a), rests(lambda a, d, t: 0.01 * (d < 0), seed=2)).changes
    assert (change.name, change.before) == ("backlash", 0.0)
    assert change.difference == pytest.approx(0.01, abs=5e-4)


def test_waves_of_the_difference_are_those_that_went():
    comparison = compared(
        rests(lambda a, d, t: sine(a, 1, 0.02, 30) + sine(a, 4, 0.05) + sine(a, 8, 0.01)),
        rests(lambda a, d, t: sine(a, 1, 0.02, 30), seed=2),
    )
    assert [(change.order, change.after) for change in comparison.changes] == [(4, 0.0), (8, 0.0)]
    assert comparison.changes[0].difference == pytest.approx(0.05, abs=5e-4)


@pytest.mark.parametrize("second", [backwards(), rests(lambda a, d, t: 0 * a).select(slice(0, 2))])
def test_tables_of_which_nothing_is_stated_are_not_compared(second):
    comparison = compared(five_settings(), second)
    said = comparison_json(comparison, "a.csv", "b.csv")
    assert (said["changed"], said["difference"]) == ([], None)
    assert "cannot be compared" in said["sentences"][0]


def test_maps_without_a_common_arc_are_not_compared():
    table = five_settings()
    away = replace(table, angle_deg=table.angle_deg + 90.0, reference_deg=table.reference_deg + 90.0)
    assert compared(table, away).difference is None


def test_rounding_of_the_computer_is_shown_as_zero(joints):
    cells = [cell for row in part_rows(joints) for cell in row]
    assert "0°" in cells
    assert not [cell for cell in cells if "e-" in cell]
