"""An instrument that tells numbers in lines: what a stand file declares, against lines typed in."""

import math

import numpy as np
import pytest
from pydantic import ValidationError

from tumble.drivers.clock import VirtualClock
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.lines.declaration import LinesTable
from tumble.drivers.lines.form import SpoiltLineError
from tumble.drivers.lines.sampler import LineSampler, Requests
from tumble.drivers.protocols import Reconnectable, Remarking, Sampler

NMEA = {
    "driver": "lines",
    "url": "socket://127.0.0.1:1",
    "start": "$",
    "columns": ["=PGYRO", "number", "rate", "tilt", "-", "T"],
    "checksum": "xor",
    "counter": "number",
    "measured": {
        "levelling_rate_deg_h": {"column": "rate", "unit": "deg/s", "range": [-400.0, 400.0]},
        "tilt_gamma_deg": {"column": "tilt", "unit": "arcmin"},
    },
    "temperature": {"column": "T", "unit": "K"},
}
"""NMEA 0183: the checksum is the exclusive or of everything between $ and *."""


def form(**changes):
    return LinesTable.model_validate(NMEA | changes).form


def nmea(body):
    checksum = 0
    for octet in body.encode():
        checksum ^= octet
    return f"${body}*{checksum:02X}\r\n".encode()


def test_a_line_is_read_in_the_units_of_the_channels():
    sample = form().read(nmea("PGYRO,17,0.002,-30,xyz,296.15"))
    assert sample.values == {"levelling_rate_deg_h": pytest.approx(7.2), "tilt_gamma_deg": pytest.approx(-0.5)}
    assert sample.temperature_degc == pytest.approx(23.0)
    assert sample.count == 17


def test_a_sentence_of_nmea_is_read_with_its_checksum():
    """The sentence with which most descriptions of NMEA 0183 explain GGA."""
    line = b"$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n"
    columns = ["=GPGGA", "time", *"-" * 7, "height", "=M", "geoid", "=M", "-", "-"]
    table = {"columns": columns, "measured": {"height": {"column": "height"}}, "counter": "", "temperature": None}
    assert form(**table).read(line).values == {"height": 545.4}


@pytest.mark.parametrize(
    ("line", "kind"),
    [
        (b"$PGYRO,17,0.002,-30,x,296*00\r\n", "lines with a wrong checksum"),
        (b"$PGYRO,17,0.002,-30,x,296\r\n", "lines with a wrong checksum"),
        (b"PGYRO,17,0.002\r\n", "lines with another beginning"),
        (nmea("PGYRO,17,0.002,-30,x"), "lines with more or fewer columns"),
        (nmea("PINCL,17,0.002,-30,x,296"), "lines of another kind"),
        (nmea("PGYRO,17,0.00.2,-30,x,296"), "lines with what is no number"),
        (nmea("PGYRO,17,1_0,-30,x,296"), "lines with what is no number"),
        (nmea("PGYRO,-1,0.002,-30,x,296"), "lines whose counter is no number"),
        (b"\xff\xfe\x00\r\n", "lines with another beginning"),
        (b"\r\n", "lines with another beginning"),
    ],
)
def test_a_line_that_is_none_is_told_by_its_kind(line, kind):
    with pytest.raises(SpoiltLineError, match=f"^{kind}$"):
        form().read(line)


@pytest.mark.parametrize(("text", "value"), [("nan", math.nan), ("", math.nan), ("0.2", 9.9e37), ("1e300", 9.9e37)])
def test_no_number_is_nan_and_what_is_out_of_range_an_overload(text, value):
    read = form().read(nmea(f"PGYRO,17,{text},-30,x,296")).values["levelling_rate_deg_h"]
    assert read == pytest.approx(value, nan_ok=True)


@pytest.mark.parametrize("checksum", ["none", "xor", "sum", "crc16"])
@pytest.mark.parametrize("separator", [",", ";", " ", "\t"])
def test_what_is_written_is_read_again(checksum, separator):
    told = {"levelling_rate_deg_h": -12.345678, "tilt_gamma_deg": 0.25}
    declared = form(checksum=checksum, separator=separator)
    read = declared.read(declared.write(told, 21.5, 65_535))
    assert read.values == {name: pytest.approx(value, rel=1e-8) for name, value in told.items()}
    assert (read.temperature_degc, read.count) == (pytest.approx(21.5), 65_535)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"counter": "count"}, "no column is called count: columns has =PGYRO, number, rate, tilt, -, T"),
        ({"temperature": {"column": "-"}}, "no column is called -"),
        ({"temperature": {"column": "tilt"}}, "column tilt is named twice"),
        ({"measured": {"rate_deg_h": {"column": "rate", "unit": "V"}}}, "V is no unit of rate_deg_h; known are deg/h"),
        ({"measured": {"rate_deg_h": {"column": "rate", "range": [4.0, -4.0]}}}, "4 is not below -4"),
        ({"checksum": "md5"}, "Input should be 'none', 'xor', 'sum' or 'crc16'"),
    ],
)
def test_a_declaration_that_contradicts_itself_is_refused(changes, sentence):
    with pytest.raises(ValidationError, match=sentence):
        LinesTable.model_validate(NMEA | changes)


