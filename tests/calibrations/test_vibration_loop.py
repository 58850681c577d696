"""The loop closed on vibrated dwells: effects by name and coefficient, what is set aside, withheld, and asked for."""

import numpy as np
import pytest
from vibration_tables import CENTRIFUGE, HALF, I, K, O, P, dwells, measured, with_columns

from benchmarks.vibration.__main__ import closed, drawn
from tumble.calibrations.methods.vibration.document import document
from tumble.calibrations.methods.vibration.effects.curved import CLIPPING, CROSS, RESPONSE
from tumble.calibrations.methods.vibration.effects.stand import arm_ug, partial_period_ug, warmth
from tumble.calibrations.methods.vibration.effects.unit import fourth_order
from tumble.calibrations.methods.vibration.effects.unnamed import unnamed
from tumble.calibrations.methods.vibration.experiments import next_experiments
from tumble.calibrations.methods.vibration.line import lines
from tumble.calibrations.methods.vibration.loop import close_vibration_loop, declared_fit
from tumble.calibrations.methods.vibration.probes import PROBES, circle, shaken
from tumble.calibrations.methods.vibration.products import mean_products
from tumble.calibrations.methods.vibration.scene import VibrationScene
from tumble.calibrations.tracing.trace import nothing_found

SINGLE = (shaken(I, O),)
FIXTURES = (
    shaken(I, O),
    shaken(I, (0.0, -1.0, 0.0), (0.0, -1.0, 0.0)),
    shaken(O, I, P),
    shaken(P, I),
    shaken((HALF, HALF, 0.0), (HALF, -HALF, 0.0), P),
)


def scene_of(rows):
    return VibrationScene(observations=rows, history=rows)


def names(loop):
    return [str(effect.name) for effect in loop.effects]


def effect(loop, name):
    return next(each for each in loop.effects if each.name == name)


def test_nothing_is_found_where_there_is_nothing():
    loop = close_vibration_loop(measured(dwells(*FIXTURES)))
    assert (loop.effects, loop.unexplained) == ((), None)


def test_a_fourth_order_is_told_from_the_second():
    rows = dwells(*FIXTURES)
    loop = close_vibration_loop(measured(rows, 0.03 * fourth_order(scene_of(rows))))
    assert names(loop) == ["k_iiii"]
    assert effect(loop, "k_iiii").coefficients["k_iiii"].value == pytest.approx(0.03, rel=0.1)
    assert loop.augmented.parameters["k_ii"].value == pytest.approx(K[0], abs=0.3)


@pytest.mark.parametrize("ratio", [0.15, -0.1])
def test_sideways_motion_is_fitted_in_full(ratio):
    rows = dwells(*FIXTURES, shaken((HALF, -HALF, 0.0), (HALF, HALF, 0.0), P))
    shares = CROSS.shares(scene_of(rows), ratio)
    loop = close_vibration_loop(measured(rows, shares.added(K)))
    assert names(loop) == ["shaker_cross"]
    found = effect(loop, "shaker_cross").coefficients["ratio"]
    assert found.value == pytest.approx(ratio, abs=4.0 * found.standard_uncertainty)
    cross = loop.augmented.parameters["k_io"]
    assert cross.value == pytest.approx(K[3], abs=4.0 * cross.standard_uncertainty)


def test_without_a_second_fixture_two_ratios_give_the_same_dwells_and_both_are_said():
    """Of k_io the plain mountings tell its product with the ratio, one at 45° a sum of both: a quadratic equation."""
    rows = dwells(*FIXTURES)
    loop = close_vibration_loop(measured(rows, CROSS.shares(scene_of(rows), 0.15).added(K)))
    cross = loop.augmented.parameters["k_io"]
    assert cross.value is None
    assert min(abs(value - K[3]) for value in cross.given.values()) < 0.4


def test_a_resonance_is_named_by_its_frequency():
    rows = dwells(*FIXTURES)
    inverse_khz2 = (1000.0 / 1100.0) ** 2
    loop = close_vibration_loop(measured(rows, RESPONSE.shares(scene_of(rows), inverse_khz2).added(K)))
    assert names(loop) == ["frequency_response"]
    found = effect(loop, "frequency_response").coefficients["natural_hz"]
    assert found.value == pytest.approx(1100.0, abs=4.0 * (found.standard_uncertainty or 0.0))


def test_clipping_is_found_by_its_limit():
    rows = dwells(*FIXTURES)
    loop = close_vibration_loop(measured(rows, CLIPPING.shares(scene_of(rows), 9.996).added(K)))
    assert names(loop) == ["clipping"]
    assert effect(loop, "clipping").coefficients["limit_g"].value == pytest.approx(9.996, abs=0.002)


