from dataclasses import replace

import numpy as np
import pytest
from public_heads import five_settings

from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.head_reference.document import document
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.sentences import headline


def cycles(error_deg, *, count=4, step_deg=15.0, noise_deg=1e-3, seed=2, slips=(), **columns):
    """Rests there and back over a turn, several times; `error_deg(angle, direction, time)` is reference minus head."""
    up = np.arange(0.0, 361.0, step_deg)
    angle_deg = np.tile(np.concatenate([up, up[::-1]]), count)
    direction = np.tile(np.concatenate([np.ones(len(up)), -np.ones(len(up))]).astype(int), count)
    time_s = 10.0 * np.arange(len(angle_deg))
    noise = noise_deg * np.random.default_rng(seed).standard_normal(len(angle_deg))
    reference_deg = angle_deg + error_deg(angle_deg, direction, time_s) + noise
    for row, slip_deg in slips:
        reference_deg[row - 1] += slip_deg
    return Observations(
        row=np.arange(1, len(angle_deg) + 1),
        angle_deg=angle_deg,
        reference_deg=reference_deg,
        time_s=time_s,
        direction=direction,
        **columns,
    )


def named(loop):
    return sorted(effect.name for effect in loop.effects)


@pytest.fixture(scope="module")
def five():
    return close_reference_loop(five_settings())


def test_five_settings_there_and_back_have_a_reversal_error_each(five):
    thousandths = [round(1e3 * each.reversal_deg, 1) for each in five.by_setting]
    assert thousandths == pytest.approx([32, -15, -5.7, 21.7, 46.5], abs=0.6)
    assert [1e3 * each.reversal_uncertainty_deg for each in five.by_setting] == pytest.approx([1.3] * 5, abs=0.1)
    assert [each.angle_deg for each in five.by_setting] == pytest.approx([15.0, 25.2, 35.4, 45.6, 55.8])


def test_a_constant_does_not_fit_five_settings_by_their_repeats(five):
    test = five.agreements[0]
    assert test.words.startswith("F(9, 38) = 497, p < 0.0001")
    assert five.reversal.differs


def test_no_harmonic_of_a_turn_is_identifiable_from_forty_one_degrees(five):
    assert five.effects == ()
    assert five.unexplained[0].depends_on == "angle"
    assert "F(9, 38) = 497" in five.unexplained[0].description
    assert any("span 41° of the circle" in sentence for sentence in five.limits)
    assert "shows no effect" not in headline(five)


@pytest.mark.parametrize("labels", [None, "one", "shuffled"])
def test_how_repeats_are_labelled_and_ordered_changes_nothing(five, labels):
    table = five_settings()
    if labels == "shuffled":
        order = np.random.default_rng(3).permutation(len(table))
        table = replace(table.select(order), row=np.arange(1, len(table) + 1))
    else:
        table = replace(table, realisation=None if labels is None else np.ones(len(table), dtype=int))
    again = close_reference_loop(table)
    assert again.agreements[0].f == pytest.approx(five.agreements[0].f)
    assert again.augmented.parameters["offset"].value == pytest.approx(five.augmented.parameters["offset"].value)
    assert again.effects == ()


def test_the_document_gives_the_error_of_every_setting(five):
    content = document(five)
    first = content["by_setting"][0]
    assert (first["forward"]["visits"], first["backward"]["visits"]) == (5, 4)
    assert first["reversal_deg"] == pytest.approx(0.032, abs=5e-4)
    assert content["noise"]["pure_error_degrees_of_freedom"] == 38
    assert content["declared"]["lack_of_fit"]["degrees_of_freedom"] == [9, 38]
    assert (content["method"], content["rows"]["settings"]) == ("head_reference", 10)


def test_slips_are_rows_that_differ_from_the_repeats_of_their_setting():
    loop = close_reference_loop(cycles(lambda a, d, t: 0.02 * np.sin(np.deg2rad(a)), slips=((20, 0.5), (90, -10.0))))
    assert [entry.row for entry in loop.observations.set_aside] == [20, 90]
    assert "10° less than the repeats of its setting" in loop.observations.set_aside[1].reason
    assert named(loop) == ["head_eccentricity"]


