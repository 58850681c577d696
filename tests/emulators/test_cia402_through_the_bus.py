import time
from contextlib import suppress

import pytest
from can_bench import DEADLINE_S, CanBench, can_bench, raised, rested, until
from canopen import SdoAbortedError

import tumble.drivers.cia402.head
import tumble.drivers.cia402.node
from tumble.drivers.cia402 import Cia402Head, objects, states
from tumble.drivers.errors import DeviceError, LimitError, LinkLostError, NoReplyError
from tumble.drivers.protocols import Positioner, Reconnectable, Resettable
from tumble.emulators.cia402_drive import Drive

START = {"command": 1, "containing": "controlword 003F"}
"""The first set-point."""


@pytest.fixture(autouse=True)
def impatient(monkeypatch):
    monkeypatch.setattr(tumble.drivers.cia402.node, "PATIENCE_S", 0.6)
    monkeypatch.setattr(tumble.drivers.cia402.node, "REPLY_TIMEOUT_S", 0.1)


@pytest.fixture
def bench():
    with can_bench() as bench:
        yield bench


def head_fault(kind: str, **more) -> dict:
    return {"device": "head", "kind": kind, "at": START} | more


def lost(head: Cia402Head, angle_deg: float) -> Exception:
    """The error of a move whose link is lost at its beginning."""
    try:
        head.start_move(angle_deg)
    except LinkLostError as error:
        return error
    return raised(LinkLostError, head.status)


def stalled(bench: CanBench) -> Cia402Head:
    """A head whose first move got stuck half-way, and who has told of it."""
    head = bench.homed_head()
    with suppress(DeviceError):  # it may be that early
        head.start_move(90.0)
    error = raised(DeviceError, head.status)
    assert "following error" in str(error)
    assert "8611h" in str(error)
    return head


def reconnected(head: Cia402Head) -> None:
    deadline_s = time.monotonic() + DEADLINE_S
    while True:
        try:
            head.reconnect()
        except LinkLostError:
            assert time.monotonic() < deadline_s
        else:
            return


def test_the_drive_says_who_it_is(bench: CanBench):
    identity = bench.head().identify()
    assert (identity.serial, identity.firmware) == ("402001", "1.0")
    assert identity.model == "tumble CiA 402 drive (vendor 1h, product 402h)"


def test_the_head_fits_the_protocols(bench: CanBench):
    head: Positioner = bench.head()
    assert isinstance(head, Reconnectable)
    assert (head.limits_deg, head.speed_deg_s) == ((-180.0, 760.0), 20.0)


def test_a_drive_that_was_switched_on_has_no_reference_and_does_not_move(bench: CanBench):
    head = bench.head()
    assert not head.status().referenced
    with pytest.raises(DeviceError, match="lost its reference"):
        head.start_move(10.0)
    assert bench.world.head.status().angle_deg == 0.0


def test_homing_gives_the_reference_and_another_master_hears_of_it(bench: CanBench):
    assert rested(bench.homed_head()).referenced
    assert bench.head().status().referenced


def test_a_move_ends_where_it_was_sent(bench: CanBench):
    head = bench.homed_head()
    head.start_move(-172.345)  # long enough to be seen under way on a slow computer
    assert until(head, lambda status: status.moving).moving
    assert rested(head).angle_deg == -172.345
    assert bench.world.head.status().angle_deg == -172.345


def test_a_move_under_way_is_replaced(bench: CanBench):
    head = bench.homed_head()
    head.start_move(400.0)
    head.start_move(-20.0)
    assert rested(head).angle_deg == -20.0


@pytest.mark.parametrize("angle_deg", [-180.001, 760.001, float("nan"), float("inf")])
def test_nothing_moves_outside_the_limits(bench: CanBench, angle_deg: float):
    head = bench.homed_head()
    with pytest.raises(LimitError, match="outside the limits -180 to 760 deg"):
        head.start_move(angle_deg)
    assert head.status().angle_deg == 0.0


def test_what_the_drive_refuses_is_told_in_words(bench: CanBench):
    head = bench.homed_head(limits_deg=(-1000.0, 1000.0))
    with pytest.raises(DeviceError, match=r"refused object 607Ah .*: value range of parameter exceeded"):
        head.start_move(900.0)


def test_a_stop_in_mid_move_is_a_standstill_and_the_next_move_goes(bench: CanBench):
    head = bench.homed_head()
    head.start_move(700.0)
    until(head, lambda status: status.angle_deg > 1.0)
    head.stop()
    stopped = head.status()
    assert not stopped.moving
    assert 1.0 < stopped.angle_deg < 700.0
    assert head.status().angle_deg == stopped.angle_deg
    head.start_move(30.0)
    assert rested(head).angle_deg == 30.0


