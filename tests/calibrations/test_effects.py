"""Effects as they are declared: columns with the contract's signs, coefficients under the contract's keys."""

import numpy as np
import pytest

from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.tracing.effect import contrasts, harmonic, spread

BY_NAME = {effect.name: effect for effect in CATALOGUE}
CONTRACT = {
    "k_xx", "k_yy", "k_zz", "k_xz", "k_yz", "k_xxx", "scale_asymmetry", "hysteresis", "bias_temperature",
    "scale_temperature", "bias_drift", "scale_drift", "warm_up", "realisation_bias", "vibration_rectification",
    "head_eccentricity", "head_second_harmonic", "graduation", "backlash", "axis_tilt", "base_tilt_drift", "seating",
    "settling", "daq_nonlinearity", "range_step", "latency",
}  # fmt: skip


def scene(angle_deg, **columns):
    """A nominal unit, 1 V/g on the x axis, face-up unless told otherwise."""
    angle_deg = np.asarray(angle_deg, dtype=float)
    rows = Observations(row=np.arange(1, len(angle_deg) + 1), angle_deg=angle_deg, **columns)
    radians = np.deg2rad(angle_deg)
    return Scene(
        observations=rows,
        alpha0_deg=0.0,
        output_v=2.5 - np.sin(radians),
        slope_v_per_deg=np.deg2rad(-np.cos(radians)),
        response_v_per_g=np.array([1.0, 0.0, 0.0]),
    )


def column(name, *arguments, **columns):
    (form,) = BY_NAME[name].forms(scene(*arguments, **columns))
    return form.columns[:, 0].tolist()


def test_every_effect_of_the_contract_that_is_a_column_is_in_the_catalogue():
    assert set(BY_NAME) == CONTRACT


def test_no_name_stands_twice():
    assert len(BY_NAME) == len(CATALOGUE)


def test_second_order_terms_are_products_of_projections():
    assert column("k_xx", [-90.0, 0.0]) == pytest.approx([1.0, 0.0], abs=1e-12)
    assert column("k_yy", [-90.0, 0.0]) == pytest.approx([0.0, 1.0], abs=1e-12)


def test_backlash_turns_the_angle_after_moves_in_minus_direction_only():
    assert column("backlash", [0.0, 0.0], direction=np.array([1, -1])) == pytest.approx([0.0, np.deg2rad(-1.0)])


def test_settling_leaves_a_part_of_the_reading_before_but_not_over_a_new_mount():
    found = column("settling", [-90.0, 90.0, 90.0], mount=np.array(["face-up", "face-up", "face-down"]))

    assert found == pytest.approx([0.0, 2.0, 0.0])


@pytest.mark.parametrize(("time_s", "left"), [([0.0, 3.0, 9.0], [0.0, 1.0, 1.0]), ([0.0, 3.0, 603.0], [0.0, 1.0, 0.0])])
def test_settling_leaves_a_part_over_the_beginning_of_a_run_that_followed_at_once(time_s, left):
    found = column("settling", [0.0, 90.0, 0.0], time_s=np.array(time_s), run=np.array([0, 0, 1]))
    assert np.abs(found).tolist() == pytest.approx(left)


def test_where_no_time_is_known_a_run_begins_after_a_pause():
    assert column("settling", [0.0, 90.0, 0.0], run=np.array([0, 0, 1]))[2] == 0.0


def test_settling_leaves_nothing_over_a_pause():
    assert BY_NAME["settling"].forms(scene([-90.0, 90.0], time_s=np.array([0.0, 100.0]))) == ()


def test_a_late_reading_is_that_of_the_angle_before():
    moving = np.array([10.0, -10.0, 0.0])

    # one second late at 0°, where ax falls by 1° in g per degree: 10° less, 10° more, nothing
    assert column("latency", [0.0, 0.0, 0.0], velocity_deg_s=moving) == pytest.approx(np.deg2rad([10.0, -10.0, 0.0]))


def test_a_head_at_rest_has_no_latency():
    assert BY_NAME["latency"].forms(scene([0.0, 5.0])) == ()
    assert BY_NAME["latency"].forms(scene([0.0, 5.0], velocity_deg_s=np.zeros(2))) == ()


