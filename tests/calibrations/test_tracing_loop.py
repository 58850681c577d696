"""The loop closed on tables made from the contract's formulas."""

from dataclasses import replace

import numpy as np
import pytest
from tables import FLIPS, UNIT, gravity_on, output, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.questions import questioned

TWO_MOUNTS = (*FLIPS, sweep("face-up"), sweep("face-down"))
THREE_MOUNTS = (*TWO_MOUNTS, sweep("face-up-90"))


def k_xx(mount, angle_deg):
    return 4e-4 * gravity_on(mount, angle_deg)[0] ** 2


def bump(mount, angle_deg):
    """The head's angle is 0.02 degrees off near 141 degrees."""
    error_deg = 0.02 * np.exp(-0.5 * ((angle_deg % 360 - 141.0) / 8.0) ** 2)
    ax, _, _ = gravity_on(mount, angle_deg + error_deg)
    return ax - gravity_on(mount, angle_deg)[0]


def names(loop):
    return [effect.name for effect in loop.effects]


@pytest.fixture(scope="module")
def second_order():
    return close_loop(table(*THREE_MOUNTS, extra_v=k_xx))


def test_a_complete_model_leaves_nothing():
    loop = close_loop(table(*TWO_MOUNTS, seed=4))

    assert (loop.effects, loop.unexplained, loop.next_experiment) == ((), None, ())
    assert loop.augmented.parameters["kx"].value == loop.declared.parameters["kx"].value


def test_a_second_order_term_is_found_with_its_size(second_order):
    assert names(second_order) == ["k_xx"]
    found = second_order.effects[0].coefficients["k_xx"]
    assert abs(found.value - 4e-4) < 3 * found.standard_uncertainty


def test_with_the_effect_the_parameters_are_right_again(second_order):
    told = {name: p for name, p in second_order.augmented.parameters.items() if p.value is not None}
    assert {"kz", "kxy", "alpha0"} <= set(told)
    for name, parameter in told.items():
        assert abs(parameter.value - UNIT[name]) < 4 * parameter.standard_uncertainty


def test_the_error_on_held_out_rows_falls(second_order):
    assert second_order.augmented.held_out_rms_v < 0.95 * second_order.declared.held_out_rms_v
    assert second_order.declared.lack_of_fit_p < 1e-6 < second_order.augmented.lack_of_fit_p


def test_what_one_mount_cannot_part_is_said_with_what_would_part_it():
    loop = close_loop(table(*FLIPS, sweep("face-up"), extra_v=lambda m, a: 5 * k_xx(m, a)))
    possible = {loop.effects[0].name, *loop.effects[0].also_possible}

    assert {"k_xx", "k_yy"} <= possible
    assert loop.augmented.parameters["u0"].value is None
    assert any(experiment.command.startswith("tumble run --programme probe-") for experiment in loop.next_experiment)


def test_structure_without_a_name_is_put_down_to_its_variable():
    loop = close_loop(table(*TWO_MOUNTS, extra_v=bump))

    assert names(loop) == []
    assert loop.unexplained.depends_on == "angle"


def test_misread_rows_are_named_with_their_round_error():
    rows = table(*TWO_MOUNTS)
    wrong = np.array([40, 300])
    volts = rows.voltage_v.copy()
    true_deg = rows.angle_deg[wrong] + np.array([1.0, -0.5])
    for row, angle_deg in zip(wrong, true_deg, strict=True):
        mount = str(rows.mount[row])
        volts[row] = table((("sweep"), mount, [angle_deg]), realisations=1, noise_v=0.0).voltage_v[0]

    loop = close_loop(replace(rows, voltage_v=volts))

    assert [(entry.row, entry.error_deg) for entry in loop.misread] == [(41, 1.0), (301, -0.5)]
    assert names(loop) == ["misreading"]


def test_a_table_of_few_rows_is_not_traced():
    loop = close_loop(table(("sweep", "face-up", [0.0, 60.0, 120.0, 180.0, 240.0, 300.0]), realisations=1))

    assert loop.effects == ()


