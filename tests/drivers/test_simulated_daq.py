"""The simulated DAQ: its converter and its clock."""

import numpy as np
import pytest

from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated import Simulated, SimulatedStand, build
from tumble.drivers.simulated.daq import Converter
from tumble.drivers.simulated.effects import Effects


def converter(effects=None, resolution_v=0.0, range_v=10.0) -> Converter:
    return Converter(Effects.model_validate(effects or {}), resolution_v=resolution_v, range_v=range_v)


def quiet(effects=None, **settings) -> SimulatedStand:
    calm = {"wander_K": 0.0, "sensor_noise_K": 0.0}
    table = {"preset": "ideal", "resolution_v": 0.0, "temperature": calm, "effects": effects or {}} | settings
    return build(Simulated.model_validate(table))


def read_v(stand: SimulatedStand, angle_deg: float) -> float:
    stand.stand.positioners["head"].start_move(angle_deg)
    stand.stand.clock.sleep(30.0)
    return float(stand.stand.samplers["daq"].acquire(10, 100.0).voltage_v.mean())


def test_nonlinearity_is_a_sine_of_the_voltage():
    effects = {"daq_nonlinearity": {"amplitude": 1e-3, "period_V": 2.0}}
    assert converter(effects).shown_v(np.array([0.0, 0.5, 2.5, -0.5])) == pytest.approx([0.0, 0.501, 2.501, -0.501])


def test_a_range_step_raises_what_is_above_the_threshold():
    effects = {"range_step": {"step": 1e-3, "threshold_V": 2.0}}
    assert converter(effects).shown_v(np.array([1.9, 2.0, 2.1])) == pytest.approx([1.9, 2.0, 2.101])


def test_readings_come_in_whole_steps():
    assert converter(resolution_v=0.01).shown_v(np.array([1.004, 1.006])) == pytest.approx([1.0, 1.01])


def test_a_voltage_out_of_range_reads_as_overload():
    assert converter(range_v=2.0).shown_v(np.array([1.9, 2.1, -2.1])).tolist() == [1.9, 9.9e37, 9.9e37]


def test_an_acquisition_advances_the_clock():
    stand = quiet()
    stand.stand.clock.sleep(5.0)
    block = stand.stand.samplers["daq"].acquire(50, 100.0)
    assert (block.device_time_s, block.rate_hz, block.voltage_v.shape) == (5.0, 100.0, (50,))
    assert stand.stand.clock.monotonic_s() == pytest.approx(5.5)


@pytest.mark.parametrize(("samples", "rate_hz"), [(0, 100.0), (10, 0.0), (10, float("nan"))])
def test_nothing_to_acquire_is_a_fault(samples, rate_hz):
    with pytest.raises(DeviceError, match="cannot be taken"):
        quiet().stand.samplers["daq"].acquire(samples, rate_hz)


def test_it_says_who_it_is():
    assert quiet().stand.samplers["daq"].identify().model == "tumble simulated DAQ"


def test_a_part_of_the_previous_dwell_remains_in_every_acquisition_of_the_next():
    stand = quiet({"settling": 0.1})
    assert read_v(stand, -90.0) == pytest.approx(1.0)
    assert read_v(stand, 0.0) == pytest.approx(0.1)
    again_v = stand.stand.samplers["daq"].acquire(10, 100.0).voltage_v
    assert again_v == pytest.approx(np.full(10, 0.1))


def test_nothing_remains_after_a_change_of_mount():
    stand = quiet({"settling": 0.1})
    read_v(stand, -90.0)
    stand.world.seat("face-down")
    assert read_v(stand, 0.0) == pytest.approx(0.0, abs=1e-12)


def test_nothing_remains_after_a_pause():
    stand = quiet({"settling": 0.1})
    read_v(stand, -90.0)
    stand.stand.clock.sleep(600.0)
    assert read_v(stand, 0.0) == pytest.approx(0.0, abs=1e-12)


def test_samples_taken_while_the_head_moves_follow_it():
    stand = quiet(response_tau_s=0.0)
    stand.stand.positioners["head"].start_move(-90.0)
    block = stand.stand.samplers["daq"].acquire(5, 1.0)
    angles_deg = np.array([0.0, 20.0, 40.0, 60.0, 80.0])
    assert block.voltage_v == pytest.approx(np.sin(np.deg2rad(angles_deg)), abs=1e-12)


def test_latency_delays_what_is_read_in_motion():
    stand = quiet({"latency": 0.5}, response_tau_s=0.0)
    stand.stand.positioners["head"].start_move(-90.0)
    block = stand.stand.samplers["daq"].acquire(3, 1.0)
    assert block.voltage_v == pytest.approx(np.sin(np.deg2rad([0.0, 10.0, 30.0])), abs=1e-12)


def test_the_first_samples_after_a_move_still_settle():
    stand = quiet(response_tau_s=0.5)
    stand.stand.positioners["head"].start_move(-20.0)
    stand.stand.clock.sleep(1.0)
    first_v, second_v = stand.stand.samplers["daq"].acquire(2, 2.0).voltage_v
    left_deg = 10.0 * (1.0 - np.exp(-2.0))
    assert first_v == pytest.approx(np.sin(np.deg2rad(20.0 - left_deg)))
    assert second_v == pytest.approx(np.sin(np.deg2rad(20.0 - left_deg / np.e)))
