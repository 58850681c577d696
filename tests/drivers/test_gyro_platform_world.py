"""The world of a gyro platform, against the equations of the digest and rotations of SciPy."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tumble.drivers.clock import VirtualClock
from tumble.drivers.simulated.gyro_platform.settings import SimulatedPlatform
from tumble.drivers.simulated.gyro_platform.world import PlatformWorld
from tumble.drivers.simulated.worlds import Surroundings

EARTH_DEG_H = 15.041068
SINE_OF_A_TENTH = np.sin(np.deg2rad(0.1))
QUIET = {
    "noise": {"angle_random_walk_deg_sqrt_h": 0.0},
    "azimuth_noise": {"angle_random_walk_deg_sqrt_h": 0.0},
    "tilt_noise_deg": 0.0,
    "resolution_deg_h": 0.0,
    "resolution_deg": 0.0,
    "temperature": {"wander_K": 0.0, "sensor_noise_K": 0.0},
    "drift_deg_h": 0.0,
    "azimuth_drift_deg_h": 0.0,
    "levelling_tau_s": 0.1,
}
LEANING = {"alpha0_deg": 28.0, "leans_deg": [[5.0, -4.0], [-2.0, 3.0]], "latitude_deg": 50.45}


def made(**settings):
    clock = VirtualClock(wall_start_ns=0)
    return PlatformWorld(SimulatedPlatform.model_validate(QUIET | settings), Surroundings(clock=clock)), clock


def go(world, clock, angle_deg, rest_s=20.0):
    """Turn there, and wait until it has settled."""
    world.head.start_move(angle_deg)
    clock.sleep(200.0 + rest_s)


def means(world, samples=10, rate_hz=10.0):
    return {name: float(values.mean()) for name, values in world.meter(()).take(samples, rate_hz).channels.items()}


def at(angle_deg, **settings):
    """Means of the channels at a position that was reached in + direction."""
    world, clock = made(**settings)
    go(world, clock, -200.0)
    go(world, clock, angle_deg)
    return means(world)


def attitude(angle_deg, gamma_deg, kappa_deg, alpha0_deg):
    """From the levelled platform to east, north and up."""
    base = Rotation.from_euler("ZYX", [alpha0_deg, gamma_deg, kappa_deg], degrees=True)
    table = base * Rotation.from_euler("z", angle_deg, degrees=True)
    _, y, z = table.as_matrix()[2]
    return table * Rotation.from_euler("x", -np.arctan2(y, z))


@pytest.mark.parametrize("angle_deg", [0.0, 90.0, 180.0, -37.0, 270.0])
def test_the_channels_are_the_earths_rate_seen_from_a_levelled_platform(angle_deg):
    earth = EARTH_DEG_H * np.array([0.0, np.cos(np.deg2rad(50.45)), np.sin(np.deg2rad(50.45))])
    turned = attitude(angle_deg, 5.0, -4.0, 28.0)
    rate = turned.inv().apply(earth)
    seen = at(angle_deg, **LEANING)
    assert seen["levelling_rate_deg_h"] == pytest.approx(rate[0], abs=1e-9)
    assert seen["azimuth_rate_deg_h"] == pytest.approx(rate[2], abs=1e-4)  # off level by S τ
    assert seen["tilt_gamma_deg"] == pytest.approx(np.rad2deg(np.arcsin(-turned.as_matrix()[2, 0])), abs=1e-9)
    assert seen["tilt_beta_deg"] == pytest.approx(-0.1 * rate[0] / 3600.0, abs=1e-9)


@pytest.mark.parametrize("angle_deg", [0.0, 90.0, 213.0])
def test_the_reported_rate_is_that_of_the_digest_once_the_vertical_part_is_taken_off(angle_deg):
    """S = ωη (P cos δ + Q sin δ) + ω, P and Q by the tilts at 0° and 90°."""
    tilt = {place: np.deg2rad(at(place, **LEANING)["tilt_gamma_deg"]) for place in (0.0, 90.0)}
    alpha0, delta, latitude = np.deg2rad([28.0, angle_deg, 50.45])
    kappa = np.arcsin(-np.sin(tilt[90.0]) / np.cos(tilt[0.0]))
    p = np.sin(alpha0) * np.cos(tilt[0.0])
    q = np.cos(alpha0) * np.cos(kappa) + np.sin(alpha0) * np.sin(tilt[0.0]) * np.sin(kappa)
    seen = at(angle_deg, **LEANING, **{"drift_deg_h": 2.0})
    vertical = EARTH_DEG_H * np.sin(latitude) * np.sin(np.deg2rad(seen["tilt_gamma_deg"]))
    expected = EARTH_DEG_H * np.cos(latitude) * (p * np.cos(delta) + q * np.sin(delta)) + 2.0
    assert seen["levelling_rate_deg_h"] + vertical == pytest.approx(expected, abs=1e-9)


LEVEL = {"alpha0_deg": 90.0, "leans_deg": [[0.0, 0.0]], "latitude_deg": 0.0}
"""At pickoff 0 the levelling axis points west of north by 90°, and the rate is the whole of the earth's."""


