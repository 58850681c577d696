"""The world of vibration: what the digest's equations say of the mean of its samples over whole periods."""

import numpy as np
import pytest

from tumble.drivers.clock import VirtualClock
from tumble.drivers.excitation import REST, excitation_of
from tumble.drivers.simulated.vibration.settings import SimulatedVibration
from tumble.drivers.simulated.vibration.world import VibrationWorld
from tumble.drivers.simulated.worlds import Surroundings

QUIET = {
    "noise_ug": 0.0,
    "reference_noise_ug": 0.0,
    "resolution_v": 0.0,
    "temperature": {"wander_K": 0.0, "sensor_noise_K": 0.0},
    "parameters": {"bias": 0.0, "k_ii": 0.0, "k_oo": 0.0, "k_pp": 0.0, "k_io": 0.0, "k_ip": 0.0},
}
SINE = "sine 10 g 80 Hz"


def world(parameters=(), effects=(), **settings):
    given = QUIET | settings | {"parameters": {**QUIET["parameters"], **dict(parameters)}, "effects": dict(effects)}
    made = VibrationWorld(
        SimulatedVibration.model_validate({"world": "vibration", **given}), Surroundings(clock=VirtualClock())
    )
    made.exciter.options = made.exciter.options.model_copy(update={"arm_m": 0.5})
    return made


def mean_ug(made, text=SINE, *, samples=2000, rate_hz=1000.0):
    """Rectification: the mean over whole periods, above the mean at rest."""
    meter = made.meter(())
    made.exciter.make_safe()
    rest_g = meter.acquire(samples, rate_hz).channels["output_v"].mean()
    made.exciter.drive(excitation_of(text))
    return 1e6 * (meter.acquire(samples, rate_hz).channels["output_v"].mean() - rest_g)


@pytest.mark.parametrize(
    ("mounting", "coefficient"),
    [
        ("x along i, y along o, p down", {"k_ii": 1.0}),
        ("x along o, y along p, p down", {"k_oo": 1.0}),
        ("x along p, y along i, o down", {"k_pp": 1.0}),
        ("x along i+o, y along i-o, p down", {"k_ii": 0.5, "k_oo": 0.5, "k_io": 0.5}),
        ("x along i+p, y along i-p, o down", {"k_ii": 0.5, "k_pp": 0.5, "k_ip": 0.5}),
    ],
)
def test_a_shaker_rectifies_by_half_the_square_of_its_peak(mounting, coefficient):
    values = {"k_ii": 20.0, "k_oo": -6.0, "k_pp": 9.0, "k_io": 14.0, "k_ip": -8.0}
    expected = 50.0 * sum(values[name] * part for name, part in coefficient.items())
    assert mean_ug(world(values, mounting=mounting)) == pytest.approx(expected, abs=1e-3)


def test_the_cubic_along_gravity_and_the_quartic():
    along = world(effects={"k_iii": 0.4}, mounting="x along i, y along o, i down")
    assert mean_ug(along) == pytest.approx(1.5 * 0.4 * 100.0, abs=1e-3)
    assert mean_ug(world(effects={"k_iiii": 0.01})) == pytest.approx(0.375 * 0.01 * 1e4, abs=1e-3)


def test_harmonics_make_no_offset_but_by_the_square_and_the_cube():
    distorted = {"second": 0.1, "second_phase_deg": 90.0}
    assert mean_ug(world(distortion=distorted)) == pytest.approx(0.0, abs=1e-6)
    assert mean_ug(world({"k_ii": 20.0}, distortion=distorted)) == pytest.approx(20.0 * 0.5 * 101.0, abs=1e-2)
    cubic = mean_ug(world(effects={"k_iii": 0.4}, distortion=distorted))
    assert cubic == pytest.approx(-0.75 * 0.4 * 100.0 * 1.0, abs=1e-3)


def test_a_cut_period_leaves_its_offset():
    assert abs(mean_ug(world(), samples=60_012)) < 663.0 + 1.0
    assert max(abs(mean_ug(world(), samples=1000 + cut)) for cut in range(1, 12)) > 10_000.0


@pytest.mark.parametrize(("phase_deg", "cosine"), [(0.0, 1.0), (90.0, 0.0), (180.0, -1.0)])
def test_shakers_of_one_frequency_tell_the_cross_term_by_their_phase(phase_deg, cosine):
    made = world({"k_io": 14.0})
    shaken = mean_ug(made, f"sine x 5 g 80 Hz 0 deg, y 4 g 80 Hz {phase_deg:g} deg")
    assert shaken == pytest.approx(14.0 * 0.5 * 20.0 * cosine, abs=1e-3)


def test_shakers_of_two_frequencies_tell_squares_only():
    assert mean_ug(world({"k_io": 14.0}), "sine x 5 g 80 Hz 0 deg, y 4 g 60 Hz 0 deg") == pytest.approx(0.0, abs=1e-3)


def test_sideways_motion_rectifies_with_the_cross_term():
    made = world({"k_io": 14.0}, {"shaker_cross": {"ratio": 0.05}})
    assert mean_ug(made) == pytest.approx(14.0 * 0.05 * 50.0, abs=1e-3)


