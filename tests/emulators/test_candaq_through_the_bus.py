import time

import can
import numpy as np
import pytest
from can_bench import DEADLINE_S, CanBench, can_bench, raised
from cantools.database import load_string

import tumble.drivers.candaq.daq
from tumble.drivers.candaq import DaqFrames
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.protocols import Reconnectable, Sampler
from tumble.emulators.candaq_faults import LOST_FRAMES

OTHER_DBC = """VERSION ""

NS_ :

BS_:

BU_: A B

BO_ 2566844672 Command: 8 A
 SG_ Epoch : 7|8@0+ (1,0) [0|0] "" B
 SG_ Samples : 15|16@0+ (1,0) [0|0] "" B
 SG_ Rate : 39|32@0- (1,0) [0|0] "Hz" B

BO_ 2566844673 Started: 8 B
 SG_ Epoch : 7|8@0+ (1,0) [0|0] "" A
 SG_ Samples : 15|16@0+ (1,0) [0|0] "" A
 SG_ Rate : 39|32@0- (1,0) [0|0] "Hz" A

BO_ 2566844674 Voltage: 8 B
 SG_ Counter : 7|8@0+ (1,0) [0|0] "" A
 SG_ Epoch : 15|8@0+ (1,0) [0|0] "" A
 SG_ Voltage : 23|32@0- (1E-006,0) [-20|20] "V" A
 SG_ CRC : 55|16@0+ (1,0) [0|0] "" A

BO_ 2566844675 Identity: 6 B
 SG_ Serial : 7|32@0+ (1,0) [0|0] "" A
 SG_ Product : 39|8@0+ (1,0) [0|0] "" A
 SG_ Firmware : 47|8@0+ (1,0) [0|0] "" A

SIG_VALTYPE_ 2566844672 Rate : 1;
SIG_VALTYPE_ 2566844673 Rate : 1;
"""


@pytest.fixture(autouse=True)
def impatient(monkeypatch):
    monkeypatch.setattr(tumble.drivers.candaq.daq, "LATENESS_S", 1.0)
    monkeypatch.setattr(tumble.drivers.candaq.daq, "REPLY_TIMEOUT_S", 0.2)


@pytest.fixture
def bench():
    with can_bench() as bench:
        yield bench


def daq_fault(kind: str, **more) -> dict:
    return {"device": "daq", "kind": kind, "at": {"command": 1, "containing": "acquire"}} | more


def test_the_daq_says_who_it_is(bench: CanBench):
    identity = bench.daq().identify()
    assert (identity.model, identity.serial, identity.firmware) == ("tumble CAN DAQ", "310001", "1")


def test_the_daq_fits_the_protocols(bench: CanBench):
    daq: Sampler = bench.daq()
    assert isinstance(daq, Reconnectable)


def test_a_block_has_the_voltage_and_temperature_of_the_world(bench: CanBench):
    block = bench.daq().acquire(300, 1000.0)
    assert block.voltage_v == pytest.approx(np.full(300, block.voltage_v[0]), abs=1e-12)
    assert block.voltage_v[0] == pytest.approx(bench.world.world.noise_free_voltage(["face-up"], [0.0])[0], abs=1e-6)
    assert block.temperature_degc == pytest.approx(23.0, abs=0.5)
    assert 0.0 <= block.device_time_s <= bench.clock.monotonic_s()
    assert block.rate_hz == 1000.0


def test_an_acquisition_takes_its_time(bench: CanBench):
    began_s = bench.clock.monotonic_s()
    bench.daq().acquire(50, 100.0)
    assert bench.clock.monotonic_s() - began_s >= 0.5