def test_a_head_left_moving_is_stopped_by_whoever_connects(bench: CanBench):
    bench.homed_head().start_move(700.0)
    assert not bench.head().status().moving


def test_a_stall_is_told_once_as_a_following_error_and_then_the_standstill_can_be_read():
    with can_bench(head_fault("stall")) as bench:
        stuck = stalled(bench).status()
        assert (stuck.moving, stuck.angle_deg) == (False, 45.0)


def test_a_drive_that_is_stopped_before_it_notices_its_stall_comes_to_rest(monkeypatch):
    monkeypatch.setattr(Drive, "update", lambda _: None)
    with can_bench(head_fault("stall")) as bench:
        head = bench.head()
        monkeypatch.setattr(head, "_homed", True)
        head.start_move(90.0)
        head.stop()
        assert not head.status().moving


def test_a_stalled_drive_moves_again_only_after_its_fault_was_reset():
    with can_bench(head_fault("stall")) as bench:
        head = stalled(bench)
        for refused in (head.home, lambda: head.start_move(0.0)):
            with pytest.raises(DeviceError, match="following error"):
                refused()
        head.reset_fault()
        head.home()
        rested(head)
        head.start_move(90.0)
        assert rested(head).angle_deg == 90.0


def test_a_start_bit_that_was_left_is_taken_back_before_the_mode_changes(bench: CanBench, monkeypatch):
    head = bench.homed_head()
    head.start_move(9.0)
    rested(head)
    head._control(states.ENABLE | states.START)
    rested(head)
    words, right = [], Drive.set_value

    def set_value(drive, index, value):
        if index in (objects.CONTROLWORD, objects.MODE):
            words.append((index, value))
        right(drive, index, value)

    monkeypatch.setattr(Drive, "set_value", set_value)
    bench.head()
    assert words[:2] == [(objects.CONTROLWORD, states.ENABLE), (objects.MODE, 6)]


def test_a_fault_in_mid_run_is_not_reset_by_a_reconnect():
    with can_bench(head_fault("stall")) as bench:
        head = stalled(bench)
        head.reconnect()
        with pytest.raises(DeviceError, match="following error"):
            head.home()


def test_a_fault_whose_cause_is_still_there_is_told_to_whoever_starts_anew(bench: CanBench, statusword, monkeypatch):
    monkeypatch.setattr(tumble.drivers.cia402.head, "ANSWER_S", 0.2)
    statusword(setting=0x08, clearing=0x47)
    with pytest.raises(DeviceError, match="unknown error"):
        bench.head().reset_fault()


def test_a_drive_that_cannot_be_told_how_to_stop_is_stopped_its_own_way(bench: CanBench, monkeypatch):
    right = Drive.set_value

    def set_value(drive, index, value):
        if index == objects.QUICK_STOP_OPTION:
            raise SdoAbortedError(0x06020000)
        right(drive, index, value)

    monkeypatch.setattr(Drive, "set_value", set_value)
    head = bench.homed_head()
    head.start_move(700.0)
    head.stop()
    assert not rested(head).moving
    head.start_move(9.0)
    assert rested(head).angle_deg == 9.0


@pytest.mark.parametrize("kind", ["late", "cut", "double", "garble", "reorder", "wrong_checksum"])
@pytest.mark.parametrize("controlword", ["001F", "003F", "0002"])
def test_whatever_happens_to_an_answer_the_head_is_where_it_should_be(kind: str, controlword: str):
    at = {"command": 1, "containing": f"controlword {controlword}"}
    with can_bench(head_fault(kind, at=at, lasts_s=0.25)) as bench:
        head = bench.homed_head()
        head.start_move(90.0)
        assert rested(head).angle_deg == 90.0
        head.stop()
        assert not head.status().moving
        assert head.identify().serial == "402001"


def test_a_stall_on_the_way_to_the_reference_is_told_and_no_reference_found():
    homing = {"command": 2, "containing": "controlword 001F"}
    with can_bench(head_fault("stall", at=homing)) as bench:
        head = bench.homed_head()
        head.start_move(90.0)
        rested(head)
        head.home()
        assert "following error" in str(raised(DeviceError, head.status))
        assert not head.status().referenced


def test_a_search_for_the_reference_that_does_not_end_can_be_stopped():
    with can_bench(head_fault("moving_for_ever", at={"command": 1, "containing": "controlword 001F"})) as bench:
        head = bench.head()
        head.home()
        assert head.status().moving
        head.stop()
        assert not head.status().moving
        assert not head.status().referenced


def test_an_emergency_message_is_told_once_and_then_the_standstill_can_be_read():
    with can_bench(head_fault("emergency")) as bench:
        head = bench.homed_head()
        with suppress(DeviceError):  # it may be that early
            head.start_move(700.0)
        assert "excess temperature of the drive (code 4310h); remove the cause" in str(raised(DeviceError, head.status))
        assert not head.status().moving