def asked(rows):
    (question,) = questioned(rows).questions
    return question


def test_angles_in_radians_are_asked_about_and_not_explained():
    rows = table(*TWO_MOUNTS)
    rows = replace(rows, angle_deg=np.deg2rad(rows.angle_deg))

    assert "are these radians?" in asked(rows)
    assert close_loop(rows).effects == ()


def test_a_missing_mount_column_is_asked_about():
    rows = replace(table(*THREE_MOUNTS), mount=None)

    assert "there is no column mount" in asked(rows)
    assert close_loop(rows).effects == ()


@pytest.mark.parametrize("rows_read", [100, 200, 332])
def test_a_missing_mount_column_is_asked_about_wherever_the_table_ends(rows_read):
    rows = replace(table(*TWO_MOUNTS, realisations=2), mount=None)

    assert "the rows cannot come from one mount" in asked(rows.select(np.arange(rows_read)))


def test_a_missing_mount_column_is_asked_about_where_only_the_sweeps_turn_back():
    there_and_back = [("sweep", mount, [*range(0, 390, 15), *range(390, -15, -15)]) for mount in ("face-up", "edge")]
    rows = replace(table(*there_and_back, realisations=2), mount=None, realisation=None, procedure=None)

    assert "the rows cannot come from one mount" in asked(rows)


@pytest.mark.parametrize(("rows_off", "by_v"), [(1, 1.0), (9, 0.05), (36, 0.05)])
def test_a_realisation_that_was_disturbed_is_no_other_mount(rows_off, by_v):
    rows = replace(table(("sweep", "face-up", np.arange(0.0, 360.0, 10.0))), mount=None)
    third = np.flatnonzero(rows.realisation == 3)[:rows_off]
    off_v = by_v * np.random.default_rng(20261128).normal(size=rows_off)
    time_s = 5.0 * np.arange(len(rows)) + 1000.0 * rows.realisation
    rows = replace(rows, time_s=time_s)
    rows.voltage_v[third] += off_v

    assert questioned(rows).questions == ()


def test_an_output_that_is_rounded_more_coarsely_than_it_scatters_is_asked_about():
    rows = table(*TWO_MOUNTS)

    assert "rounded to 0.01 V" in asked(replace(rows, voltage_v=np.round(rows.voltage_v, 2)))
    assert questioned(replace(rows, voltage_v=np.round(rows.voltage_v / 3e-4) * 3e-4)).questions == ()


def test_a_strong_warm_up_is_one_effect_with_the_time_constant_that_fits():
    """5 mV and 600 s in a run of 2150 s: two neighbours of the grid would fit it as well together."""
    rows = table(*TWO_MOUNTS)
    time_s = 2.5 * np.arange(len(rows))
    (effect,) = close_loop(
        replace(rows, time_s=time_s, voltage_v=rows.voltage_v + 5e-3 * np.exp(-time_s / 600.0))
    ).effects

    tau_s = effect.coefficients["tau_s"]
    assert effect.name == "warm_up"
    assert abs(tau_s.value - 600.0) < 3 * tau_s.standard_uncertainty < 30.0


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_a_warm_up_and_a_drift_are_not_taken_for_two_warm_ups(seed):
    """4 noise deviations within 150 s and 3 over the run: a slower warm-up beside it would fit them as well."""
    rows = table(*TWO_MOUNTS, seed=seed)
    time_s = 2.5 * np.arange(len(rows))
    slow_v = 4e-4 * np.exp(-time_s / 150.0) + 3e-4 * time_s / time_s[-1]
    loop = close_loop(replace(rows, time_s=time_s, voltage_v=rows.voltage_v + slow_v))
    low_v, high_v = loop.augmented.parameters["u0"].interval_95 or (-np.inf, np.inf)

    assert {name for effect in loop.effects for name in (effect.name, *effect.also_possible)} == {
        "warm_up",
        "bias_drift",
    }
    assert low_v < UNIT["u0"] < high_v


