import numpy as np
import pytest
from scpi_bench import emulated

from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.protocols import Identity, Reconnectable, Sampler
from tumble.drivers.scpi import ScpiMultimeter
from tumble.drivers.scpi.measurement import voltage
from tumble.drivers.scpi.models import MODELS
from tumble.drivers.simulated import Simulated
from tumble.emulators.faults import At, Fault, FaultScript

QUIET = Simulated(noise_v=0.0, parameters={"u0": 2.5, "kx": 1.0})


def meter_of(link, clock, **options):
    meter = ScpiMultimeter(link, clock, **options)
    meter.identify()
    return meter


def fault(kind, **at):
    return FaultScript(fault=(Fault(device="daq", kind=kind, at=At(**at)),))


def garbled(line):
    place = line.index(b".") + 2
    return line[:place] + bytes([line[place] ^ 1]) + line[place + 1 :]


def test_it_says_who_it_is():
    meter = ScpiMultimeter(*emulated())

    assert meter.identify() == Identity(
        model="Keysight Technologies 34461A", serial="MY57200001", firmware="A.02.17-02.40-02.17-00.52-04-02"
    )


def test_it_fits_the_protocols():
    meter: Sampler = ScpiMultimeter(*emulated())

    assert isinstance(meter, Reconnectable)


def test_a_block_holds_the_voltage_at_the_terminals():
    link, clock = emulated(QUIET)

    block = meter_of(link, clock).acquire(20, 100.0)

    assert block.voltage_v.shape == (20,)
    np.testing.assert_allclose(block.voltage_v, block.voltage_v[0], atol=2e-6)
    assert 2.4 < block.voltage_v[0] < 2.6
    assert block.rate_hz == 100.0


@pytest.mark.parametrize(
    ("model", "rate_hz"), [("34461A", 100.0), ("34461A", 5.0), ("34465A", 100.0), ("34410A", 25.0)]
)
def test_a_block_takes_its_samples_over_its_rate(model, rate_hz):
    link, clock = emulated(model=model)
    meter = meter_of(link, clock)
    began_s = clock.monotonic_s()

    meter.acquire(50, rate_hz)

    assert clock.monotonic_s() - began_s == pytest.approx(50 / rate_hz, abs=0.02)


def test_the_longest_integration_time_that_the_rate_allows_is_chosen():
    link, clock = emulated()
    meter = meter_of(link, clock)

    meter.acquire(2, 100.0)
    meter.acquire(2, 25.0)

    blocks = [line for line in link.written if "INIT" in line]
    assert ":VOLT:DC:NPLC 0.2;" in blocks[0]
    assert ":TRIG:DEL 0.006;" in blocks[0]
    assert ":VOLT:DC:NPLC 1;" in blocks[1]
    assert ":TRIG:DEL 0.02;" in blocks[1]


def test_without_a_range_it_ranges_by_itself():
    link, clock = emulated(QUIET)

    block = meter_of(link, clock, range_v=None).acquire(2, 100.0)

    assert "VOLT:DC:RANG:AUTO 1" in "".join(link.written)
    assert 2.4 < block.voltage_v[0] < 2.6


def test_the_smallest_range_that_holds_the_voltage_is_taken():
    link, clock = emulated()

    meter_of(link, clock, range_v=5.0).acquire(2, 100.0)

    assert ":VOLT:DC:RANG 10;" in "".join(link.written)


def test_an_overload_stays_what_the_meter_says():
    link, clock = emulated(QUIET)

    block = meter_of(link, clock, range_v=1.0).acquire(3, 100.0)

    assert block.voltage_v.tolist() == [9.9e37] * 3


def test_no_number_is_nan():
    link, clock = emulated(QUIET, fault("nan", point=0))

    block = meter_of(link, clock).acquire(3, 100.0)

    assert np.isnan(block.voltage_v).tolist() == [False, True, False]


def test_more_than_the_memory_holds_is_taken_in_parts():
    link, clock = emulated(Simulated(noise_v=1e-3))

    block = meter_of(link, clock).acquire(25_000, 1000.0)

    assert len(block.voltage_v) == 25_000
    assert ["SAMP:COUN 5000;" in line for line in link.written if "INIT" in line] == [False, False, True]
    assert float(block.voltage_v.std()) == pytest.approx(1e-3, rel=0.05)


def test_an_overloaded_sample_is_kept_among_the_others():
    link, clock = emulated(QUIET, fault("overload", point=0))

    block = meter_of(link, clock).acquire(3, 100.0)

    assert (block.voltage_v == 9.9e37).tolist() == [False, True, False]


