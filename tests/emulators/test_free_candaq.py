"""A DAQ of somebody else, which sends by itself, through the bus."""

import threading
from contextlib import contextmanager

import can
import numpy as np
import pytest
from cantools.database import load_string

import tumble.drivers.candaq.free
from tumble.drivers.candaq import DaqFrames
from tumble.drivers.candaq.free import FreeRunningDaq
from tumble.drivers.clock import SystemClock
from tumble.drivers.errors import DeviceError, NoReplyError
from tumble.drivers.links.can_address import CanAddress
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.protocols import Reconnectable, Remarking, Sampler

DBC = """VERSION ""

BU_: Logger

BO_ 512 ADC: 6 Logger
 SG_ U : 0|32@1- (1E-006,0) [0|0] "V" Logger
 SG_ Seq : 32|8@1+ (1,0) [0|0] "" Logger
 SG_ T : 40|8@1- (1,0) [0|0] "" Logger
"""
NAMES = {"Voltage": {"Voltage": "ADC.U", "Counter": "ADC.Seq"}, "Temperature": {"Temperature": "ADC.T"}}
RATE_HZ = 500.0


@contextmanager
def sending(channel: str, numbers, data=lambda number: (2_500_000).to_bytes(4, "little") + bytes([number % 256, 23])):
    """A logger that sends frames with these numbers, evenly."""
    leaving = threading.Event()

    def send():
        with can.Bus(interface="virtual", channel=channel) as bus:
            for number in numbers:
                if leaving.wait(1.0 / RATE_HZ):
                    return
                bus.send(can.Message(arbitration_id=512, is_extended_id=False, data=data(number)))

    thread = threading.Thread(target=send, daemon=True)
    thread.start()
    try:
        yield
    finally:
        leaving.set()
        thread.join()


@contextmanager
def daq_on(channel: str):
    link = CanLink(CanAddress(interface="virtual", channel=channel))
    try:
        yield FreeRunningDaq(link, DaqFrames(load_string(DBC, "dbc"), NAMES), SystemClock())
    finally:
        link.close()


def test_a_block_is_the_next_frames_that_come():
    with daq_on("free-1") as daq, sending("free-1", range(10_000)):
        fits: Sampler = daq
        assert isinstance(fits, Reconnectable) and isinstance(fits, Remarking)
        assert daq.identify().model == "CAN DAQ ADC"
        block = daq.acquire(40, RATE_HZ)
    assert block.voltage_v == pytest.approx(np.full(40, 2.5))
    assert block.temperature_degc == 23.0


def test_frames_that_were_lost_twice_are_told():
    with (
        daq_on("free-2") as daq,
        sending("free-2", range(0, 100_000, 3)),
        pytest.raises(DeviceError, match="voltage frames did not follow the one before, twice in a row"),
    ):
        daq.acquire(20, RATE_HZ)


def test_a_rate_that_is_not_its_own_is_told(monkeypatch):
    monkeypatch.setattr(tumble.drivers.candaq.free, "_RATE_S", 0.05)
    with (
        daq_on("free-3") as daq,
        sending("free-3", range(10_000)),
        pytest.raises(DeviceError, match="samples a second by itself, and 100 were asked for; write the rate"),
    ):
        daq.acquire(20, 100.0)


def test_a_silent_one_is_told_with_what_was_dropped(monkeypatch):
    monkeypatch.setattr(tumble.drivers.candaq.free, "FIRST_FRAME_S", 0.3)
    with daq_on("free-4") as daq, sending("free-4", range(10_000), data=lambda _: b"\x01"):
        with pytest.raises(
            NoReplyError, match=r"sent no ADC within 0.3 s \(frames of another length .* dropped: \d+\)"
        ):
            daq.identify()
        assert "CAN DAQ: frames of another length than the DBC file says dropped" in daq.remarks()[0]


THREE_DBC = """VERSION ""

BU_: Logger

BO_ 512 XY: 8 Logger
 SG_ X : 0|32@1- (1E-006,0) [0|0] "V" Logger
 SG_ Y : 32|32@1- (1E-003,0) [0|0] "mV" Logger

BO_ 513 ZT: 5 Logger
 SG_ Z : 0|32@1- (1E-006,0) [0|0] "V" Logger
 SG_ T : 32|8@1- (1,0) [0|0] "degC" Logger
"""


def three_on(folder, channel):
    from tumble.drivers.candaq.declaration import CAN, CanDaqTable
    from tumble.drivers.driver import Bench
    from tumble.drivers.links.opened import Links

    (folder / "three.dbc").write_text(THREE_DBC, "utf-8")
    table = CanDaqTable(
        driver="can",
        url=f"virtual:{channel}",
        dbc="three.dbc",
        voltages={"u_x_v": "XY.X", "u_y_v": "XY.Y", "u_z_v": "ZT.Z"},
        temperatures={"u_z_v": "ZT.T"},
    )
    links = Links()
    return CAN.connect(table, Bench(clock=SystemClock(), links=links, folder=folder, eyepiece=lambda _: None)), links


def test_several_voltages_are_taken_at_the_same_time(tmp_path):
    def counting(number):
        return (number * 1000).to_bytes(4, "little") + (number * 1000).to_bytes(4, "little")

    leaving = threading.Event()

    def send_z():
        with can.Bus(interface="virtual", channel="three") as bus:
            while not leaving.wait(1.0 / RATE_HZ):
                bus.send(can.Message(arbitration_id=513, is_extended_id=False, data=bytes([0, 0, 0, 0, 31])))

    daq, links = three_on(tmp_path, "three")
    thread = threading.Thread(target=send_z, daemon=True)
    thread.start()
    with sending("three", range(2000), counting):
        daq.identify()
        block = daq.acquire(50, RATE_HZ)
    leaving.set()
    thread.join()
    links.close()
    assert list(block.channels) == ["u_x_v", "u_y_v", "u_z_v"]
    assert abs(block.channels["u_x_v"][0] - block.channels["u_y_v"][0]) <= 2e-3  # of the same frames, or the next
    assert dict(block.temperatures_degc) == {"u_z_v": 31.0}


def test_a_thermometer_of_no_channel_is_refused():
    from tumble.drivers.candaq.declaration import CanDaqTable

    with pytest.raises(ValueError, match="temperatures names u_w_v, which is none of voltages"):
        CanDaqTable(driver="can", url="virtual:x", dbc="d", voltages={"u_x_v": "A.B"}, temperatures={"u_w_v": "A.C"})