def test_warming_is_found_with_its_time_constant():
    rows = dwells(*SINGLE, passes=4)
    loop = close_vibration_loop(measured(rows, -1.9 * warmth(scene_of(rows), 150.0).columns[:, 0]))
    assert names(loop) == ["thermal_shift"]
    found = effect(loop, "thermal_shift").coefficients
    assert found["amplitude"].value == pytest.approx(-1.9, abs=0.4)
    assert found["tau_s"].value == pytest.approx(150.0, rel=0.4)


def test_an_arm_is_told_by_both_senses():
    rows = dwells(*CENTRIFUGE, passes=2)
    arm = 1e-4 * arm_ug(rows.filled("main_rad_s"), rows.filled("sub_rad_s"))
    loop = close_vibration_loop(measured(rows, arm))
    assert names(loop) == ["spin"]
    assert effect(loop, "spin").coefficients["spin"].value == pytest.approx(1e-4, rel=0.2)
    assert loop.augmented.parameters["k_ii+k_pp"].value == pytest.approx(K[0] + K[2], abs=0.5)


def test_what_a_cut_period_leaves_is_found():
    rows = dwells(*SINGLE, passes=3)
    rng = np.random.default_rng(8)
    rows = with_columns(
        rows,
        dwell_s=60.0 + rng.uniform(0.0, 0.05, len(rows)),
        phase_i_deg=rng.uniform(-180.0, 180.0, len(rows)),
    )
    phase = np.deg2rad(rows.filled("phase_i_deg"))
    cut = partial_period_ug(rows.filled("ai_g"), phase, rows.filled("fi_hz"), rows.filled("dwell_s"))
    loop = close_vibration_loop(measured(rows, 0.05 * cut))
    assert names(loop) == ["partial_periods"]


def test_a_shift_lasts_to_the_end_of_its_mounting_and_is_no_gross_error():
    rows = dwells(*FIXTURES)
    late = (np.arange(len(rows)) >= 30) & (np.asarray(rows.mounting) == np.asarray(rows.mounting)[30])
    loop = close_vibration_loop(measured(rows, 40.0 * late))
    assert names(loop) == ["after_shift"]
    found = effect(loop, "after_shift").coefficients
    assert (found["row"].value, loop.observations.set_aside) == (30.0, ())
    assert found["step"].value == pytest.approx(40.0, abs=5.0)


def test_single_wrong_dwells_are_set_aside():
    rows = dwells(*FIXTURES)
    wrong = np.zeros(len(rows))
    wrong[[17, 60]] = 150.0, -90.0
    loop = close_vibration_loop(measured(rows, wrong))
    assert [each.row for each in loop.observations.set_aside] == [18, 61]
    assert loop.effects == ()


def test_a_course_of_the_level_is_forced_into_no_two_names():
    rows = dwells(*SINGLE, passes=4)
    loop = close_vibration_loop(measured(rows, 30.0 * np.tanh(rows.level / 2.0)))
    assert loop.effects == ()
    assert loop.unexplained.depends_on == "amplitude"


def test_a_mode_of_the_fixture_is_a_matter_of_frequency():
    rows = dwells(*FIXTURES)
    scene = scene_of(rows)
    near = np.exp(-0.5 * (np.log2(np.maximum(scene.frequency_hz, 1.0) / 80.0) / 0.4) ** 2)
    loop = close_vibration_loop(measured(rows, 0.9 * scene.products_g2[:, 0] * near))
    assert (loop.effects, loop.unexplained.depends_on) == ((), "frequency")


def test_a_course_of_the_level_is_no_name_that_stands_because_another_fell():
    _, made, where = drawn("novel", 1_000_461)
    assert where == "single"
    loop = closed(made)
    assert (loop.effects, loop.unexplained.depends_on) == ((), "amplitude")


def test_what_follows_the_frequency_leaves_random_vibration_out():
    rows = dwells(*SINGLE)
    random = (rows.level > 0.0) & (np.arange(len(rows)) % 4 == 1)
    mixed = with_columns(rows, mii_g2=np.where(random, 2.0, np.nan), ai_g=np.where(random, 0.0, np.asarray(rows.ai_g)))
    following = [axis for axis in unnamed(scene_of(mixed)) if axis.coordinate.word == "frequency"]
    assert len(following) == 2
    for axis in following:
        assert not axis.channel.gain[random].any()
        assert axis.channel.gain[(rows.level > 0.0) & ~random].all()


