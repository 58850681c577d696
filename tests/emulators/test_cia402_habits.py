"""Drives as they really are, through the bus: each habit from a public report."""

import time

import pytest
from can_bench import can_bench, rested, until
from canopen import SdoAbortedError

import tumble.drivers.cia402.node
from tumble.drivers.cia402 import objects
from tumble.emulators.cia402_drive import Drive


@pytest.fixture(autouse=True)
def impatient(monkeypatch):
    monkeypatch.setattr(tumble.drivers.cia402.node, "REPLY_TIMEOUT_S", 0.1)


def habit(kind: str, **more) -> dict:
    return {"device": "head", "kind": kind, "at": {"time_s": 0.0}} | more


def known(bench, kind: str) -> None:
    """Wait until the drive has taken its habit on."""
    deadline_s = time.monotonic() + 5.0
    while kind not in bench.drive.habits._has:
        assert time.monotonic() < deadline_s


@pytest.mark.parametrize("lag_s", [0.002, 0.05, 0.3])
def test_a_second_homing_is_over_when_the_drive_is_at_its_reference(lag_s: float):
    with can_bench(habit("old_bits", lasts_s=lag_s)) as bench:
        known(bench, "old_bits")
        head = bench.homed_head()
        head.start_move(90.0)
        assert rested(head).angle_deg == 90.0
        head.home()
        assert not head.status().referenced or bench.world.head.status().angle_deg == 0.0
        assert until(head, lambda status: not status.moving).referenced
        assert bench.world.head.status().angle_deg == 0.0


def test_a_move_is_under_way_while_an_old_bit_says_arrived():
    with can_bench(habit("old_bits", lasts_s=0.3)) as bench:
        known(bench, "old_bits")
        head = bench.homed_head()
        head.start_move(700.0)
        assert head.status().moving
        assert rested(head).angle_deg == 700.0


def test_a_bit_that_flickers_at_rest_is_no_motion():
    with can_bench(habit("flicker")) as bench:
        known(bench, "flicker")
        head = bench.homed_head()
        head.start_move(30.0)
        assert rested(head).angle_deg == 30.0
        assert not any(head.status().moving for _ in range(6))


def test_a_drive_without_what_is_optional_says_what_is_known_and_is_used():
    with can_bench(habit("without_options")) as bench:
        known(bench, "without_options")
        head = bench.homed_head()
        identity = head.identify()
        assert (identity.model, identity.serial, identity.firmware) == (
            "CiA 402 drive (vendor 1h, product 402h)",
            "",
            "",
        )
        head.start_move(30.0)
        assert rested(head).angle_deg == 30.0
        head.stop()
        assert not rested(head).moving


OPTIONAL = [
    (objects.DEVICE_NAME, 0),
    (objects.SOFTWARE_VERSION, 0),
    (objects.IDENTITY, objects.PRODUCT),
    (objects.IDENTITY, objects.SERIAL),
]


@pytest.mark.parametrize("place", OPTIONAL)
@pytest.mark.parametrize("code", [0x06020000, 0x06090011, 0x06010000, 0x08000000, 0x08000022])
def test_each_optional_object_may_be_refused_with_any_code(monkeypatch, place, code: int):
    right = Drive.value

    def value(drive, index, subindex):
        if (index, subindex) == place:
            raise SdoAbortedError(code)
        return right(drive, index, subindex)

    monkeypatch.setattr(Drive, "value", value)
    with can_bench() as bench:
        identity = bench.head().identify()
    assert (identity.serial == "402001") == (place != OPTIONAL[3])
    assert ("product" in identity.model) == (place != OPTIONAL[2])
    assert identity.model.startswith("tumble" if place != OPTIONAL[0] else "CiA 402 drive (vendor 1h")


@pytest.mark.parametrize("index", [objects.QUICK_STOP_OPTION, objects.HEARTBEAT_MS])
@pytest.mark.parametrize("code", [0x06010000, 0x06020000, 0x06010002, 0x06090030, 0x08000020])
def test_what_a_drive_need_not_let_be_set_may_be_refused_with_any_code(monkeypatch, index: int, code: int):
    right = Drive.set_value

    def set_value(drive, at, value):
        if at == index:
            raise SdoAbortedError(code)
        right(drive, at, value)

    monkeypatch.setattr(Drive, "set_value", set_value)
    with can_bench() as bench:
        head = bench.homed_head()
        head.start_move(9.0)
        assert rested(head).angle_deg == 9.0


def test_an_optional_object_may_be_passed_over_in_silence(monkeypatch):
    from tumble.emulators.cia402_bus import DriveNetwork

    right = DriveNetwork.send_message

    def send_message(network, can_id, data, remote=False):
        if not (can_id == 0x581 and data[1:3] == b"\x08\x10"):
            right(network, can_id, data, remote)

    monkeypatch.setattr(DriveNetwork, "send_message", send_message)
    with can_bench() as bench:
        assert bench.head().identify().model == "CiA 402 drive (vendor 1h, product 402h)"


def test_a_mode_that_is_shown_only_once_enabled_is_waited_for_then():
    with can_bench(habit("mode_shown_late")) as bench:
        known(bench, "mode_shown_late")
        head = bench.homed_head()
        head.start_move(30.0)
        assert rested(head).angle_deg == 30.0
        assert bench.head().status().angle_deg == 30.0


def test_frames_that_nobody_can_use_are_dropped_counted_and_told():
    with can_bench(habit("foreign_frames", at={"command": 1, "containing": "controlword 001F"})) as bench:
        head = bench.homed_head()
        head.start_move(30.0)
        assert rested(head).angle_deg == 30.0
        said = " ".join(until_told(head))
    for kind in (
        "error frames dropped",
        "remote frames dropped",
        "CAN FD frames dropped",
        "messages dropped that cannot",
    ):
        assert kind in said


def until_told(head) -> list[str]:
    deadline_s, told = time.monotonic() + 5.0, []
    while len(told) < 4:
        told += head.remarks()
        assert time.monotonic() < deadline_s, told
    return told