def test_a_bias_that_jumps_between_realisations_is_no_other_mount():
    rows = table(*FLIPS[:2], sweep("face-up"))
    jumps = np.array([5e-3, -2e-3, 0.0, 7e-3, -4e-3])[rows.realisation - 1]

    assert questioned(replace(rows, mount=None, voltage_v=rows.voltage_v + jumps)).questions == ()


def test_clear_repeats_are_taken_as_realisations():
    rows = replace(table(*TWO_MOUNTS, realisations=3), realisation=None)

    assert "every pose comes back 3 times" in asked(rows)
    assert set(questioned(rows).observations.realisation.tolist()) == {1, 2, 3}


def test_an_inverted_output_is_asked_about():
    rows = table(*TWO_MOUNTS)

    assert "inverted" in asked(replace(rows, voltage_v=5.0 - rows.voltage_v))


def test_a_head_that_was_never_turned_is_asked_about():
    rows = table(*TWO_MOUNTS[:1])

    assert "angle_deg is 0 in every row" in asked(replace(rows, angle_deg=np.zeros(len(rows))))


def test_a_time_that_runs_backwards_is_asked_about():
    rows = table(*TWO_MOUNTS)
    time_s = 2.5 * np.arange(len(rows))
    time_s[100] = 10.0

    assert "time_s runs backwards at row 101" in asked(replace(rows, time_s=time_s))


def test_millivolts_are_asked_about():
    rows = table(*TWO_MOUNTS)

    assert "are these millivolts?" in asked(replace(rows, voltage_v=1e3 * rows.voltage_v))


def test_a_table_that_says_what_it_is_is_asked_nothing():
    assert questioned(table(*THREE_MOUNTS)).questions == ()


def test_a_reading_that_is_late_while_the_head_moves_is_called_latency():
    rows = table(*TWO_MOUNTS, realisations=4, noise_v=0.0)
    velocity_deg_s = np.where(rows.procedure == "flip", 0.0, np.resize([10.0, -10.0, 20.0, -5.0], len(rows)))
    volts = np.concatenate(
        [
            output(mount, [angle_deg - 2e-3 * velocity])
            for mount, angle_deg, velocity in zip(rows.mount, rows.angle_deg, velocity_deg_s, strict=True)
        ]
    )
    volts += 1e-4 * np.random.default_rng(1).normal(size=len(rows))

    loop = close_loop(replace(rows, voltage_v=volts, velocity_deg_s=velocity_deg_s))

    (effect,) = loop.effects
    latency = effect.coefficients["latency"]
    assert (effect.name, effect.also_possible, effect.belongs_to, latency.unit) == ("latency", (), "daq", "s")
    assert abs(latency.value - 2e-3) < 3 * latency.standard_uncertainty < 1e-3


def test_an_output_that_never_changes_is_asked_about():
    rows = table(*TWO_MOUNTS)
    loop = close_loop(replace(rows, voltage_v=np.full(len(rows), 2.5)))

    assert names(loop) == []
    assert any("is the unit connected?" in warning for warning in loop.augmented.warnings)
    assert loop.not_traced


def test_too_few_rows_are_said_not_to_have_been_traced():
    loop = close_loop(table(*FLIPS, realisations=2))

    assert "12 rows are too few" in loop.not_traced


def test_a_bias_that_follows_the_vibration_is_found_where_one_dwell_was_shaken_most():
    """The row that is shaken most looks like a gross error until the effect is known."""
    rows = table(*TWO_MOUNTS)
    deviation_v = 4e-3 * np.exp(np.abs(np.random.default_rng(3).normal(0.0, 0.5, len(rows))))
    deviation_v[100] = 0.06
    loop = close_loop(
        replace(
            rows,
            voltage_sd_v=deviation_v,
            samples=np.full(len(rows), 100),
            voltage_v=rows.voltage_v + 8.0 * deviation_v**2,
        )
    )

    assert names(loop) == ["vibration_rectification"]
    assert loop.augmented.observations.set_aside == ()
    assert loop.declared.observations.set_aside == ()  # the error before and after is that of the same rows