def test_one_direction_of_the_drive_says_what_it_takes_for_a_coefficient():
    loop = close_vibration_loop(measured(dwells(*SINGLE, passes=2)))
    assert "sideways motion of the shaker and a lean of its table are part of it" in (
        loop.augmented.parameters["k_ii"].remark
    )
    assert close_vibration_loop(measured(dwells(*FIXTURES))).augmented.parameters["k_ii"].remark == ""


def test_what_is_not_told_is_asked_for():
    (asked,) = next_experiments(close_vibration_loop(measured(dwells(*SINGLE))).explained)
    assert asked.programme == "vibration-fixtures"
    assert asked.separates == ("k_oo", "k_pp", "k_io", "k_ip")


def test_every_probe_adds_its_dwells():
    rows = measured(dwells(*SINGLE))
    for probe in PROBES:
        after = probe.after(rows)
        assert len(after) == len(rows) + sum(2 * len(each.shakes) + 1 for each in probe.mountings)
        assert np.all(np.diff(after.time_s) > 0)


def test_the_document_has_the_keys_of_the_contract():
    found = document(close_vibration_loop(measured(dwells(circle(0), circle(1), circle(2)))))
    assert (found["schema"], found["method"]) == ("tumble.loop/1", "vibration")
    assert set(found["declared"]["parameters"]) == {"k_ii", "k_oo", "k_pp", "k_io", "k_ip"}
    assert found["augmented"]["parameters"]["k_io"]["value"] is None
    assert found["augmented"]["residual_rms_ug"] > 0.0
    assert found["augmented"]["held_out_rms_ug"] > 0.0
    assert {each["axis"] for each in found["vrc"]} == {"i", "o", "p"}
    assert all(line["straight"] for line in found["dc_against_g2"])


def drawn_lines(seed, bent_ug=0.0):
    """The line of each axis: whether it is straight, and at which probability."""
    rows = dwells(circle(0), circle(1), circle(2))
    bend = bent_ug * mean_products(rows)[:, 0] ** 2
    declared = declared_fit(measured(rows, added_ug=bend, seed=seed))
    drawn = lines(declared.table, declared.fit, nothing_found(declared.table))
    return {line.axis: (line.straight, line.p_value) for line in drawn}


def test_one_of_three_lines_that_differs_by_chance_of_one_in_fifty_is_called_straight():
    straight, p_value = drawn_lines(seed=28)["p"]

    assert 0.0167 < p_value < 0.05
    assert straight


def test_a_line_that_bends_is_not_straight():
    bent = drawn_lines(seed=28, bent_ug=0.5)

    assert not bent["i"][0]
    assert bent["o"][0]


def test_an_output_that_never_changes_is_asked_about():
    rows = dwells(*FIXTURES)
    with pytest.raises(ValueError, match=r"output_ug never changes .* is the unit connected"):
        close_vibration_loop(with_columns(rows, output_ug=100.0 * rows.mountings))


def at_levels(rows, *levels_g):
    """Dwells of which only the rests and those of some levels are left."""
    return rows.select(np.isin(np.round(rows.level, 3), [0.0, *levels_g]))


def remark(rows, name="k_ii"):
    return close_vibration_loop(measured(rows)).augmented.parameters[name].remark


def test_a_coefficient_of_one_level_says_that_no_curvature_is_seen():
    rows = dwells(*SINGLE, passes=2)
    level_g = float(rows.level.max())

    assert "it comes of one level of vibration" in remark(at_levels(rows, round(level_g, 3)))
    assert "sideways motion" in remark(at_levels(rows, round(level_g, 3)))
    assert "one level" not in remark(rows)


def test_each_coefficient_asks_for_its_own_levels():
    rows = dwells(shaken(I, O), shaken(P, I), passes=2)
    mounting, level_g = np.asarray(rows.mounting), float(rows.level.max())
    mixed = rows.select((mounting == mounting.min()) | np.isin(rows.level, [0.0, level_g]))

    assert "one level" not in remark(mixed)
    assert "one level" in remark(mixed, "k_pp")


def test_outputs_of_a_thousandth_are_asked_about():
    rows = measured(dwells(*SINGLE, passes=2))
    milli = with_columns(rows, output_ug=1e-3 * rows.output_ug, output_u_ug=None)

    (asked,) = declared_fit(milli).observations.warnings
    assert asked.startswith("output_ug repeats to 0.00")
    assert "is it in mg" in asked
    assert document(close_vibration_loop(milli))["warnings"] == [asked]
    assert declared_fit(rows).observations.warnings == ()