def test_without_a_sensor_there_is_no_temperature():
    assert meter_of(*emulated()).acquire(2, 100.0).temperature_degc is None


def test_the_temperature_is_measured_anew_once_it_is_old():
    link, clock = emulated()
    meter = meter_of(link, clock, temperature_sensor="FRTD", temperature_age_s=10.0)

    first = meter.acquire(2, 100.0).temperature_degc
    second = meter.acquire(2, 100.0).temperature_degc
    clock.sleep(11.0)
    third = meter.acquire(2, 100.0).temperature_degc

    assert first == pytest.approx(23.0, abs=0.5)
    assert first == second
    assert first != third
    assert sum("CONF:TEMP FRTD" in line for line in link.written) == 2


@pytest.mark.parametrize("spoil", [garbled, lambda line: line[:20], lambda line: line[:20] + b"\n", lambda _: b""])
def test_an_answer_that_came_to_harm_is_asked_for_again(spoil):
    whole, clean_clock = emulated(QUIET)
    expected = meter_of(whole, clean_clock).acquire(5, 100.0).voltage_v
    link, clock = emulated(QUIET)
    meter = meter_of(link, clock)
    link.spoil_answer = {link.answers + 2: spoil}

    block = meter.acquire(5, 100.0)

    np.testing.assert_array_equal(block.voltage_v, expected)
    assert sum("FETC?" in line for line in link.written) == 2


def test_a_doubled_answer_is_not_taken_for_the_next():
    link, clock = emulated(Simulated(noise_v=0.1))
    meter = meter_of(link, clock)
    link.spoil_answer = dict.fromkeys(range(100), lambda line: line + line)

    blocks = [meter.acquire(5, 100.0).voltage_v for _ in range(3)]

    assert not np.array_equal(blocks[0], blocks[1])
    assert not np.array_equal(blocks[1], blocks[2])


def test_an_answer_to_an_earlier_request_is_passed_over():
    link, clock = emulated()
    meter = meter_of(link, clock)
    link.spoil_answer = {link.answers + 2: lambda line: b"1;+1.0E+00,+1.0E+00;+1.0E+00,+1.0E+00;1\n" + line}

    block = meter.acquire(2, 100.0)

    assert 1.0 not in block.voltage_v


@pytest.mark.parametrize(
    "spoil",
    [
        lambda line: line.replace(b"NPLC 0.2", b"NPLC 0.02"),
        lambda line: line.replace(b"CONF", b"CO F"),
        lambda line: line.replace(b"CONF:VOLT:DC", b"CONF:TEMP"),
        lambda line: line.replace(b"RANG 10", b"RANG 99999"),
        lambda line: line.replace(b"COUN 5", b"COUN 7"),
        lambda line: line.replace(b"\n", b""),
    ],
)
def test_a_command_that_came_to_harm_is_noticed_and_the_block_taken_anew(spoil):
    link, clock = emulated(QUIET)
    meter = meter_of(link, clock)
    link.spoil_command = {len(link.written): spoil}

    block = meter.acquire(5, 100.0)

    assert len(block.voltage_v) == 5
    assert sum("INIT" in line for line in link.written) == 2


def test_a_meter_that_never_does_as_it_is_told_is_given_up_with_its_own_words():
    link, clock = emulated()
    meter = meter_of(link, clock)
    link.spoil_command = dict.fromkeys(range(100), lambda line: line.replace(b"RANG 10", b"RANG 99999"))

    with pytest.raises(DeviceError, match=r'failed to measure 3 times: -222,"Data out of range"'):
        meter.acquire(5, 100.0)


def test_power_lost_within_a_block_costs_that_block_only():
    link, clock = emulated(QUIET, fault("power_loss", command=1, containing="FETC?"))
    meter = meter_of(link, clock)

    assert len(meter.acquire(5, 100.0).voltage_v) == 5
    assert sum("INIT" in line for line in link.written) == 2


def test_a_meter_that_says_nothing_is_given_up():
    link, clock = emulated()
    meter = meter_of(link, clock)
    link.spoil_answer = dict.fromkeys(range(100), lambda _: b"")

    with pytest.raises(NoReplyError):
        meter.acquire(5, 100.0)


def test_a_meter_that_speaks_nonsense_is_given_up():
    link, clock = emulated()
    link.spoil_answer = dict.fromkeys(range(100), lambda _: b"?\n")

    with pytest.raises(DeviceError, match="no answer that can be believed in 3 attempts"):
        ScpiMultimeter(link, clock).identify()


