import math
from importlib.resources import files

import pytest
from cantools.database import load_string
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.candaq import DaqFrames
from tumble.drivers.candaq.collection import Collection
from tumble.drivers.candaq.frames import Frame

FRAMES = DaqFrames.from_file()
SHIPPED = (files("tumble.drivers.candaq") / "tumble_daq.dbc").read_text("utf-8")


def voltage(number: int, epoch: int = 1, volts: float = 2.5) -> Frame:
    return Frame(name="Voltage", signals={"Voltage": volts, "Counter": number % 256, "Epoch": epoch})


@given(st.integers(-2_147_483_646, 2_147_483_646), st.integers(0, 10**9), st.integers(0, 255))
def test_a_voltage_comes_out_as_it_went_in(tens_of_nanovolts: int, number: int, epoch: int):
    decoded = FRAMES.decode(*FRAMES.encode_voltage(tens_of_nanovolts * 1e-8, number, epoch))
    assert decoded is not None
    assert decoded.number("Voltage") == pytest.approx(tens_of_nanovolts * 1e-8, abs=1e-14)
    assert (decoded.number("Counter"), decoded.number("Epoch")) == (number % 256, epoch)


@given(st.binary(max_size=8), st.sampled_from([768, 784, 785, 786, 787, 788, 0x7FF]))
def test_whatever_comes_is_decoded_or_refused(data: bytes, can_id: int):
    frame = FRAMES.decode(can_id, data)
    assert frame is None or len(data) == 8


@given(st.sets(st.integers(0, 63), min_size=1, max_size=3))
def test_up_to_three_wrong_bits_are_always_noticed(bits: set[int]):
    can_id, data = FRAMES.encode_voltage(1.23456789, 42, 7)
    assert FRAMES.decode(can_id, (int.from_bytes(data) ^ sum(1 << bit for bit in bits)).to_bytes(8)) is None


@given(st.integers(1, 0xFFFF), st.integers(0, 48))
def test_a_burst_of_wrong_bits_is_always_noticed(burst: int, place: int):
    can_id, data = FRAMES.encode_voltage(-3.3, 0, 0)
    assert FRAMES.decode(can_id, (int.from_bytes(data) ^ burst << place).to_bytes(8)) is None


def test_a_frame_under_another_identifier_is_refused():
    _, data = FRAMES.encode_voltage(1.0, 0, 0)
    assert FRAMES.decode(787, data) is None


def test_the_checksum_is_the_published_one():
    can_id, data = FRAMES.encode("Identity", {"Serial": 0, "Product": 1, "Firmware": 0})
    register = 0xFFFF  # CRC-16/CCITT-FALSE bit by bit: polynomial 1021h, start FFFFh, nothing reflected
    for octet in can_id.to_bytes(2, "little") + data[:6]:
        register ^= octet << 8
        for _ in range(8):
            register = (register << 1 ^ (0x1021 if register & 0x8000 else 0)) & 0xFFFF
    assert int.from_bytes(data[6:]) == register


def test_overload_and_nan_have_names_on_the_bus():
    for sent_v in (math.inf, 9.9e37, -50.0):
        assert FRAMES.decode(*FRAMES.encode_voltage(sent_v, 0, 0)).number("Voltage") == 9.9e37
    decoded = FRAMES.decode(*FRAMES.encode_voltage(math.nan, 0, 0))
    assert math.isnan(decoded.number("Voltage"))


def test_a_value_that_does_not_fit_is_refused():
    with pytest.raises(ValueError, match="Command"):
        FRAMES.encode("Command", {"Epoch": 256, "Samples": 1, "Rate": 1.0})


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        ("BO_ 788 Identity", "BO_ 788 Nobody", "no message Identity"),
        ('SG_ Counter : 32|8@1+ (1,0) [0|255] "" Host\n SG_ Epoch : 40', "SG_ Epoch : 40", "no signal Counter"),
        ("SG_ CRC : 55|16@0+", "SG_ CRC : 55|8@0+", "CRC of message .* is not two whole bytes"),
        ("SG_ Temperature", "SG_ Warmth", "Temperature of the DBC file has no signal Temperature"),
    ],
)
def test_a_dbc_file_that_lacks_something_is_refused(old: str, new: str, sentence: str):
    text = SHIPPED.replace(old, new)
    assert text != SHIPPED
    text = "\n".join(line for line in text.splitlines() if not line.startswith(("CM_", "VAL_")))
    with pytest.raises(ValueError, match=sentence):
        DaqFrames(load_string(text, "dbc"))


def test_what_is_no_dbc_file_is_refused(tmp_path):
    path = tmp_path / "no.dbc"
    path.write_text("hello")
    with pytest.raises(ValueError, match=r"no\.dbc is no DBC file"):
        DaqFrames.from_file(path)


def test_frames_in_order_make_a_whole_collection():
    collection = Collection(300, epoch=1)
    for i in range(300):
        assert not collection.ended
        collection.take(voltage(i))
    assert (collection.ended, collection.missing, collection.lost, collection.doubled) == (True, 0, 0, 0)


def test_frames_of_another_epoch_are_passed_by():
    collection = Collection(2, epoch=1)
    collection.take(voltage(0, epoch=2))
    assert (collection.missing, collection.doubled) == (2, 0)


@given(st.sets(st.integers(0, 299), max_size=60), st.sets(st.integers(0, 299), max_size=20))
def test_lost_and_doubled_frames_are_counted(lost: set[int], doubled: set[int]):
    collection = Collection(300, epoch=1)
    for i in range(300):
        for _ in range((i not in lost) + (i not in lost and i in doubled)):
            collection.take(voltage(i))
    assert collection.missing == len(lost)
    assert collection.doubled == len(doubled - lost)


def test_the_temperature_is_the_mean_of_its_frames():
    collection = Collection(1, epoch=1)
    assert collection.temperature_degc is None
    for degc in (22.0, 23.0):
        collection.take(Frame(name="Temperature", signals={"Temperature": degc, "Epoch": 1}))
    assert collection.temperature_degc == 22.5