def test_random_vibration_rectifies_by_its_mean_square():
    made, text = world({"k_ii": 20.0}), "random 20 Hz 0.01, 400 Hz 0.01"
    made.exciter.drive(excitation_of(text))
    block = made.meter(()).acquire(10_000, 1000.0).channels
    square_g2 = float(np.var(block["reference_x_v"] / 0.1))
    assert square_g2 == pytest.approx(excitation_of(text).rms_g ** 2, rel=0.1)
    linear = block["output_v"] - block["reference_x_v"] / 0.1
    assert 1e6 * linear.mean() == pytest.approx(20.0 * square_g2, rel=1e-3)


def test_a_double_centrifuge_tells_the_sum_and_its_arm():
    made = world({"k_ii": 20.0, "k_pp": 9.0, "k_ip": -8.0}, mounting="x along i, y along p, o down")
    level_g = 0.5 * 100.0 / 9.80665
    turned = mean_ug(made, f"rotation 10 {2 * np.pi:.12g}")
    assert turned == pytest.approx(0.5 * 29.0 * level_g**2, abs=1e-2)
    away = world(effects={"spin": {"mm": 0.1}}, mounting="x along i, y along p, o down")
    assert mean_ug(away, f"rotation 10 {16 * np.pi:.12g}") == pytest.approx(37_000.0, rel=0.01)  # the digest: 37 mg
    assert mean_ug(away, "rotation 10 -10", samples=62_832, rate_hz=10_000.0) == pytest.approx(
        0.0, abs=20.0
    )  # of a cut period


def test_a_leaning_table_and_pick_up_go_with_the_level():
    assert mean_ug(world(effects={"table_lean": 3.0})) == pytest.approx(3.0 * 50.0, abs=1e-3)
    turned = world(effects={"table_lean": 3.0}, mounting="x along -i, y along o, p down")
    assert mean_ug(turned) == pytest.approx(-3.0 * 50.0, abs=1e-3)
    assert mean_ug(world(effects={"drive_pickup": 2.0})) == pytest.approx(2.0 * 10.0, abs=1e-3)


def test_heat_comes_and_goes_with_the_power_of_the_drive():
    made = world(effects={"thermal_shift": {"amplitude": 1.0, "tau_s": 100.0}})
    meter = made.meter(())
    made.exciter.drive(excitation_of(SINE))
    made.clock.sleep(100.0)
    made.exciter.make_safe()
    warm, cooler = (1e6 * meter.acquire(100, 100.0).channels["output_v"].mean() for _ in range(2))
    made.clock.sleep(1000.0)
    assert warm == pytest.approx(50.0 * (1.0 - np.exp(-1.0)), rel=0.01)
    assert cooler == pytest.approx(warm * np.exp(-0.01), rel=1e-4)
    assert 1e6 * meter.acquire(100, 100.0).channels["output_v"].mean() == pytest.approx(0.0, abs=0.01)


def test_a_resonance_is_felt_by_the_unit_and_not_by_the_reference():
    made = world({"k_ii": 20.0}, {"frequency_response": {"natural_hz": 160.0}})
    assert mean_ug(made) == pytest.approx(20.0 * 50.0 / 0.75**2, rel=1e-4)
    assert 1e3 * float(
        made.meter(("reference_x_v",)).acquire(2000, 1000.0).channels["reference_x_v"].std()
    ) == pytest.approx(707.1, abs=0.1)


def test_the_output_stops_at_its_limit():
    made = world(effects={"clipping": {"limit_g": 8.0}})
    c = 0.8
    expected = -(1e6 / np.pi) * (10.0 * np.sqrt(1.0 - c**2) - 8.0 * np.arccos(c))
    assert mean_ug(made, "sine 10 g 7.97 Hz", samples=100_000, rate_hz=797.0) == pytest.approx(expected, rel=2e-3)


def test_a_step_stays_to_the_end_of_the_mounting():
    made = world(effects={"after_shift": {"step": 30.0, "row": 2}})
    meter, found = made.meter(()), []
    for text in ("rest", SINE, "rest", SINE):
        made.exciter.set(excitation_of(text), on=text != "rest")
        found.append(round(1e6 * meter.acquire(2000, 1000.0).channels["output_v"].mean(), 3))
    made.setters["mount"]("x along i, y along p, p down")
    made.exciter.make_safe()
    found.append(round(1e6 * meter.acquire(2000, 1000.0).channels["output_v"].mean(), 3))
    assert found == pytest.approx([0.0, 0.0, 30.0, 30.0, 0.0], abs=1e-3)


def test_every_draw_belongs_to_its_dwell_and_look():
    blocks = []
    for _ in range(2):
        made = world(noise_ug=100.0)
        meter = made.meter(())
        made.exciter.drive(excitation_of(SINE))
        blocks.append([meter.take(10, 1000.0).channels["output_v"] for _ in range(2)])
    assert np.array_equal(blocks[0], blocks[1])
    assert not np.array_equal(blocks[0][0], blocks[0][1])


def test_an_outlet_that_it_has_not_is_refused_by_name():
    with pytest.raises(ValueError, match="no output u_v; it has output_v, reference_x_v"):
        world().meter(("u_v",))


def test_at_rest_nothing_is_driven():
    made = world()
    assert (made.exciter.driven, made.exciter.status().on) == (REST, False)
