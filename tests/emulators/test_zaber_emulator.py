import pytest
from zaber_stage import Stage

from tumble.emulators.speed import FasterClock


@pytest.fixture
def device():
    return Stage().link.device


@pytest.fixture
def stage():
    return Stage().homed()


def say(device, *lines):
    return [device.hear(line.encode() + b"\n").decode().strip() for line in lines]


@pytest.mark.parametrize(
    ("line", "answer"),
    [
        ("/", "@01 0 OK IDLE WR 0"),
        ("/1 1 07", "@01 1 07 OK IDLE WR 0"),
        ("/0 0 05 get version", "@01 0 05 OK IDLE WR 7.38"),
        ("/1 1 get limit.max", "@01 1 OK IDLE WR 760000"),
        ("/1 1 warnings", "@01 1 OK IDLE WR 02 WR WH"),
        ("/1 2 get pos", "@01 2 RJ IDLE WR BADAXIS"),
        ("/1 1 get deviceid", "@01 1 RJ IDLE WR DEVICEONLY"),
        ("/1 1 set comm.alert 1", "@01 1 RJ IDLE WR DEVICEONLY"),
        ("/1 0 get pos", "@01 0 OK IDLE WR 0"),
        ("/1 1 get nonsense", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 get", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 dance", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 home now", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 stop now", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 warnings now", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 system", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 move up", "@01 1 RJ IDLE WR BADCOMMAND"),
        ("/1 1 move abs", "@01 1 RJ IDLE WR BADDATA"),
        ("/1 1 move abs here", "@01 1 RJ IDLE WR BADDATA"),
        ("/1 1 set maxspeed 0", "@01 1 RJ IDLE WR BADDATA"),
        ("/1 0 set comm.checksum 2", "@01 0 RJ IDLE WR BADDATA"),
        ("/1 0 set deviceid 5", "@01 0 RJ IDLE WR BADCOMMAND"),
        ("/1 0 set deviceid", "@01 0 RJ IDLE WR BADCOMMAND"),
        ("/2 1 get pos", ""),
        ("/1 1 get pos:00", ""),
        ("get pos", ""),
    ],
)
def test_a_line_has_its_answer(device, line, answer):
    assert say(device, line) == [answer]


def test_it_does_not_go_to_a_place_before_it_is_homed(device):
    assert say(device, "/1 1 move abs 5") == ["@01 1 RJ IDLE WR BADDATA"]


def test_homing_takes_its_time_and_clears_the_flags(stage):
    say(stage.link.device, "/1 1 move abs 20000")
    stage.settle()
    first, second = say(stage.link.device, "/1 1 system reset", "/1 1 home")
    assert (first[:18], second[:18]) == ("@01 1 OK IDLE WR 0", "@01 1 OK BUSY WR 0")
    stage.clock.sleep(1.0)
    assert say(stage.link.device, "/1 1")[0][:18] == "@01 1 OK IDLE -- 0"


def test_after_a_loss_of_power_it_counts_from_where_it_stands(stage):
    say(stage.link.device, "/1 1 move abs 20000")
    stage.settle()
    assert say(stage.link.device, "/1 1 system reset", "/1 1 get pos")[1].startswith("@01 1 OK IDLE WR 0:")
    assert stage.shared.head.status().angle_deg == 20.0


def test_homing_that_is_broken_off_finds_no_reference(stage):
    say(stage.link.device, "/1 1 move abs 20000")
    stage.settle()
    say(stage.link.device, "/1 1 system reset", "/1 1 home", "/1 1 stop")
    stage.clock.sleep(10.0)
    assert not stage.head.status().referenced


def test_the_speed_can_be_set(stage):
    stage.link.device.hear(b"/1 1 set maxspeed 16384\n")
    stage.link.device.hear(b"/1 1 move abs 20000\n")
    stage.clock.sleep(1.0)
    assert stage.head.status().angle_deg == 10.0


def test_a_move_that_ends_another_is_noted(stage):
    first, second = say(stage.link.device, "/1 1 move abs 20000", "/1 1 move abs -5000")
    assert (first[:16], second[:16]) == ("@01 1 OK BUSY --", "@01 1 OK BUSY NI")


def test_limits_bound_moves_to_the_ends(stage):
    say(stage.link.device, "/1 1 move min")
    assert stage.settle().angle_deg == -180.0


def test_overshoot_ends_half_a_degree_too_far():
    stage = Stage({"kind": "overshoot", "at": {"command": 1, "containing": "move"}}).homed()
    stage.head.start_move(90.0)
    assert stage.settle().angle_deg == 90.5


def test_moving_for_ever_ends_with_a_stop():
    stage = Stage({"kind": "moving_for_ever", "at": {"command": 1, "containing": "move"}}).homed()
    stage.head.start_move(90.0)
    stage.clock.sleep(1000.0)
    assert stage.head.status().moving
    stage.head.stop()
    assert not stage.head.status().moving


def test_whoever_wants_alerts_is_told_once_of_each_arrival(stage):
    device = stage.link.device
    session, other = device.session(), device.session()
    say(device, "/1 0 set comm.alert 1", "/1 1 move abs 20000")
    assert session.due() == b""
    stage.clock.sleep(10.0)
    alert = b"!01 1 IDLE --:DB\r\n"
    assert session.due()[:13] == alert[:13]
    assert session.due() == b""
    assert other.due()[:13] == alert[:13]
    assert other.received(b"/1 1\n")[:13] == b"@01 1 OK IDLE"


def test_a_faster_clock_runs_faster():
    clock = FasterClock(1000.0)
    began_s, began_ns = clock.monotonic_s(), clock.wall_ns()
    clock.sleep(5.0)
    clock.sleep(-1.0)
    assert clock.monotonic_s() - began_s >= 5.0
    assert clock.wall_ns() - began_ns >= 5_000_000_000


def test_a_clock_that_stands_is_refused():
    with pytest.raises(ValueError, match="above 0"):
        FasterClock(0.0)