def test_axis_tilt_is_felt_by_the_axis_that_lies_along_the_head():
    found = column("axis_tilt", [0.0, 0.0], mount=np.array(["end", "face-up"]))

    assert found == pytest.approx([np.deg2rad(1.0), 0.0])


def test_temperature_effects_refer_to_the_reference():
    assert column("bias_temperature", [0.0, 0.0], temperature_degc=np.array([23.0, 25.0])) == pytest.approx([0.0, 2.0])


def test_what_the_table_does_not_say_offers_no_form():
    bare = scene([0.0, 5.0, 10.0])

    for name in ("bias_drift", "bias_temperature", "warm_up", "vibration_rectification", "seating", "realisation_bias"):
        assert BY_NAME[name].forms(bare) == ()


def test_a_play_lags_by_its_half_gap_once_the_slack_is_taken_up():
    moved = scene(np.concatenate([np.arange(0.0, 91.0, 10.0), np.arange(80.0, -1.0, -10.0)]))
    stand = moved.play(0.05)

    assert stand[5] == pytest.approx(1.0)  # ax has fallen: higher
    assert stand[-3] == pytest.approx(-1.0)  # ax has risen: lower


def test_a_play_remembers_an_extremum_between_two_poses():
    over_the_pole = scene([60.0, 120.0])

    assert over_the_pole.play(0.02)[1] == pytest.approx(-1.0)  # ax fell to -1 and rose again


def test_a_play_begins_in_its_middle_in_every_mount():
    mounts = np.array(["face-up", "face-up", "end", "end", "face-up"])
    remounted = scene([0.0, 40.0, 40.0, 80.0, 80.0], mount=mounts)

    assert remounted.play(0.05).tolist() == pytest.approx([0.0, 1.0, 0.0, 0.0, 0.0], abs=1e-12)


def test_a_play_may_keep_where_it_stood_while_the_unit_is_mounted_anew():
    """Ax goes from -0.64 to 0, and from there to -0.98: it has risen, then fallen."""
    mounts = np.array(["face-up", "face-up", "end", "end", "face-up"])
    remounted = scene([0.0, 40.0, 40.0, 80.0, 80.0], mount=mounts)

    assert remounted.play_kept(0.05).tolist() == pytest.approx([0.0, 1.0, -1.0, -1.0, 1.0])


def test_a_play_goes_on_from_where_the_head_stood_before_the_mount():
    """The head turned from 40° to 80°, which of the two came first nobody knows; ax fell on the way."""
    turned = scene([0.0, 40.0, 80.0], mount=np.array(["end", "end", "face-up"]))

    assert turned.play(0.05)[2] == pytest.approx(1.0)


def test_a_harmonic_is_reported_as_amplitude_and_phase():
    reported = harmonic(None, np.array([0.0, 2.0]), np.diag([0.01, 0.04]))

    assert reported["amplitude_deg"].value == pytest.approx(2.0)
    assert reported["amplitude_deg"].standard_uncertainty == pytest.approx(0.2)
    assert reported["phase_deg"].value == pytest.approx(90.0)
    assert reported["phase_deg"].standard_uncertainty == pytest.approx(np.rad2deg(0.05))


@pytest.mark.parametrize("levels", [2, 5])
def test_contrasts_are_orthonormal_and_free_of_a_mean(levels):
    matrix = contrasts(levels)

    assert matrix.T @ matrix == pytest.approx(np.eye(levels - 1))
    assert matrix.sum(axis=0) == pytest.approx(np.zeros(levels - 1), abs=1e-12)


def test_levels_are_reported_as_their_standard_deviation():
    levels = np.array([-1.0, 0.0, 1.0])
    coefficients = contrasts(3).T @ levels

    assert spread("seating", "deg")(None, coefficients, np.zeros((2, 2)))["seating"].value == pytest.approx(1.0)


def test_without_the_column_the_direction_is_that_of_the_angles_over_a_change_of_mount_too():
    mount = np.repeat(["face-up", "face-down"], 3)

    assert scene([0.0, 10.0, 20.0, 20.0, 10.0, 30.0], mount=mount).direction.tolist() == [0, 1, 1, 1, -1, 1]
