import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.zaber.codec import (
    DeviceMessage,
    GarbledError,
    Kind,
    Request,
    encode_message,
    encode_request,
    parse_message,
    parse_request,
)

DATA = st.from_regex(r"[a-zA-Z0-9.+-]{1,12}( [a-zA-Z0-9.+-]{1,12}){0,4}", fullmatch=True)
IDS = st.none() | st.integers(0, 99)
REPLIES = st.builds(
    DeviceMessage,
    kind=st.just(Kind.REPLY),
    device=st.integers(1, 99),
    axis=st.integers(0, 9),
    message_id=IDS,
    accepted=st.booleans(),
    busy=st.booleans(),
    warning=st.sampled_from(["--", "FS", "WR", "WH", "NI"]),
    data=DATA,
    continues=st.booleans(),
)


def test_a_request_has_the_bytes_that_the_makers_own_client_sends():
    request = Request(device=1, axis=1, message_id=6, command="move abs 50000")
    assert encode_request(request) == b"/1 1 06 move abs 50000:B6\n"


def test_an_empty_request_asks_for_status():
    assert encode_request(Request(device=1, axis=1, message_id=3)) == b"/1 1 03:FB\n"


@pytest.mark.parametrize(
    ("line", "request_"),
    [
        (b"/\n", Request(device=0, axis=0)),
        (b"/home\r\n", Request(device=0, axis=0, command="home")),
        (b"/1 get pos\n", Request(device=1, axis=0, command="get pos")),
        (b"/1 1 move  rel   5\n", Request(device=1, axis=1, command="move rel 5")),
        (b"/0 0 00:00\n", Request(device=0, axis=0, message_id=0)),
    ],
)
def test_a_device_reads_requests_with_numbers_left_out(line, request_):
    assert parse_request(line) == request_


@pytest.mark.parametrize("line", [b"home\n", b"/1home\n", b"/1 1 06 move abs 50000:B7\n", b"/1 home", b"/\xff\n"])
def test_a_device_ignores_what_is_no_request(line):
    with pytest.raises(GarbledError):
        parse_request(line)


def test_a_reply_says_state_flag_and_data():
    assert parse_message(b"@01 1 06 OK BUSY WR -1250:CD\r\n", checksum=True) == DeviceMessage(
        kind=Kind.REPLY, device=1, axis=1, message_id=6, busy=True, warning="WR", data="-1250"
    )


def test_a_rejection_says_why():
    rejected = parse_message(b"@01 1 RJ IDLE -- BADDATA\r\n", checksum=False)
    assert (rejected.accepted, rejected.data) == (False, "BADDATA")


def test_an_alert_is_told_from_a_reply():
    assert parse_message(b"!01 1 IDLE --\r\n", checksum=False) == DeviceMessage(kind=Kind.ALERT, device=1, axis=1)


def test_a_reply_goes_on_in_infos():
    first = parse_message(b"@01 0 00 OK IDLE -- one two\\\r\n", checksum=False)
    second = parse_message(b"#01 0 00 cont three\r\n", checksum=False)
    whole = first.continued_by(second)
    assert (whole.data, whole.continues) == ("one two three", False)


def test_an_info_that_does_not_continue_is_refused():
    first = parse_message(b"@01 0 00 OK IDLE -- one\\\r\n", checksum=False)
    with pytest.raises(GarbledError, match="does not continue"):
        first.continued_by(parse_message(b"#01 0 00 hello\r\n", checksum=False))


def test_a_message_that_lost_its_checksum_is_refused_where_one_is_due():
    with pytest.raises(GarbledError, match="no checksum"):
        parse_message(b"@01 1 06 OK IDLE -- 0\r\n", checksum=True)


@given(REPLIES, st.booleans())
def test_every_message_comes_back_as_it_went(message, checksum):
    assert parse_message(encode_message(message, checksum=checksum), checksum=checksum) == message


@given(
    st.builds(
        Request,
        device=st.integers(0, 99),
        axis=st.integers(0, 9),
        message_id=IDS,
        command=st.sampled_from(["", "home", "move abs -5", "get pos"]),
    )
)
def test_every_request_comes_back_as_it_went(request_):
    assert parse_request(encode_request(request_)) == request_


@given(REPLIES, st.data())
def test_no_single_wrong_byte_is_accepted(message, data):
    line = encode_message(message, checksum=True)
    place = data.draw(st.integers(0, len(line) - 1))
    octet = data.draw(st.integers(0, 255).filter(lambda octet: octet != line[place]))
    spoilt = line[:place] + bytes([octet]) + line[place + 1 :]
    try:
        accepted = parse_message(spoilt, checksum=True)
    except GarbledError:
        return
    assert accepted == message  # only the carriage return before the line end may differ


@given(REPLIES, st.data())
def test_no_cut_message_is_accepted(message, data):
    line = encode_message(message, checksum=True).rstrip()
    kept = data.draw(st.integers(0, len(line) - 1))
    with pytest.raises(GarbledError):
        parse_message(line[:kept] + b"\r\n", checksum=True)


@given(st.binary(max_size=60), st.booleans())
def test_noise_is_refused_and_nothing_else_happens(noise, checksum):
    with pytest.raises(GarbledError):
        parse_message(noise + b"\n", checksum=checksum)
