"""Meters that take one query a message: found out, driven, and believed no more than the others."""

import numpy as np
import pytest
from scpi_bench import emulated

from tumble.drivers.errors import DeviceError, NoReplyError
from tumble.drivers.scpi import ScpiMultimeter
from tumble.drivers.scpi.plain import EVERYBODYS_BITS
from tumble.drivers.simulated import Simulated
from tumble.emulators.faults import At, Fault, FaultScript

QUIET = Simulated(noise_v=0.0, parameters={"u0": 2.5, "kx": 1.0})
PLAIN = [
    ("34461A", "first"),
    ("34461A", "lines"),
    ("34461A", "one"),
    ("34465A", "first"),
    ("34411A", "one"),
    ("MODEL 2000", "any"),
    ("MODEL 2000", "first"),
    ("MODEL DMM6500", "any"),
    ("MODEL DMM6500", "one"),
    ("SDM3045X", "first"),
    ("SDM3055", "first"),
    ("SDM3065X", "first"),
    ("DM3058", "one"),
    ("DM3068", "one"),
]
REMARKS_OF_A_GUIDE = (
    "does not keep a number (*ESE); the order of its answers is told by its identity",
    "cannot be asked for errors (SYST:ERR?); a command that it refuses is seen by reading back",
    "does not know VOLT:DC:AZ, which is left as it is",
)


def meter_at(model, messages=None, *, common=False, **options):
    link, clock = emulated(options.pop("settings", QUIET), model=model, messages=messages, **options)
    return link, clock, ScpiMultimeter(link, clock, common=common)


@pytest.mark.parametrize(("model", "messages"), PLAIN)
def test_a_block_holds_the_voltage_over_its_time(model, messages):
    _, clock, meter = meter_at(model, messages)
    identity = meter.identify()
    began_s = clock.monotonic_s()

    block = meter.acquire(50, 50.0)

    assert identity.model.endswith(model)
    assert block.voltage_v.shape == (50,)
    np.testing.assert_allclose(block.voltage_v, 2.5, atol=0.1)
    assert (block.rate_hz, block.device_time_s) == (50.0, began_s)
    assert clock.monotonic_s() - began_s == pytest.approx(1.0, abs=0.03)


@pytest.mark.parametrize(("model", "messages"), PLAIN)
def test_after_it_is_known_nothing_holds_two_queries(model, messages):
    link, _, meter = meter_at(model, messages)
    meter.identify()
    known = len(link.written)

    meter.acquire(5, 50.0)

    assert max(line.count("?") for line in link.written[known:]) == 1


def test_a_meter_that_takes_any_message_is_still_asked_in_one():
    link, _, meter = meter_at("34461A")
    meter.identify()

    meter.acquire(5, 50.0)

    assert link.written[-1].startswith("*ESE ")
    assert link.written[-1].count("FETC?") == 2


def test_whatever_is_read_is_asked_for_twice():
    link, _, meter = meter_at("DM3058")
    meter.identify()

    meter.acquire(5, 50.0)

    last = len(link.written) - link.written[::-1].index("FETC?")
    assert link.written[last - 2 : last] == ["FETC?", "FETC?"]


def test_what_a_meter_cannot_stands_in_its_identity():
    assert meter_at("SDM3055")[2].identify().remarks == REMARKS_OF_A_GUIDE
    assert meter_at("SDM3065X")[2].identify().remarks == ("does not know VOLT:DC:FILT, which is left as it is",)
    assert meter_at("MODEL 2000")[2].identify().remarks == ()


def test_a_serial_line_is_taken_into_remote_and_a_network_is_not():
    at_line, _, on_line = meter_at("34461A", "one", checksummed=False)
    at_network, _, on_network = meter_at("34461A", "one")
    on_line.identify()
    on_network.identify()

    assert at_line.written[0] == "SYST:REM"
    assert "SYST:REM" not in at_network.written


def test_a_meter_that_is_not_known_by_name_is_refused_in_one_sentence():
    with pytest.raises(DeviceError, match=r"says that it is 'ACME PLAIN-5'.*write dialect = \"common\" in \[daq\]"):
        meter_at("PLAIN-5")[2].identify()