class FakeLine:
    """A serial line in virtual time: a line every 0.1 s, or silence."""

    def __init__(self, clock, lines, every_s=0.1):
        self._clock, self._lines, self._every_s = clock, iter(lines), every_s
        self.written = []

    def write(self, data):
        self.written.append(data)

    def read_line(self, terminator, timeout_s):
        assert terminator == b"\n"
        line = next(self._lines, None)
        if line is None:
            self._clock.sleep(timeout_s)
            raise NoReplyError("serial DAQ", "gave no answer", "check it")
        self._clock.sleep(self._every_s)
        return line

    def discard_input(self):
        pass

    def reopen(self):
        pass


def counted(numbers, rate="0.001"):
    return [nmea(f"PGYRO,{number % 65_536},{rate},-30,x,296.15") for number in numbers]


def sampler(lines, requests=None, every_s=0.1):
    clock = VirtualClock(wall_start_ns=0)
    link = FakeLine(clock, lines, every_s)
    made = LineSampler(link, form(), clock, requests or Requests(), modulus=65_536)
    fits: Sampler = made
    assert isinstance(fits, Reconnectable) and isinstance(fits, Remarking)
    return made, link, clock


def test_a_block_is_the_next_lines_that_come():
    made, _, _ = sampler(counted(range(65_530, 65_560)))
    block = made.acquire(20, 10.0)
    assert block.channels["levelling_rate_deg_h"] == pytest.approx(np.full(20, 3.6))
    assert block.temperature_degc == pytest.approx(23.0)


def test_spoilt_lines_are_dropped_and_the_block_is_taken_once_more():
    made, _, _ = sampler([*counted(range(5)), b"#\r\n", *counted(range(6, 40))])
    assert len(made.acquire(10, 10.0).channels["tilt_gamma_deg"]) == 10
    assert made.remarks() == ("serial DAQ: lines with another beginning dropped: 1 (the first: '#')",)


@pytest.mark.parametrize(
    ("lines", "sentence"),
    [
        (counted(range(0, 200, 2)), "9 of 10 lines did not follow the one before, twice in a row"),
        (counted([7] * 200), "9 of 10 lines did not follow the one before, twice in a row"),
        ([*counted(range(5)), b"#\r\n"] * 20, "2 lines of a block said nothing, twice in a row"),
        ([b"garbage\r\n"] * 100, "sent 20 lines in a row that say nothing .*lines with another beginning dropped: 20"),
    ],
)
def test_lines_that_come_to_harm_again_and_again_end_it(lines, sentence):
    made, _, _ = sampler(lines)
    with pytest.raises(DeviceError, match=sentence):
        made.acquire(10, 10.0)


def test_silence_is_a_lost_link():
    made, _, _ = sampler(counted(range(5)))
    with pytest.raises(LinkLostError, match="gave no answer"):
        made.acquire(10, 10.0)


def test_another_rate_is_told():
    made, _, _ = sampler(counted(range(100)), every_s=0.02)
    with pytest.raises(DeviceError, match="sends 50 lines a second by itself, and 10 were asked for; write the rate"):
        made.acquire(20, 10.0)


@pytest.mark.parametrize("rate", ["3.6", "nan"])
def test_a_channel_without_usable_values_ends_it_after_half_a_minute(rate):
    made, _, clock = sampler(counted(range(1000), rate))
    with pytest.raises(DeviceError, match="levelling_rate_deg_h has had no value between -400 and 400 for 30 s"):
        for _ in range(10):
            made.acquire(50, 10.0)
    assert clock.monotonic_s() == pytest.approx(30.6)


def test_lines_are_asked_for_at_the_rate():
    made, link, clock = sampler(counted(range(100)), Requests(line="R?"), every_s=0.01)
    made.acquire(5, 10.0)
    assert link.written == [b"R?\r\n"] * 5
    assert clock.monotonic_s() == pytest.approx(0.41)


def test_it_says_who_it_is_among_its_lines():
    lines = [*counted(range(3)), b"ID,PG-2,00417,3.1\r\n", *counted(range(4, 10))]
    made, link, _ = sampler(lines, Requests(identity="ID?"))
    identity = made.identify()
    assert (identity.model, identity.serial, identity.firmware) == ("PG-2", "00417", "3.1")
    assert link.written == [b"ID?\r\n"]


def test_one_that_does_not_say_who_it_is_is_told():
    made, _, _ = sampler(counted(range(100)), Requests(identity="ID?"))
    with pytest.raises(NoReplyError, match="does not say who it is; check identity_request"):
        made.identify()