def test_an_error_that_comes_back_at_every_visit_is_no_slip():
    loop = close_reference_loop(cycles(lambda a, d, t: 0.3 * (np.abs(a - 120.0) < 1.0)))
    assert loop.observations.set_aside == ()
    assert loop.by_setting[8].forward.error_deg == pytest.approx(0.3, abs=2e-3)
    assert loop.agreements[0].contradicted


def test_of_two_visits_that_disagree_the_one_unlike_its_neighbours_goes():
    loop = close_reference_loop(cycles(lambda a, d, t: 0.02 * np.sin(np.deg2rad(a)), count=2, slips=((60, 0.4),)))
    assert [entry.row for entry in loop.observations.set_aside] == [60]


def test_rounding_of_the_reference_is_no_slip():
    table = cycles(lambda a, d, t: 0.0 * a + 0.049, noise_deg=5e-3)
    rounded = replace(table, reference_deg=np.round(table.reference_deg, 1))
    assert close_reference_loop(rounded).observations.set_aside == ()


def test_a_drift_is_seen_between_the_visits_of_a_setting():
    loop = close_reference_loop(cycles(lambda a, d, t: 0.05 * t / 3600.0 + 0.02 * np.sin(np.deg2rad(a + 30.0))))
    assert named(loop) == ["head_eccentricity", "reference_drift"]
    drift = next(effect for effect in loop.effects if effect.name == "reference_drift")
    assert drift.coefficients["reference_drift"].value == pytest.approx(0.05, abs=2e-3)
    assert loop.augmented.residual_rms < 1.2e-3


def test_backlash_is_distinguished_from_its_settings():
    loop = close_reference_loop(cycles(lambda a, d, t: 0.01 * (d < 0)))
    assert named(loop) == ["backlash"]
    assert not loop.agreements[1].contradicted


@pytest.mark.parametrize("seed", range(70, 80))
def test_a_clean_head_that_was_visited_often_is_left_alone(seed):
    loop = close_reference_loop(cycles(lambda a, d, t: 0 * a, seed=seed))
    assert (loop.effects, loop.unexplained, loop.observations.set_aside) == ((), (), ())


def test_angles_that_are_set_again_only_nearly_are_one_setting():
    table = cycles(lambda a, d, t: 0.02 * np.sin(np.deg2rad(a)))
    jitter_deg = 0.1 * np.random.default_rng(5).uniform(-1, 1, len(table))
    moved = replace(table, angle_deg=table.angle_deg + jitter_deg, reference_deg=table.reference_deg + jitter_deg)
    loop = close_reference_loop(moved)
    assert len(loop.by_setting) == 25
    assert named(loop) == ["head_eccentricity"]


def test_few_settings_are_too_few_however_often_they_were_visited():
    table = cycles(lambda a, d, t: 0.1 * np.sin(np.deg2rad(a)), count=6)
    few = table.select(np.isin(table.angle_deg, (0.0, 90.0)))
    loop = close_reference_loop(few)
    assert headline(loop) == "nothing was looked for: 4 settings (visited 24 times) are too few; at least 6 are needed."
    assert loop.augmented.parameters["offset"].value is None
    assert "too few" in document(loop)["augmented"]["parameters"]["offset"]["reason"]


def test_without_repeats_the_weaker_test_is_named():
    table = cycles(lambda a, d, t: 0.02 * np.sin(np.deg2rad(a)), count=1)
    loop = close_reference_loop(table)
    assert loop.agreements == (None, None)
    assert loop.by_setting == ()
    assert "the weaker test" in loop.limits[0]


def test_slips_without_repeats_are_held_against_the_settings_beside_them_whatever_the_order():
    table = cycles(lambda a, d, t: 0.5 * np.sin(np.deg2rad(a)), count=1, step_deg=5.0, slips=((30, 0.9),))
    order = np.random.default_rng(4).permutation(len(table))
    shuffled = table.select(order)
    loop = close_reference_loop(replace(shuffled, time_s=None))
    assert [entry.row for entry in loop.observations.set_aside] == [30]