def test_a_known_name_of_another_maker_is_not_known():
    link, _, meter = meter_at("MODEL 2000")
    link.spoil_answer = dict.fromkeys(range(100), lambda line: line.replace(b"KEITHLEY INSTRUMENTS INC.", b"OTHER"))

    with pytest.raises(DeviceError, match="'OTHER MODEL 2000'"):
        meter.identify()


@pytest.mark.parametrize("model", ["PLAIN-5", "READ-ONCE", "34461A", "SDM3055", "MODEL 2000"])
def test_any_meter_is_used_by_the_common_core(model):
    link, _, meter = meter_at(model, common=True)
    identity = meter.identify()

    block = meter.acquire(5, 2.0)

    np.testing.assert_allclose(block.voltage_v, 2.5, atol=0.1)
    assert "is used by the SCPI that all have, its readings are taken one by one" in identity.remarks
    assert max(line.count("?") for line in link.written) == 1


def test_the_common_core_says_how_fast_it_was():
    _, clock, meter = meter_at("PLAIN-5", common=True)  # 10 cycles of 50 Hz, and as much for zero: 0.4 s a reading
    meter.identify()
    began_s = clock.monotonic_s()

    block = meter.acquire(10, 50.0)

    assert block.rate_hz == pytest.approx(10 / (clock.monotonic_s() - began_s), rel=0.01)
    assert block.rate_hz == pytest.approx(2.5, rel=0.01)


def test_a_reading_that_takes_longer_than_another_answer_is_awaited():
    _, clock, meter = meter_at("34461A", common=True)  # 100 cycles of 50 Hz, and as much for zero: 4 s a reading
    meter.identify()
    began_s = clock.monotonic_s()
    assert len(meter.acquire(2, 0.2).voltage_v) == 2
    assert clock.monotonic_s() - began_s == pytest.approx(9.0, abs=0.1)


def test_where_a_reading_comes_once_only_a_bare_line_is_warned_of():
    bare = meter_at("READ-ONCE", common=True, checksummed=False)[2].identify()
    network = meter_at("READ-ONCE", common=True)[2].identify()

    assert any("this line has no checksum" in remark for remark in bare.remarks)
    assert not any("checksum" in remark for remark in network.remarks)


def test_numbers_are_made_of_bits_that_every_register_keeps():
    link, _, meter = meter_at("DM3058")  # whose mask is 189: Programming Guide for DM3058/DM3058E, 2, *ESE
    meter.identify()

    numbers = [int(line.split()[1]) for line in link.written[6:] if line.startswith("*ESE ")]
    assert numbers
    assert all(number & EVERYBODYS_BITS == number for number in numbers)
    assert EVERYBODYS_BITS == 189


def test_another_language_that_does_not_give_way_is_refused():
    link, _, meter = meter_at("MODEL DMM6500")
    link.spoil_answer = dict.fromkeys(range(300), lambda line: line.replace(b"SCPI\n", b"TSP\n"))

    with pytest.raises(DeviceError, match=r"speaks TSP and not SCPI.*choose SCPI in its menu"):
        meter.identify()


@pytest.mark.parametrize("model", ["MODEL 2000", "MODEL DMM6500"])
def test_a_sensor_that_the_dialect_does_not_know_is_refused(model):
    link, clock = emulated(QUIET, model=model)

    with pytest.raises(DeviceError, match="not known to measure temperature"):
        ScpiMultimeter(link, clock, temperature_sensor="FRTD").identify()


@pytest.mark.parametrize("model", ["SDM3065X", "DM3058"])
def test_temperature_comes_from_the_others(model):
    link, clock = emulated(QUIET, model=model)
    meter = ScpiMultimeter(link, clock, temperature_sensor="RTD,PT100")
    meter.identify()

    assert meter.acquire(3, 50.0).temperature_degc == pytest.approx(23.0, abs=0.5)


def test_a_single_reading_of_a_keithley_2000_is_one_of_two():
    _, _, meter = meter_at("MODEL 2000")
    meter.identify()

    assert meter.acquire(1, 50.0).voltage_v.shape == (1,)


def test_more_than_the_buffer_holds_is_taken_in_parts():
    _, _, meter = meter_at("MODEL 2000", settings=Simulated(noise_v=1e-3))
    meter.identify()

    block = meter.acquire(2100, 500.0)

    assert block.voltage_v.shape == (2100,)
    assert float(block.voltage_v.std()) == pytest.approx(1e-3, rel=0.1)