def test_a_fault_that_was_reset_is_named_and_the_head_is_to_be_homed():
    with can_bench(head_fault("stall")) as bench:
        stalled(bench)
        other = bench.head()
        assert isinstance(other, Resettable)
        assert other.reset_fault() == "following error: the axis did not keep up with its set-point (code 8611h)"
        assert other.reset_fault() == ""
        assert not other.status().referenced
        other.home()
        assert rested(other).referenced


def test_an_overshoot_is_read_back():
    with can_bench(head_fault("overshoot")) as bench:
        head = bench.homed_head()
        head.start_move(30.0)
        assert rested(head).angle_deg == 30.5


def test_a_head_that_moves_for_ever_can_be_stopped():
    with can_bench(head_fault("moving_for_ever")) as bench:
        head = bench.homed_head()
        head.start_move(5.0)
        assert until(head, lambda status: status.angle_deg == 5.0).moving
        head.stop()
        assert not head.status().moving


def test_a_loss_of_power_loses_link_and_reference():
    with can_bench(head_fault("power_loss", lasts_s=0.3)) as bench:
        head = bench.homed_head()
        lost(head, 700.0)
        reconnected(head)
        assert not head.status().referenced
        head.home()
        assert until(head, lambda status: not status.moving).referenced
        assert bench.world.head.status().angle_deg == 0.0


def test_a_short_loss_of_power_is_seen_by_the_boot_up_message():
    end_of_start = {"command": 3, "containing": "controlword 000F"}
    with can_bench(head_fault("power_loss", at=end_of_start, lasts_s=0.0)) as bench:
        head = bench.homed_head()
        head.start_move(700.0)
        until(head, lambda status: not status.referenced and not status.moving)


def test_bus_off_is_a_lost_link_until_the_node_is_back():
    with can_bench(head_fault("bus_off", lasts_s=1.5)) as bench:
        head = bench.homed_head()
        assert "bus-off" in str(lost(head, 20.0))
        with pytest.raises(LinkLostError, match="no SDO answer"):
            head.reconnect()
        reconnected(head)
        assert rested(head).angle_deg == 20.0


def test_a_lost_heartbeat_is_a_lost_link():
    with can_bench(head_fault("heartbeat_lost", lasts_s=5.0)) as bench:
        head = bench.homed_head()
        assert "no heartbeat" in str(lost(head, 20.0))
        head.reconnect()
        assert head.status().angle_deg == 20.0


def test_another_drive_in_its_place_has_another_serial_number():
    with can_bench({"device": "head", "kind": "swapped", "at": {"time_s": 0.0}}) as bench:
        head = bench.head()
        deadline_s = time.monotonic() + DEADLINE_S
        while head.identify().serial != "402002":
            assert time.monotonic() < deadline_s


@pytest.fixture
def statusword(monkeypatch):
    """Has the drive say something else than it would: sets some bits of its statusword, and clears others."""
    right = Drive._statusword

    def say(setting: int = 0, clearing: int = 0) -> None:
        monkeypatch.setattr(Drive, "_statusword", lambda drive: right(drive) & ~clearing | setting)

    return say


@pytest.mark.parametrize(
    ("begin", "sentence"),
    [(lambda head: head.start_move(9.0), "does not follow its set-point"), (Cia402Head.home, "homing failed")],
)
def test_an_error_of_the_motion_is_told_once_even_without_a_fault(bench: CanBench, statusword, begin, sentence: str):
    head = bench.homed_head()
    begin(head)
    statusword(setting=states.MOTION_ERROR)
    with pytest.raises(DeviceError, match=sentence):
        head.status()
    rested(head)


def test_a_drive_that_does_not_take_a_set_point_is_told(bench: CanBench, statusword, monkeypatch):
    monkeypatch.setattr(tumble.drivers.cia402.head, "ANSWER_S", 0.2)
    head = bench.homed_head()
    statusword(clearing=states.ACKNOWLEDGED)
    with pytest.raises(NoReplyError, match="did not take the set-point"):
        head.start_move(9.0)


def test_a_fault_whose_cause_is_still_there_is_not_reset(bench: CanBench, statusword, monkeypatch):
    monkeypatch.setattr(tumble.drivers.cia402.head, "ANSWER_S", 0.2)
    head = bench.homed_head()
    statusword(setting=0x08, clearing=0x47)
    with pytest.raises(DeviceError, match="unknown error"):
        head.reset_fault()


def test_a_node_that_is_not_there_is_a_lost_link(bench: CanBench):
    with pytest.raises(LinkLostError, match="node 9: gave no SDO answer"):
        Cia402Head(bench.link, 9, limits_deg=(0.0, 1.0), steps_per_deg=1.0, speed_deg_s=1.0, clock=bench.clock)
