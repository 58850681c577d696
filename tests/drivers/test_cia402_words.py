import pytest
from canopen.objectdictionary import import_od
from canopen.profiles.p402 import State402
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.cia402 import object_dictionary, write_eds
from tumble.drivers.cia402.emergencies import abort_words, emergency_words
from tumble.drivers.cia402.states import TOWARDS_ENABLED, State, is_moving, state_of
from tumble.drivers.links.can_address import CanAddress


@given(st.integers(0, 0xFFFF))
def test_a_statusword_tells_the_state_that_canopen_reads_in_it(statusword: int):
    names = [name for name, (mask, value) in State402.SW_MASK.items() if statusword & mask == value]
    state = state_of(statusword)
    assert [state.value.upper()] == names if state else names == []


def test_every_step_towards_enabled_is_a_transition_of_the_profile():
    for state, controlword in TOWARDS_ENABLED.items():
        ways = {code for (start, _), code in State402.TRANSITIONTABLE.items() if start == state.value.upper()}
        assert controlword in ways


@pytest.mark.parametrize(
    ("statusword", "moving"), [(0x0237, True), (0x0637, False), (0x0217, True), (0x0250, False), (0x0218, False)]
)
def test_a_drive_moves_only_under_power_and_until_it_says_it_has_arrived(statusword: int, moving: bool):
    assert is_moving(statusword) is moving
    assert state_of(statusword) in State


@pytest.mark.parametrize(
    ("code", "words"),
    [
        (0x8611, "following error: the axis did not keep up with its set-point (code 8611h)"),
        (0x2399, "current (code 2399h)"),
        (0xFF01, "additional functions or specific to the device (code FF01h)"),
        (0xA000, "unknown error (code A000h)"),
    ],
)
def test_an_emergency_is_told_in_words(code: int, words: str):
    assert emergency_words(code) == words


def test_an_sdo_abort_is_told_in_words():
    assert abort_words(0x06090030) == "value range of parameter exceeded (SDO abort 06090030h)"
    assert abort_words(0x12345678) == "unknown reason (SDO abort 12345678h)"


def test_the_data_sheet_is_read_back_as_it_was_written(tmp_path):
    path = tmp_path / "drive.eds"
    write_eds(path, node_id=5)
    read, written = import_od(str(path), node_id=5), object_dictionary(5)
    assert sorted(read) == sorted(written)
    for index, thing in written.items():
        for subindex in thing if hasattr(thing, "subindices") else [0]:
            mine, theirs = written.get_variable(index, subindex), read.get_variable(index, subindex)
            assert (theirs.name, theirs.data_type, theirs.access_type) == (mine.name, mine.data_type, mine.access_type)
            assert theirs.default == mine.default


@pytest.mark.parametrize(
    ("url", "options"),
    [
        ("socketcan:can0", {}),
        ("slcan:/dev/ttyACM0?bitrate=500000", {"bitrate": 500000}),
        ("socketcand:can0?host=127.0.0.1&port=29536", {"host": "127.0.0.1", "port": 29536}),
        ("slcan:COM3@115200?sleep_after_open=0.5", {"sleep_after_open": 0.5}),
    ],
)
def test_a_can_address_is_read_and_written(url: str, options: dict):
    address = CanAddress.from_url(url)
    assert (address.options, address.url) == (options, url)


@pytest.mark.parametrize("url", ["", "can0", ":can0", "socketcan:"])
def test_what_names_no_bus_is_refused(url: str):
    with pytest.raises(ValueError, match="names no CAN bus"):
        CanAddress.from_url(url)
