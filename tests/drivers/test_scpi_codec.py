import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.protocols import Identity
from tumble.drivers.scpi.codec import (
    CorruptReplyError,
    QueueEntry,
    StaleReplyError,
    agreed,
    identity_request,
    parse_error,
    parse_identity,
    parse_number,
    parse_readings,
    parse_reply,
    request,
)


def test_a_request_sets_its_number_and_asks_for_it_before_and_behind_the_queries():
    line = request(7, ["*CLS", "CONF:VOLT:DC"], ["FETC?"])

    assert line == b"*ESE 7;*CLS;:CONF:VOLT:DC;*ESE?;:FETC?;*ESE?\n"


def test_the_answers_stand_between_the_numbers():
    assert parse_reply(b"+7;+1.5E+00;1\r\n".replace(b"1\r", b"1;+7\r"), 7, 2) == ("+1.5E+00", "1")


def test_a_semicolon_in_quotation_marks_separates_nothing():
    assert parse_reply(b'3;-113,"Undefined header;FOO";3\n', 3, 1) == ('-113,"Undefined header;FOO"',)


def test_an_answer_with_another_number_is_stale():
    with pytest.raises(StaleReplyError, match=r"answer number \+6 instead of 7"):
        parse_reply(b"+6;+1;+6\n", 7, 1)


@pytest.mark.parametrize(
    "line",
    [
        pytest.param(b"", id="empty"),
        pytest.param(b"7\n", id="one number"),
        pytest.param(b"7;1;8\n", id="two numbers"),
        pytest.param(b"7;1\n", id="cut behind"),
        pytest.param(b"1;7\n", id="cut before"),
        pytest.param(b"7;1;2;7\n", id="one answer too many"),
        pytest.param(b"7;7\n", id="no answer"),
        pytest.param(b"7;1;77;1;7\n", id="two lines merged"),
        pytest.param(b'7;"1;7\n', id="open quotation"),
        pytest.param(b"7;\xb1;7\n", id="not ASCII"),
        pytest.param(b"7.;1;7.\n", id="number with a point"),
    ],
)
def test_a_line_that_no_request_is_answered_with_is_refused(line):
    with pytest.raises(CorruptReplyError):
        parse_reply(line, 7, 1)


def test_two_copies_that_agree_are_one_answer():
    assert agreed(("1", "2", "1", "2")) == ("1", "2")


def test_two_copies_that_differ_are_none():
    with pytest.raises(CorruptReplyError, match="differ"):
        agreed(("1.5", "1.4"))


def test_who_it_is_comes_behind_the_number():
    assert identity_request(9) == b"*ESE 9;*ESE?;*IDN?\n"
    line = b"+9;Keysight Technologies,34461A,MY53220000,A.02.17-02.40\n"

    assert parse_identity(line, 9) == Identity(
        model="Keysight Technologies 34461A", serial="MY53220000", firmware="A.02.17-02.40"
    )


def test_somebody_else_s_answer_is_no_identity():
    with pytest.raises(CorruptReplyError, match="not maker, model"):
        parse_identity(b"9;+1.0E+00\n", 9)
    with pytest.raises(StaleReplyError):
        parse_identity(b"8;A,B,C,D\n", 9)


def test_readings_keep_overloads_and_know_what_is_no_number():
    readings = parse_readings("+1.50000000E+00,-.5,3,9.9E+37,-9.90000000E+37,9.91E37,NAN,INF,NINF")

    expected = [1.5, -0.5, 3.0, 9.9e37, -9.9e37, math.nan, math.nan, 9.9e37, -9.9e37]
    np.testing.assert_array_equal(readings, expected)


@pytest.mark.parametrize("field", ["", "1,", ",1", "1,,2", "1 2", "1e", "0x1", "inf", "1_0", "1.2.3", "+-1", "１"])
def test_what_is_not_a_list_of_numbers_is_refused(field):
    with pytest.raises(CorruptReplyError):
        parse_readings(field)


def test_one_number_is_not_two():
    assert parse_number("+5.0E+01") == 50.0
    with pytest.raises(CorruptReplyError, match="not one number"):
        parse_number("1,2")


def test_an_entry_of_the_error_queue_has_a_number_and_a_text():
    assert parse_error('-113,"Undefined header"') == QueueEntry(number=-113, text="Undefined header")
    with pytest.raises(CorruptReplyError):
        parse_error("-113")


@given(st.lists(st.floats(allow_nan=False, allow_infinity=False, width=32), min_size=1, max_size=20))
def test_readings_come_back_as_they_were_written(values):
    field = ",".join(f"{value:+.8E}" for value in values)

    np.testing.assert_allclose(parse_readings(field), values, rtol=1e-8, atol=0.0)


@given(st.binary(max_size=60), st.integers(0, 255))
def test_any_line_is_answers_or_refused(line, tag):
    try:
        answers = parse_reply(line, tag, 2)
    except (CorruptReplyError, StaleReplyError):
        return
    assert len(answers) == 2


@given(st.data())
def test_no_single_wrong_byte_in_a_doubled_answer_changes_a_reading(data):
    line = b"+12;+2.51234567E+00,-1.00000000E-03;+2.51234567E+00,-1.00000000E-03;+12\n"
    place = data.draw(st.integers(0, len(line) - 2))
    wrong = bytes([data.draw(st.integers(0, 255).filter(lambda octet: octet != line[place]))])
    spoilt = line[:place] + wrong + line[place + 1 :]

    try:
        (field,) = agreed(parse_reply(spoilt, 12, 2))
    except (CorruptReplyError, StaleReplyError):
        return
    assert field == "+2.51234567E+00,-1.00000000E-03"