@pytest.mark.parametrize(
    ("effect", "angle_deg", "added"),
    [
        ({"torquer_scale": 1e-3}, 0.0, 1e-3 * EARTH_DEG_H),
        ({"torquer_asymmetry": 1e-3}, 180.0, 1e-3 * EARTH_DEG_H),
        ({"torquer_square": 1e-5}, 180.0, 1e-5 * EARTH_DEG_H**2),
        ({"latitude": 60.0}, 0.0, -0.5 * EARTH_DEG_H),
        ({"pickoff_eccentricity": {"amplitude_deg": 0.1}}, 90.0, -EARTH_DEG_H * SINE_OF_A_TENTH),
        ({"pickoff_second_harmonic": {"amplitude_deg": 0.1, "phase_deg": 90.0}}, 90.0, EARTH_DEG_H * SINE_OF_A_TENTH),
        ({"pickoff_graduation": {"order": 3, "amplitude_deg": 0.1}}, 90.0, EARTH_DEG_H * SINE_OF_A_TENTH),
        ({"pickoff_scale": 0.01}, 90.0, -EARTH_DEG_H * np.sin(np.deg2rad(0.9))),
        ({"misreading": {"rows": [1], "error_deg": 2.0}}, 90.0, -EARTH_DEG_H * np.sin(np.deg2rad(2.0))),
    ],
)  # fmt: skip
def test_an_effect_changes_the_rate_as_the_catalogue_says(effect, angle_deg, added):
    changed = at(angle_deg, **LEVEL, effects=effect)["levelling_rate_deg_h"]
    assert changed - at(angle_deg, **LEVEL)["levelling_rate_deg_h"] == pytest.approx(added, abs=1e-9)


@pytest.mark.parametrize(
    ("effect", "added"),
    [
        ({"drift_ramp": 2.0}, 2.0),
        ({"drift_warm_up": {"amplitude": 3.0, "tau_s": 3600.0}}, 3.0 * np.exp(-1.0)),
        ({"drift_temperature": 0.5}, 0.5),
        ({"g_unbalance": 10.0}, 10.0 * np.sin(np.deg2rad(5.0))),
        ({"base_yaw": 1.0}, 0.0),
    ],
)
def test_what_drifts_is_added_by_the_hour(effect, added):
    def rate(**settings):
        room = {"start_degC": 24.0, "wander_K": 0.0, "sensor_noise_K": 0.0}
        world, clock = made(leans_deg=[[5.0, 0.0]], alpha0_deg=90.0, temperature=room, **settings)
        clock.sleep(3600.0)
        return means(world, 2, 1e3)["levelling_rate_deg_h"]

    assert rate(effects=effect) - rate() == pytest.approx(added, abs=2e-3)


def test_tilts_are_told_with_their_scale_and_bias():
    seen = at(0.0, **LEANING, effects={"tilt_scale": 0.01, "tilt_bias": 0.1})
    assert seen["tilt_gamma_deg"] == pytest.approx(5.0 * 1.01 + 0.1, abs=1e-9)


def test_backlash_shows_after_a_move_in_minus_direction():
    def rate(come_from_deg):
        world, clock = made(**LEVEL, effects={"backlash": 0.1})
        go(world, clock, come_from_deg)
        go(world, clock, 90.0)
        return means(world)["levelling_rate_deg_h"]

    assert rate(100.0) - rate(80.0) == pytest.approx(-EARTH_DEG_H * SINE_OF_A_TENTH, abs=1e-9)


def test_a_part_of_the_last_dwells_rate_remains():
    world, clock = made(**LEVEL, effects={"settling": 0.1})
    before = means(world)["levelling_rate_deg_h"]
    go(world, clock, 180.0)
    assert means(world)["levelling_rate_deg_h"] == pytest.approx(-before + 0.1 * 2.0 * before, abs=1e-9)


def lag_deg_h(tau_s, wait_s):
    """How much the rate still differs from that at rest, after a quarter turn on a leaning base."""
    settings = {**LEANING, "levelling_tau_s": tau_s, "range_deg_h": 1e6}
    world, clock = made(**settings)
    world.head.start_move(90.0)
    clock.sleep(90.0 / world.head.speed_deg_s + wait_s)
    return means(world, 1)["levelling_rate_deg_h"] - at(90.0, **settings)["levelling_rate_deg_h"]


def test_the_loop_lags_behind_a_turn_and_settles_with_its_time_constant():
    assert abs(lag_deg_h(2.0, 0.0)) > 1000.0
    assert lag_deg_h(2.0, 4.0) / lag_deg_h(2.0, 0.0) == pytest.approx(np.exp(-2.0), rel=1e-6)
    assert abs(lag_deg_h(2.0, 40.0)) < 1e-4


