"""The simulated world as a whole: what is read, effect by effect, in virtual time."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tumble.drivers.clock import VirtualClock
from tumble.drivers.simulated import HeadOptions, Simulated, SimulatedStand, build, noise_free_voltage

CALM = {"wander_K": 0.0, "sensor_noise_K": 0.0}


def world(effects=None, base_path=None, **table) -> SimulatedStand:
    quiet = {"preset": "ideal", "resolution_v": 0.0, "temperature": CALM, "effects": effects or {}}
    return build(Simulated.model_validate(quiet | table), base_path=base_path)


def read_v(stand: SimulatedStand, angle_deg: float, wait_s: float = 30.0) -> float:
    stand.stand.positioners["head"].start_move(angle_deg)
    stand.stand.clock.sleep(wait_s)
    return float(stand.stand.samplers["daq"].acquire(100, 100.0).voltage_v.mean())


def tilt_deg(stand: SimulatedStand, angle_deg: float) -> float:
    """Angle error as an ideal unit feels it, by the arc sine of its output near the level."""
    return -float(np.rad2deg(np.arcsin(read_v(stand, angle_deg)))) - angle_deg


def test_the_published_unit_reads_its_published_values_at_the_x_poles():
    stand = build(Simulated.model_validate({"noise_v": 0.0, "temperature": CALM}))
    assert read_v(stand, -90.0) == pytest.approx(3.5 - 0.0098 * 0.0019565, abs=5e-6)
    assert read_v(stand, 90.0) == pytest.approx(1.5 + 0.0098 * 0.0019565, abs=5e-6)


def test_a_dwell_of_noise_scatters_as_stated():
    stand = world(noise_v=1e-3)
    stand.stand.positioners["head"].start_move(0.0)
    block = stand.stand.samplers["daq"].acquire(10000, 1000.0)
    assert block.voltage_v.std() == pytest.approx(1e-3, rel=0.03)
    assert block.voltage_v.mean() == pytest.approx(0.0, abs=4e-5)


def test_alpha0_adds_to_the_angle():
    assert tilt_deg(world(parameters={"alpha0_deg": 0.5}), 10.0) == pytest.approx(0.5)


def test_backlash_shows_after_a_move_back():
    stand = world({"backlash": 0.002})
    assert tilt_deg(stand, 10.0) == pytest.approx(0.0, abs=1e-9)
    assert tilt_deg(stand, 5.0) == pytest.approx(0.002)


def test_the_base_leans_by_the_hour():
    stand = world({"base_tilt_drift": 0.01})
    stand.stand.clock.sleep(7200.0 - 30.5)
    assert tilt_deg(stand, 0.0) == pytest.approx(0.02, abs=1e-6)


def test_a_tilted_axis_puts_gravity_on_oz():
    stand = world({"axis_tilt": 30.0}, parameters={"kx": 0.0, "kz": 1.0})
    assert read_v(stand, 45.0) == pytest.approx(0.5)


def test_misreading_lasts_for_one_dwell_however_often_it_is_acquired():
    stand = world({"misreading": {"rows": [2], "error_deg": 1.0}})
    assert tilt_deg(stand, 0.0) == pytest.approx(0.0, abs=1e-9)
    stand.stand.positioners["head"].start_move(-5.0)  # an approach without a dwell does not count
    stand.stand.clock.sleep(10.0)
    assert tilt_deg(stand, 10.0) == pytest.approx(1.0)
    again_v = stand.stand.samplers["daq"].acquire(1, 1.0).voltage_v[0]
    assert again_v == pytest.approx(-np.sin(np.deg2rad(11.0)))
    assert tilt_deg(stand, 20.0) == pytest.approx(0.0, abs=1e-9)


def test_each_mounting_has_its_own_small_angle():
    stand = world({"seating": 0.01})
    angles_deg = []
    for mounting in range(200):
        stand.world.seat("edge" if mounting % 2 else "face-up")
        angles_deg.append(tilt_deg(stand, 0.0))
    assert np.std(angles_deg) == pytest.approx(0.01, rel=0.15)


def test_a_unit_that_already_sits_so_is_left_alone():
    stand = world({"seating": 0.01})
    before_v = read_v(stand, 0.0)
    stand.world.seat("face-up")
    assert read_v(stand, 0.0) == before_v
    assert stand.world.mount == "face-up"


def test_a_mount_that_does_not_exist_is_refused():
    with pytest.raises(ValueError, match="no mount 'sideways'"):
        world().world.seat("sideways")


@pytest.mark.parametrize(
    ("mount", "expected_v"), [("face-up", -0.5), ("face-up-90", -0.8660254), ("end", 0.0), ("edge-back", -0.5)]
)
def test_the_mount_decides_what_ox_feels(mount, expected_v):
    stand = world()
    stand.world.seat(mount)
    assert read_v(stand, 30.0) == pytest.approx(expected_v, abs=1e-7)


def test_hysteresis_reads_lower_after_ax_rose():
    stand = world({"hysteresis": 1e-4})
    read_v(stand, 60.0)
    risen_v = read_v(stand, 0.0)
    read_v(stand, -60.0)
    fallen_v = read_v(stand, 0.0)
    assert (risen_v, fallen_v) == (pytest.approx(-1e-4), pytest.approx(1e-4))


def test_hysteresis_remembers_an_extremum_passed_on_the_way():
    stand = world({"hysteresis": 1e-4})
    read_v(stand, 50.0)
    rising_v = read_v(stand, 130.0)  # past 90 degrees, where ax is lowest
    assert rising_v == pytest.approx(-np.sin(np.deg2rad(130.0)) - 1e-4)


def test_hysteresis_follows_moves_at_whose_end_nothing_was_acquired():
    stand = world({"hysteresis": 1e-4})
    stand.stand.positioners["head"].start_move(60.0)
    stand.stand.clock.sleep(10.0)
    assert read_v(stand, 0.0) == pytest.approx(-1e-4)


def test_turn_on_draws_the_bias_anew():
    stand = world({"realisation_bias": 1e-3})
    biases_v = []
    for _ in range(300):
        stand.world.switch_on()
        biases_v.append(read_v(stand, 0.0, wait_s=1.0))
    assert np.std(biases_v) == pytest.approx(1e-3, rel=0.12)


def test_warm_up_goes_on_through_a_turn_on():
    stand = world({"warm_up": {"amplitude": 1.0, "tau_s": 900.0}})
    stand.stand.clock.sleep(1799.5 - 30.0)
    stand.world.switch_on()
    assert read_v(stand, 0.0) == pytest.approx(np.exp(-2.0), abs=1e-5)


def test_the_bias_follows_the_variance_of_the_samples_in_the_dwell():
    stand = world({"vibration_rectification": 1000.0}, noise_v=1e-3)
    biases_v, variances_v2 = [], []
    for _ in range(40):
        stand.stand.positioners["head"].start_move(0.0)
        block = stand.stand.samplers["daq"].acquire(4000, 4000.0)
        biases_v.append(block.voltage_v.mean())
        variances_v2.append(block.voltage_v.var())
    assert np.max(variances_v2) > 3.0 * np.min(variances_v2)
    assert np.polyfit(variances_v2, biases_v, 1)[0] == pytest.approx(1000.0, rel=0.05)


def test_the_noise_of_a_dwell_is_the_same_however_often_one_looked_in_the_dwell_before():
    blocks_v = []
    for looks in (1, 3):
        stand = world(noise_v=1e-3)
        for _ in range(looks):
            stand.stand.samplers["daq"].acquire(10, 100.0)
        stand.stand.positioners["head"].start_move(10.0)
        stand.stand.clock.sleep(10.0)
        blocks_v.append(stand.stand.samplers["daq"].acquire(100, 100.0).voltage_v.tolist())
    assert blocks_v[0] == blocks_v[1]


def test_every_look_in_a_dwell_has_noise_of_its_own():
    stand = world(noise_v=1e-3)
    first_v, second_v = (stand.stand.samplers["daq"].acquire(100, 100.0).voltage_v for _ in range(2))
    assert not np.any(first_v == second_v)


def test_the_vibration_level_is_that_of_the_dwell():
    stand = world(noise_v=1e-3, vibration_spread=2.0)
    first_v, second_v = (stand.stand.samplers["daq"].acquire(10000, 10000.0).voltage_v for _ in range(2))
    assert first_v.std() == pytest.approx(second_v.std(), rel=0.05)


def test_the_room_follows_its_ramp_and_the_unit_the_room():
    calm_ramp = CALM | {"start_degC": 20.0, "ramp_K_per_h": 2.0}
    stand = world({"bias_temperature": 1e-3}, temperature=calm_ramp)
    stand.stand.clock.sleep(3600.0)
    block = stand.stand.samplers["daq"].acquire(2, 1.0)
    assert block.temperature_degc == pytest.approx(22.0, abs=1e-3)
    assert block.voltage_v[0] == pytest.approx(-1e-3)


def test_the_thermometer_has_its_own_noise():
    stand = world(temperature={"wander_K": 0.0, "sensor_noise_K": 0.1})
    readings_degc = [stand.stand.samplers["daq"].acquire(1, 1.0).temperature_degc for _ in range(300)]
    assert np.std(readings_degc) == pytest.approx(0.1, rel=0.12)


def test_overload_is_shown_where_the_range_ends():
    stand = world(range_v=0.5)
    stand.stand.positioners["head"].start_move(-90.0)
    stand.stand.clock.sleep(30.0)
    assert stand.stand.samplers["daq"].acquire(2, 1.0).voltage_v.tolist() == [9.9e37, 9.9e37]


def test_external_physics_is_found_beside_the_stand_file(tmp_path: Path):
    (tmp_path / "physics.py").write_text(
        "def response(ax_g, ay_g, az_g, temperature_degC, time_s):\n    return 5.0 * ax_g\n"
        "def head_error(angle_deg, direction, time_s):\n    return 30.0 * direction\n"
    )
    stand = world(base_path=tmp_path, response="physics.py:response", head_error="physics.py:head_error")
    assert read_v(stand, 60.0) == pytest.approx(-5.0)
    assert read_v(stand, 30.0) == pytest.approx(0.0, abs=1e-12)


@settings(max_examples=20)
@given(st.integers(0, 2**64 - 1), st.lists(st.floats(-180.0, 760.0), min_size=1, max_size=4))
def test_the_same_seed_repeats_everything(seed, angles_deg):
    effects = {"seating": 0.01, "realisation_bias": 1e-3, "bias_random_walk": 1e-3, "vibration_rectification": 1.0}
    table = {"seed": seed, "flicker_v": 1e-4, "effects": effects}
    first, second = (build(Simulated.model_validate(table), clock=VirtualClock(0)) for _ in range(2))
    assert [read_v(first, angle) for angle in angles_deg] == [read_v(second, angle) for angle in angles_deg]


def test_a_world_goes_on_with_the_draws_where_another_stopped():
    effects = {"seating": 0.01, "realisation_bias": 1e-3, "bias_random_walk": 1e-3}
    table = {"noise_v": 1e-3, "flicker_v": 1e-4, "effects": effects}
    whole, rest = (build(Simulated.model_validate(table), clock=VirtualClock(0)) for _ in range(2))
    whole.world.seat("edge")
    whole.world.switch_on()
    read_v(whole, 90.0)
    for count, value in vars(whole.world.counts).items():
        setattr(rest.world.counts, count, value)
    rest.world.seat("edge")
    rest.world.counts.mountings = whole.world.counts.mountings
    rest.stand.positioners["head"].start_move(90.0)
    rest.stand.clock.sleep(whole.stand.clock.monotonic_s())
    assert read_v(rest, 45.0) == read_v(whole, 45.0)


def test_static_readings_need_no_run():
    table = {
        "preset": "ideal",
        "parameters": {"u0": 2.0, "alpha0_deg": 20.0},
        "effects": {
            "k_xx": 0.1,
            "backlash": 5.0,
            "bias_drift": 1.0,
            "warm_up": {"amplitude": 1.0, "tau_s": 60.0},
            "head_eccentricity": {"amplitude_deg": 10.0, "phase_deg": 90.0},
            "range_step": {"step": 0.5, "threshold_V": 2.5},
        },
    }
    mounts = ["face-up", "face-up-90", "face-up"]
    voltage_v = noise_free_voltage(Simulated.model_validate(table), mounts, [0.0, 0.0, 180.0])
    assert voltage_v == pytest.approx([2.0 - 0.5 + 0.025, 2.0 - 0.8660254 + 0.075, 2.0 + 0.1736482 + 0.0030154])


def test_static_readings_refuse_a_mount_that_does_not_exist():
    with pytest.raises(ValueError, match="no mount 'sideways'"):
        noise_free_voltage(Simulated(), ["sideways"], [0.0])


def test_the_stand_has_the_name_and_the_limits_that_it_is_given():
    stand = build(Simulated(), name="bench-1", head=HeadOptions(limits_deg=(-10.0, 10.0), speed_deg_s=5.0)).stand
    head = stand.positioners["head"]
    assert (stand.name, head.limits_deg, head.speed_deg_s) == ("bench-1", (-10.0, 10.0), 5.0)
