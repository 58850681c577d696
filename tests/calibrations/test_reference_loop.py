from dataclasses import replace

import numpy as np
import pytest
from head_tables import rests, stream

from tumble.calibrations.methods.head_reference.loop import close_reference_loop


def sine(angle_deg, order, amplitude_deg, phase_deg):
    return amplitude_deg * np.sin(np.deg2rad(order * angle_deg + phase_deg))


def named(loop):
    return sorted(effect.name for effect in loop.effects)


def quantity(loop, name, key):
    return next(effect for effect in loop.effects if effect.name == name).coefficients[key]


def test_a_head_with_nothing_but_an_offset_shows_no_effect():
    loop = close_reference_loop(rests(lambda a, d, t: 0.25 + 0 * a))
    assert (loop.effects, loop.unexplained) == ((), ())
    assert loop.augmented.parameters["offset"].value == pytest.approx(0.25, abs=5e-4)


@pytest.mark.parametrize("seed", range(40, 60))
def test_a_clean_head_is_left_alone(seed):
    loop = close_reference_loop(rests(lambda a, d, t: 0 * a, seed=seed))
    assert named(loop) == []


def test_once_twice_and_many_times_a_turn_are_told_apart():
    def error(a, d, t):
        return sine(a, 1, 0.02, 30) + sine(a, 2, 0.01, 200) + sine(a, 7, 0.005, 80)

    loop = close_reference_loop(rests(error))
    assert named(loop) == ["graduation", "head_eccentricity", "head_second_harmonic"]
    assert quantity(loop, "head_eccentricity", "amplitude_deg").value == pytest.approx(0.02, abs=5e-4)
    assert quantity(loop, "head_second_harmonic", "phase_deg").value == pytest.approx(200, abs=3)
    assert quantity(loop, "graduation", "order").value == 7


def test_backlash_is_what_differs_at_rest():
    loop = close_reference_loop(rests(lambda a, d, t: 0.01 * (d < 0)))
    assert named(loop) == ["backlash"]
    assert quantity(loop, "backlash", "backlash").value == pytest.approx(0.01, abs=4e-4)


def test_steps_per_degree_that_do_not_suit_the_drive_add_up_from_turn_to_turn():
    loop = close_reference_loop(rests(lambda a, d, t: -0.02 * a / 360.0, turns=2.0))
    assert named(loop) == ["head_scale"]
    assert quantity(loop, "head_scale", "head_scale").value == pytest.approx(-0.02, abs=5e-4)


def test_a_reference_that_drifts_differs_with_time_not_with_direction():
    loop = close_reference_loop(rests(lambda a, d, t: 0.05 * t / 3600.0))
    assert named(loop) == ["reference_drift"]


def test_a_reference_that_is_read_late_differs_with_speed_and_not_at_rest():
    loop = close_reference_loop(stream(lambda a, d, t: 0 * a, late_s=0.033))
    assert named(loop) == ["latency"]
    assert loop.effects[0].also_possible == ()
    assert quantity(loop, "latency", "latency").value == pytest.approx(0.033, abs=2e-4)
    assert loop.passes.before_deg == pytest.approx(2 * 0.033 * 30, rel=0.02)
    assert loop.passes.after_deg < 0.01


def test_at_one_speed_lateness_and_backlash_cannot_be_told_apart_and_another_speed_or_rests_would():
    table = stream(lambda a, d, t: 0 * a, late_s=0.033)
    moving = np.abs(np.abs(table.velocity_deg_s) - 30.0) < 1e-6
    loop = close_reference_loop(table.select(moving))
    (found,) = loop.effects
    assert {found.name, *found.also_possible} == {"latency", "backlash"}
    (experiment,) = loop.next_experiment
    assert experiment.programme in ("rests", "slow passes")
    assert loop.augmented.parameters["offset"].value is None


def test_a_large_error_of_the_head_that_is_seen_late_is_followed_where_it_was():
    loop = close_reference_loop(stream(lambda a, d, t: sine(a, 4, 5.0, 30), late_s=0.033))
    assert named(loop) == ["graduation", "latency"]
    assert loop.augmented.residual_rms < 5e-3


def test_the_wrap_of_the_reference_changes_nothing():
    def error(a, d, t):
        return 0.3 + sine(a, 1, 0.02, 30)

    plain, wrapped = (close_reference_loop(rests(error, wrap=wrap)) for wrap in (False, True))
    one, other = (quantity(loop, "head_eccentricity", "amplitude_deg").value for loop in (plain, wrapped))
    assert one == pytest.approx(other, rel=1e-9)


def test_single_wild_readings_of_the_reference_are_set_aside():
    table = rests(lambda a, d, t: sine(a, 1, 0.02, 30))
    reference_deg = table.reference_deg.copy()
    reference_deg[[20, 90]] += [0.5, -0.4]
    loop = close_reference_loop(replace(table, reference_deg=reference_deg))
    assert [entry.row for entry in loop.observations.set_aside] == [21, 91]
    assert named(loop) == ["head_eccentricity"]


def test_a_local_error_of_the_circle_has_no_name():
    loop = close_reference_loop(rests(lambda a, d, t: 0.02 * np.exp(-0.5 * ((a - 140.0) / 12.0) ** 2)))
    assert named(loop) == []
    assert loop.unexplained[0].depends_on == "angle"
    assert "near 140°" in loop.unexplained[0].description


@pytest.mark.parametrize(
    ("spoilt", "said"),
    [
        (lambda reference: -reference, "change its sign"),
        (np.deg2rad, "write it in degrees"),
        (lambda reference: 2 * reference, "it counts 2 turns for one"),
    ],
)
def test_a_reference_that_does_not_follow_the_head_is_asked_about(spoilt, said):
    table = rests(lambda a, d, t: 0 * a)
    loop = close_reference_loop(replace(table, reference_deg=spoilt(table.reference_deg)))
    assert said in loop.warnings[-1]
    assert (loop.effects, loop.unexplained) == ((), ())


def test_a_wild_reading_does_not_make_a_table_traced_that_must_be_asked_about():
    table = rests(lambda a, d, t: 0 * a, step_deg=1.0)
    wild = 170.0 * (np.arange(len(table)) == 20)
    loop = close_reference_loop(replace(table, reference_deg=wild - table.reference_deg))
    assert "change its sign" in loop.warnings[-1]
    assert (loop.effects, loop.unexplained) == ((), ())


def test_a_table_without_a_reference_is_refused():
    with pytest.raises(ValueError, match="no column reference_deg"):
        close_reference_loop(replace(rests(lambda a, d, t: 0 * a), reference_deg=None))