@pytest.mark.parametrize("kind", ["frames_lost", "double", "cut", "garble", "wrong_checksum"])
def test_a_spoilt_block_is_taken_once_more(kind: str):
    with can_bench(daq_fault(kind)) as bench:
        block = bench.daq().acquire(40, 1000.0)
        assert len(block.voltage_v) == 40
        assert bench.world.world.counts.acquisitions == 2


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [
        ("frames_lost", f"{LOST_FRAMES} of 40 voltage frames were lost and 0 came twice, twice in a row"),
        ("garble", "1 of 40 voltage frames were lost and 0 came twice"),
        ("reorder", "1 of 40 voltage frames were lost and 1 came twice"),
        ("double", "0 of 40 voltage frames were lost and 1 came twice"),
    ],
)
def test_a_block_spoilt_twice_is_an_error_with_its_count(kind: str, sentence: str):
    with (
        can_bench(daq_fault(kind, at={"command": 1}, times=2)) as bench,
        pytest.raises(DeviceError, match=sentence),
    ):
        bench.daq().acquire(40, 1000.0)


def test_frames_lost_at_the_end_are_missed():
    with can_bench(daq_fault("frames_lost")) as bench:
        assert len(bench.daq().acquire(2, 1000.0).voltage_v) == 2
        assert bench.world.world.counts.acquisitions == 2


def test_a_frame_that_comes_late_is_waited_for():
    with can_bench(daq_fault("late", lasts_s=0.5)) as bench:
        bench.daq().acquire(10, 1000.0)
        assert bench.world.world.counts.acquisitions == 1


def test_nan_and_overload_are_passed_as_they_are():
    with can_bench(daq_fault("nan"), {"device": "daq", "kind": "overload", "at": {"point": 1}}) as bench:
        daq = bench.daq()
        assert np.flatnonzero(np.isnan(daq.acquire(10, 1000.0).voltage_v)).tolist() == [5]
        assert daq.acquire(10, 1000.0).voltage_v[5] == 9.9e37


def test_frames_of_an_earlier_acquisition_are_passed_by(bench: CanBench):
    frames = DaqFrames.from_file()
    daq = bench.daq()
    with can.Bus(interface="virtual", channel=bench.channel) as other:
        for epoch in range(3, 9):
            can_id, data = frames.encode_voltage(9.0, 0, epoch)
            other.send(can.Message(arbitration_id=can_id, data=data, is_extended_id=False))
    assert (daq.acquire(20, 1000.0).voltage_v < 9.0).all()


def test_a_daq_that_is_off_the_bus_is_a_lost_link_until_it_is_back():
    with can_bench(daq_fault("bus_off", lasts_s=1.0)) as bench:
        daq = bench.daq()
        assert "bus-off" in str(raised(LinkLostError, lambda: daq.acquire(100, 10.0)))
        with pytest.raises(LinkLostError, match="no answer"):
            daq.reconnect()
        deadline_s = time.monotonic() + DEADLINE_S
        while time.monotonic() < deadline_s:
            try:
                daq.reconnect()
                break
            except LinkLostError:
                continue
        assert daq.identify().serial == "310001"


def test_another_daq_in_its_place_has_another_serial_number():
    with can_bench({"device": "daq", "kind": "swapped", "at": {"time_s": 0.0}}) as bench:
        assert bench.daq().identify().serial == "310002"


def test_a_bus_without_a_daq_gives_no_answer():
    silent = {"device": "daq", "kind": "power_loss", "at": {"time_s": 0.0}, "lasts_s": 60.0}
    with can_bench(silent) as bench, pytest.raises(NoReplyError, match="no answer in 3 tries"):
        bench.daq().acquire(10, 100.0)


@pytest.mark.parametrize(("samples", "rate_hz"), [(0, 1.0), (1 << 24, 1.0), (1, 0.0), (1, float("nan"))])
def test_what_cannot_be_taken_is_refused(bench: CanBench, samples: int, rate_hz: float):
    with pytest.raises(DeviceError, match="cannot be taken"):
        bench.daq().acquire(samples, rate_hz)


def test_a_dbc_file_with_other_places_and_byte_order_serves_as_well():
    frames = DaqFrames(load_string(OTHER_DBC, "dbc"))
    with can_bench(frames=frames) as bench:
        daq = bench.daq(frames)
        assert daq.identify().serial == "310001"
        block = daq.acquire(300, 1000.0)
        expected_v = bench.world.world.noise_free_voltage(["face-up"], [0.0])[0]
        assert block.voltage_v[0] == pytest.approx(expected_v, abs=1e-6)
        assert block.temperature_degc is None