def test_overload_is_what_every_meter_writes():
    link, clock = emulated(QUIET, model="SDM3055")
    meter = ScpiMultimeter(link, clock, range_v=1.5)
    meter.identify()

    assert meter.acquire(3, 50.0).voltage_v.tolist() == [9.9e37] * 3


@pytest.mark.parametrize(("model", "most"), [("MODEL 2000", 1000), ("SDM3055", 150), ("DM3058", 123)])
def test_what_is_too_fast_is_refused(model, most):
    _, _, meter = meter_at(model)
    meter.identify()

    with pytest.raises(DeviceError, match=f"ask for {most} at most"):
        meter.acquire(5, 5000.0)


def garbled(line):
    return line.replace(b"2.", b"3.") if b"2." in line else bytes([line[0] ^ 4]) + line[1:]


SPOILS = {
    "garbled": garbled,
    "cut": lambda line: line[: len(line) // 2],
    "cut before its end": lambda line: line[: len(line) // 2] + b"\n",
    "lost": lambda _: b"",
    "doubled": lambda line: line + line,
}


@pytest.mark.parametrize("spoil", SPOILS.values(), ids=SPOILS)
@pytest.mark.parametrize(("model", "messages"), [("34461A", "one"), ("MODEL 2000", "any"), ("SDM3055", "first")])
def test_an_answer_that_came_to_harm_spoils_no_block(model, messages, spoil):
    link, _, meter = meter_at(model, messages)
    meter.identify()
    first = link.answers
    expected = meter.acquire(5, 50.0).voltage_v
    for harmed in range(link.answers - first):
        link.spoil_answer = {link.answers + harmed: spoil}

        np.testing.assert_allclose(meter.acquire(5, 50.0).voltage_v, expected, atol=1e-4)


@pytest.mark.parametrize(("model", "messages"), [("34461A", "one"), ("MODEL 2000", "any"), ("SDM3055", "first")])
def test_a_command_that_came_to_harm_spoils_no_block(model, messages):
    link, _, meter = meter_at(model, messages)
    meter.identify()
    first = len(link.written)
    expected = meter.acquire(5, 50.0).voltage_v
    for harmed in range(len(link.written) - first):
        link.spoil_command = {len(link.written) + harmed: lambda line: b"#" + line[1:]}

        np.testing.assert_allclose(meter.acquire(5, 50.0).voltage_v, expected, atol=1e-4)


def test_a_block_that_was_never_begun_is_not_the_one_before():
    link, _, meter = meter_at("SDM3055", settings=Simulated(noise_v=1e-3))  # no error queue tells of it
    meter.identify()
    before = meter.acquire(5, 50.0).voltage_v
    link.spoil_command = {
        number: lambda line: line.replace(b"INIT\n", b"\n") for number in range(len(link.written) + 1000)
    }

    with pytest.raises(DeviceError, match="failed to measure 3 times"):
        meter.acquire(5, 50.0)
    link.spoil_command = {}

    assert not np.array_equal(meter.acquire(5, 50.0).voltage_v, before)


def test_an_error_whose_answer_was_lost_is_an_error():
    link, _, meter = meter_at("34461A", "one", faults=FaultScript(fault=(error_queued("INIT"),)))
    meter.identify()
    link.spoil_answer = {
        number: lambda line: line.replace(b"-310", b"-3x0") for number in range(link.answers, link.answers + 60)
    }

    assert len(meter.acquire(5, 50.0).voltage_v) == 5
    assert link.written.count("INIT") == 2 + 1  # the trial's, and two blocks


def error_queued(containing):
    return Fault(device="daq", kind="error_queued", at=At(command=2, containing=containing))


@pytest.mark.parametrize("model", ["34461A", "MODEL 2000", "SDM3055", "DM3058"])
def test_silence_is_told_as_such(model):
    link, _, meter = meter_at(model, "one")
    meter.identify()
    link.spoil_answer = dict.fromkeys(range(10_000), lambda _: b"")

    with pytest.raises(NoReplyError):
        meter.acquire(5, 50.0)