def test_the_lag_is_that_of_the_loops_differential_equation():
    """τ S' + S = f in very small steps, f being what would keep the platform level."""
    tau_s, speed_deg_s, steps = 2.0, 9.0, 100_000
    angles_deg = np.linspace(0.0, 90.0, steps + 1)
    step_s = 10.0 / steps
    base = Rotation.from_euler("ZYX", [28.0, 5.0, -4.0], degrees=True)
    table = base * Rotation.from_euler("z", angles_deg[:, np.newaxis], degrees=True)
    axes = table.as_matrix()
    earth = EARTH_DEG_H * np.array([0.0, np.cos(np.deg2rad(50.45)), np.sin(np.deg2rad(50.45))])
    rest = axes[:, :, 0] @ earth
    level_deg = -np.rad2deg(np.arctan2(axes[:, 2, 1], axes[:, 2, 2]))
    followed = (rest[1:] + rest[:-1]) / 2.0 + np.diff(level_deg) / step_s * 3600.0
    rate = rest[0]
    for value in followed.tolist():
        rate += (value - rate) * (1.0 - np.exp(-step_s / tau_s))
    assert speed_deg_s == 9.0
    assert lag_deg_h(2.0, 0.0) == pytest.approx(rate - rest[-1], rel=1e-4)


def test_another_lean_settles_too():
    world, clock = made(**LEANING)
    go(world, clock, 0.0)
    world.setters["base"]("2")
    clock.sleep(20.0)
    assert means(world)["tilt_gamma_deg"] == pytest.approx(-2.0, abs=1e-9)


def test_a_lean_that_is_not_listed_is_drawn_from_the_seed():
    tilts = []
    for _ in range(2):
        world, clock = made(**LEANING)
        world.setters["base"]("3")
        clock.sleep(20.0)
        tilts.append(means(world)["tilt_gamma_deg"])
    assert tilts[0] == tilts[1]
    assert 0.0 < abs(tilts[0]) <= 3.0


@pytest.mark.parametrize("number", ["0", "-1", "high"])
def test_a_lean_that_is_no_number_is_refused(number):
    world, _ = made(**LEANING)
    with pytest.raises(ValueError, match=f"{number} is no number of a lean; they count from 1"):
        world.setters["base"](number)


def test_a_channel_that_the_platform_lacks_is_refused():
    world, _ = made()
    with pytest.raises(ValueError, match="has no channel u_x_v; it has levelling_rate_deg_h, azimuth_rate_deg_h"):
        world.meter(("u_x_v",))


def test_white_noise_is_that_of_the_angle_random_walk_at_any_rate():
    """N = 0.001 °/√h: a mean over 10 s has 0.001 / √(10 / 3600) = 0.019 °/h."""
    for rate_hz in (10.0, 100.0):
        world, _ = made(noise={"angle_random_walk_deg_sqrt_h": 1e-3})
        values = world.meter(()).take(20_000, rate_hz).channels["levelling_rate_deg_h"]
        expected = 1e-3 * np.sqrt(3600.0 * rate_hz)
        assert values.std() == pytest.approx(expected, rel=0.02)


def test_correlated_drift_has_its_variance_and_its_memory():
    noise = {"angle_random_walk_deg_sqrt_h": 0.0, "gauss_markov_deg_h": 0.2, "correlation_s": 50.0}
    world, _ = made(noise=noise)
    values = world.meter(()).take(40_000, 1.0).channels["levelling_rate_deg_h"]
    centred = values - values.mean()
    correlation = (centred[50:] * centred[:-50]).mean() / centred.var()
    assert values.std() == pytest.approx(0.2, rel=0.1)
    assert correlation == pytest.approx(np.exp(-1.0), abs=0.1)


def test_the_drift_does_not_depend_on_when_it_was_asked():
    noise = {"angle_random_walk_deg_sqrt_h": 0.0, "gauss_markov_deg_h": 0.2, "bias_instability_deg_h": 0.01}
    seen = []
    for stops_s in ((), (100.0, 777.7, 5000.0)):
        world, clock = made(noise=noise, effects={"drift_random_walk": 0.1})
        for stop_s in stops_s:
            clock.sleep(stop_s - clock.monotonic_s())
            means(world, 2)
        clock.sleep(9000.0 - clock.monotonic_s())
        seen.append(means(world, 2)["levelling_rate_deg_h"])
    assert seen[0] == pytest.approx(seen[1], abs=1e-12)


def test_a_rate_beyond_the_range_is_an_overload():
    world, clock = made(**LEANING, range_deg_h=50.0)
    world.head.start_move(90.0)
    clock.sleep(5.0)
    assert world.meter(()).take(1, 10.0).channels["levelling_rate_deg_h"][0] == 9.9e37


def test_what_was_put_back_goes_on_as_if_nothing_had_happened():
    noise = {"angle_random_walk_deg_sqrt_h": 1e-3, "gauss_markov_deg_h": 0.2}
    whole, clock = made(noise=noise)
    clock.sleep(500.0)
    means(whole)
    cut, cut_clock = made(noise=noise)
    cut_clock.sleep(500.0)
    counts = type(cut.counts)(**vars(cut.counts))
    means(cut)
    cut_clock.sleep(300.0)
    cut.put_back(counts, 300.0)
    whole_again, again_clock = made(noise=noise)
    again_clock.sleep(500.0)
    assert means(cut)["levelling_rate_deg_h"] == pytest.approx(means(whole_again)["levelling_rate_deg_h"], abs=1e-9)
