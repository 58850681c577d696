import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from tumble.drivers.clock import VirtualClock
from tumble.drivers.protocols import Identity, SampleBlock
from tumble.procedures.acquisition import Acquisition
from tumble.procedures.reduction import count_unusable, reduce_samples
from tumble.procedures.settling import agree, settle
from tumble.procedures.steps import Reading

ACQUISITION = Acquisition(samples=100, rate_hz=100.0, settle_s=0.5, settle_samples=10, settle_timeout_s=3.0)


class SequenceDaq:
    """Gives blocks about the means that it was told, the last one over and over."""

    def __init__(self, clock, means_v, ripple_v=1e-3):
        self._clock, self._means_v, self._ripple_v = clock, list(means_v), ripple_v
        self.blocks = 0
        self.lag_s = 0.0

    def identify(self):
        return Identity(model="sequence", serial="1")

    def acquire(self, samples, rate_hz):
        mean_v = self._means_v[min(self.blocks, len(self._means_v) - 1)]
        self.blocks += 1
        self._clock.sleep(samples / rate_hz + self.lag_s)
        voltage_v = mean_v + self._ripple_v * (-1.0) ** np.arange(samples)
        return SampleBlock(voltage_v=voltage_v, rate_hz=rate_hz, device_time_s=0.0, temperature_degc=None)


def taking(daq):
    return lambda samples, rate_hz: daq.acquire(samples, rate_hz).channels


def settled(means_v, acquisition=ACQUISITION, ripple_v=1e-3):
    clock = VirtualClock(0)
    daq = SequenceDaq(clock, means_v, ripple_v)
    return settle(taking(daq), clock, acquisition, lambda: None), daq.blocks, clock.monotonic_s()


def test_an_output_at_rest_takes_two_blocks_after_the_least_time():
    assert settled([1.0]) == (True, 2, pytest.approx(0.7))


def test_a_moving_output_is_waited_for():
    assert settled([1.0, 0.5, 0.25, 0.125, 0.1, 0.1]) == (True, 6, pytest.approx(1.1))


def test_an_output_that_never_rests_is_given_up_in_time():
    assert settled(np.arange(1000.0)) == (False, 30, pytest.approx(3.5))


def test_a_slow_daq_does_not_stretch_the_time_allowed():
    clock = VirtualClock(0)
    daq = SequenceDaq(clock, np.arange(1000.0))
    daq.lag_s = 1.0
    assert not settle(taking(daq), clock, ACQUISITION, lambda: None)
    assert daq.blocks == 3


def test_a_daq_that_takes_no_time_is_asked_only_as_often_as_blocks_fit():
    class Frozen(VirtualClock):
        def sleep(self, duration_s):
            pass

    clock = Frozen(0)
    daq = SequenceDaq(clock, np.arange(1000.0))
    assert not settle(taking(daq), clock, ACQUISITION, lambda: None)
    assert daq.blocks == 30


def test_without_noise_a_microvolt_is_no_difference():
    assert settled([1.0, 1.0 + 9e-7], ripple_v=0.0)[:2] == (True, 2)
    assert settled([1.0, 1.0 + 2e-6], ripple_v=0.0)[:2] == (True, 3)


def test_volts_may_be_the_measure():
    in_volts = replace(ACQUISITION, settle_tolerance_v=0.2)
    assert settled([1.0, 0.5, 0.25, 0.125], in_volts)[:2] == (True, 4)


def test_a_stop_is_heeded_between_blocks():
    clock = VirtualClock(0)
    daq = SequenceDaq(clock, np.arange(10.0))

    def stop_after_three():
        if daq.blocks == 3:
            raise InterruptedError

    with pytest.raises(InterruptedError):
        settle(taking(daq), clock, ACQUISITION, stop_after_three)
    assert daq.blocks == 3


@given(difference=st.floats(-10.0, 10.0), first_sd_v=st.floats(0.01, 1.0), second_sd_v=st.floats(0.01, 1.0))
def test_the_measure_is_the_standard_error_of_the_difference(difference, first_sd_v, second_sd_v):
    standard_error_v = math.sqrt(first_sd_v**2 / 10 + second_sd_v**2 / 20)
    first = Reading(mean=0.0, sd=first_sd_v, samples=10)
    second = Reading(mean=difference * standard_error_v, sd=second_sd_v, samples=20)
    assume(abs(abs(difference) - 3.0) > 1e-9)
    assert agree(first, second, ACQUISITION) == (abs(difference) < 3.0)


def test_a_block_reduces_to_mean_and_sample_standard_deviation():
    reduced = reduce_samples(np.array([1.0, 2.0, 6.0]))
    assert reduced == Reading(mean=3.0, sd=pytest.approx(math.sqrt(7.0)), samples=3)


@pytest.mark.parametrize("bad_v", [math.nan, math.inf, -math.inf, 9.9e37, -9.9e37])
def test_a_sample_that_is_no_voltage_spoils_the_mean(bad_v):
    values = np.array([1.0, bad_v, 6.0, bad_v])
    reduced = reduce_samples(values)
    assert math.isnan(reduced.mean)
    assert math.isnan(reduced.sd)
    assert (reduced.samples, count_unusable(values)) == (4, 2)


def test_a_block_without_a_mean_agrees_with_nothing():
    spoilt = reduce_samples(np.array([math.nan, 1.0]))
    assert not agree(spoilt, spoilt, ACQUISITION)