def test_an_identity_that_changes_every_time_is_not_believed():
    link, clock = emulated()
    changing = iter(range(100))
    link.spoil_answer = dict.fromkeys(range(100), lambda line: line.replace(b"MY572", b"MY%03d" % next(changing)))

    with pytest.raises(DeviceError, match="identity"):
        ScpiMultimeter(link, clock).identify()


def test_another_unit_in_its_place_is_seen_at_the_next_identification():
    link, clock = emulated(faults=fault("swapped", point=1))
    meter = ScpiMultimeter(link, clock)
    before = meter.identify()
    meter.acquire(2, 100.0)

    assert meter.identify() != before


def test_a_lost_link_is_not_tried_again_until_it_is_reopened():
    link, clock = emulated()
    meter = meter_of(link, clock)
    link.gone = True

    with pytest.raises(LinkLostError):
        meter.acquire(2, 100.0)
    meter.reconnect()

    assert link.reopened == 1
    assert len(meter.acquire(2, 100.0).voltage_v) == 2


@pytest.mark.parametrize(("samples", "rate_hz", "said"), [(0, 1.0, "0 samples"), (5, -1.0, "-1 Hz"), (5, 1e4, "2500")])
def test_what_it_cannot_take_is_refused(samples, rate_hz, said):
    with pytest.raises(DeviceError, match=said):
        meter_of(*emulated()).acquire(samples, rate_hz)


def always(link, old, new):
    """Let the meter itself write one thing for another."""
    link.spoil_answer = dict.fromkeys(range(1000), lambda line: line.replace(old, new))


def test_an_error_queue_without_end_is_not_read_for_ever():
    link, clock = emulated()
    meter = meter_of(link, clock)
    always(link, b'+0,"No error"', b'-330,"Self-test failed"')

    with pytest.raises(DeviceError, match="error queue has no end"):
        meter.acquire(2, 100.0)


def test_readings_that_are_no_numbers_are_refused():
    link, clock = emulated(QUIET)
    meter = meter_of(link, clock)
    always(link, b",+2.", b",+2,,")

    with pytest.raises(DeviceError, match="gave readings that are none"):
        meter.acquire(2, 100.0)


def without_the_last_reading(line):
    return b";".join(
        field.split(b",")[0] if field.count(b",") == 1 and b'"' not in field else field for field in line.split(b";")
    )


def test_too_few_readings_are_refused():
    link, clock = emulated(QUIET)
    meter = meter_of(link, clock)
    link.spoil_answer = dict.fromkeys(range(1000), without_the_last_reading)

    with pytest.raises(DeviceError, match="gave 1 of 2 readings"):
        meter.acquire(2, 100.0)


def test_a_setting_that_is_not_as_it_was_set_is_refused():
    link, clock = emulated()
    meter = meter_of(link, clock)
    always(link, b"+1.00000000E+01", b"+1.00000000E+02")

    with pytest.raises(DeviceError, match=r"VOLT:DC:RANG is \+1.00000000E\+02 instead of 10"):
        meter.acquire(2, 100.0)


def test_a_setting_that_is_no_number_is_refused():
    link, clock = emulated()
    meter = meter_of(link, clock)
    always(link, b"+1.00000000E+01", b"TEN")

    with pytest.raises(DeviceError, match="VOLT:DC:RANG is TEN"):
        meter.acquire(2, 100.0)


def test_a_meter_that_does_not_know_its_power_line_is_refused():
    link, clock = emulated()
    always(link, b"+50", b"AUTO")

    with pytest.raises(DeviceError, match="power line has AUTO Hz"):
        ScpiMultimeter(link, clock).identify()


def test_nothing_but_late_answers_is_no_answer():
    link, clock = emulated()
    link.spoil_answer = dict.fromkeys(range(1000), lambda _: b"255;255\n" * 20)

    with pytest.raises(DeviceError, match="nothing but answers to earlier requests"):
        ScpiMultimeter(link, clock).identify()


@pytest.mark.parametrize(
    ("model", "rate_hz", "nplc"),
    [("34461A", 100.0, 0.2), ("34461A", 2500.0, 0.02), ("34465A", 500.0, 0.06), ("34411A", 20_000.0, 0.002)],
)
def test_the_longest_integration_time_is_taken_that_the_rate_allows(model, rate_hz, nplc):
    assert ("VOLT:DC:NPLC", nplc) in voltage(MODELS[model], 50.0, 10.0, 10, rate_hz).settings
