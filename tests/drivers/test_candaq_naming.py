"""DBC files of others: in cp1252 as most tools write them, and with names of their own."""

from importlib.resources import files

import can
import pytest
from cantools.database import load_string
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.candaq import DaqFrames
from tumble.drivers.candaq.declaration import CanDaqTable
from tumble.drivers.candaq.frames import SpoiltFrameError
from tumble.drivers.candaq.inbox import Inbox
from tumble.drivers.links.tally import Tally

OURS = (files("tumble.drivers.candaq") / "tumble_daq.dbc").read_text("utf-8")

LOGGER = """VERSION ""

BU_: Logger

BO_ 512 ADC_1: 8 Logger
 SG_ Bank M : 0|8@1+ (1,0) [0|0] "" Logger
 SG_ AIN0 m0 : 8|24@1- (0.001,0) [0|0] "mV" Logger
 SG_ AIN1 m1 : 8|24@1- (0.001,0) [0|0] "mV" Logger
 SG_ Seq : 32|16@1+ (1,0) [0|0] "" Logger

BO_ 2566844672 Board: 3 Logger
 SG_ T : 0|16@1+ (0.1,0) [0|0] "K" Logger
"""
"""A logger that sends by itself: two channels in turn, and its own temperature under an extended identifier."""

NAMES = {
    "Voltage": {"Voltage": "ADC_1.AIN0", "Counter": "ADC_1.Seq"},
    "Temperature": {"Temperature": "Board.T"},
}


def logger() -> DaqFrames:
    return DaqFrames(load_string(LOGGER, "dbc"), NAMES)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252"])
@pytest.mark.parametrize("line_end", ["\n", "\r\n"])
def test_a_degree_sign_is_read_however_it_was_saved(tmp_path, encoding: str, line_end: str):
    path = tmp_path / "daq.dbc"
    path.write_bytes(OURS.replace('"degC"', '"°C"').replace("\n", line_end).encode(encoding))
    assert b'C"' in path.read_bytes()
    assert DaqFrames.from_file(path).has("Temperature")


def test_bytes_that_are_no_text_in_either_are_no_reason_to_refuse_a_file(tmp_path):
    path = tmp_path / "daq.dbc"
    path.write_bytes(OURS.replace('"degC"', '"\x81C"').encode("latin-1"))
    assert DaqFrames.from_file(path).has("Temperature")


def test_named_signals_are_read_in_our_units():
    frames = logger()
    (voltage,) = frames.read(512, False, bytes.fromhex("00 40E201 2A00 0000"))
    assert voltage.number("Voltage") == pytest.approx(0.123456)
    assert voltage.number("Counter") == 42
    (board,) = frames.read(2566844672 & 0x1FFFFFFF, True, bytes.fromhex("740B00"))
    assert board.number("Temperature") == pytest.approx(20.05)
    assert (frames.free_running, frames.counts) == (True, 65536)


def test_another_branch_of_a_multiplexer_is_no_voltage():
    assert logger().read(512, False, bytes.fromhex("01 40E201 2A00 0000")) == []


@pytest.mark.parametrize(
    ("can_id", "extended", "data", "kind"),
    [
        (512, False, "07 40E201 2A00 0000", "frames that the DBC file does not explain"),
        (512, False, "00 40E201 2A00 0000 00", "frames of another length than the DBC file says"),
        (512, False, "00 40E2", "frames of another length than the DBC file says"),
        (512, False, "", "frames of another length than the DBC file says"),
        (512, True, "00 40E201 2A00 0000", "frames with an identifier of another length"),
    ],
)
def test_what_the_dbc_file_does_not_say_is_spoilt(can_id: int, extended: bool, data: str, kind: str):
    with pytest.raises(SpoiltFrameError, match=kind):
        logger().read(can_id, extended, bytes.fromhex(data))


class Line:
    """As much of a link as an inbox needs."""

    def __init__(self):
        self.tally = Tally("CAN bus")

    def subscribe(self, listener):
        self.deliver = listener

    def check(self):
        pass


@given(
    st.lists(st.tuples(st.sampled_from([512, 370360320, 0x7FF]), st.booleans(), st.binary(max_size=64)), max_size=20)
)
def test_whatever_comes_the_inbox_goes_on_and_counts_it(frames):
    line = Line()
    inbox = Inbox(line, logger())
    for can_id, extended, data in frames:
        line.deliver(can.Message(arbitration_id=can_id, is_extended_id=extended, data=data, is_fd=len(data) > 8))
    inbox.forget()
    line.deliver(can.Message(arbitration_id=512, is_extended_id=False, data=bytes.fromhex("0040E2012A000000")))
    assert inbox.next(1e12).number("Counter") == 42


def test_the_wait_for_a_frame_is_broken_off_where_that_is_wanted():
    def stop():
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        Inbox(Line(), logger(), stop).next(1e12)


def test_what_was_dropped_is_told_with_its_number_and_an_example():
    line = Line()
    inbox = Inbox(line, logger())
    for _ in range(3):
        line.deliver(can.Message(arbitration_id=512, is_extended_id=False, data=b"\x07" * 8))
    assert inbox.remarks() == (
        "CAN DAQ: frames that the DBC file does not explain dropped: 3 (the first: 200h 0707070707070707)",
    )
    assert inbox.words == " (frames that the DBC file does not explain dropped: 3)"
    assert inbox.remarks() == ()


@pytest.mark.parametrize(
    ("names", "sentence"),
    [
        ({"Voltage": {"Voltage": "ADC_2.AIN0"}}, "has no such message; it has ADC_1, Board"),
        (
            {"Voltage": {"Voltage": "ADC_1.AIN9"}},
            "ADC_1 of the DBC file has no signal AIN9; it has AIN0, AIN1, Bank, Seq",
        ),
        ({"Voltage": {"Voltage": "ADC_1.AIN0", "Counter": "Board.T"}}, "Voltage is in the messages ADC_1 and Board"),
        ({"Temperature": {"Temperature": "Board.T"}}, "does not say which signal is Voltage.Voltage"),
        (
            {"Voltage": {"Voltage": "ADC_1.AIN0"}, "Command": {"Epoch": "Board.T"}},
            "a DAQ that is told to begin needs it",
        ),
        ({"Voltage": {"Volts": "ADC_1.AIN0"}}, "names Voltage.Volts, and there may be Command.Epoch"),
        ({"Voltage": {"Voltage": "ADC_1"}}, "no such message"),
        ({"Voltage": {"Voltage": "ADC_1.AIN0"}, "Time": {}}, "Time names no signal"),
        ({"Voltage": {"Voltage": "Board.T"}}, "T of the DBC file is in K, which is no unit of a voltage"),
    ],
)
def test_a_name_that_is_wrong_is_told_with_what_there_is(names, sentence: str):
    with pytest.raises(ValueError, match=sentence.replace("[", r"\[")):
        DaqFrames(load_string(LOGGER, "dbc"), names)


def test_a_dbc_file_of_others_without_names_says_what_to_write():
    with pytest.raises(
        ValueError, match=r"no message Command; .* write in \[daq.signals\] what .* it has ADC_1, Board"
    ):
        DaqFrames(load_string(LOGGER, "dbc"))


def test_names_without_a_file_are_refused():
    with pytest.raises(ValueError, match="give dbc, too"):
        CanDaqTable(driver="can", url="virtual:x", signals=NAMES)
