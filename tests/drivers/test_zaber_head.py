import pytest
from zaber_stage import Stage, once

from tumble.drivers.errors import DeviceError, LimitError, NoReplyError
from tumble.drivers.protocols import Identity
from tumble.drivers.zaber.codec import lrc

STALL = {"kind": "stall", "at": {"command": 1, "containing": "move"}}
POWER_LOSS = {"kind": "power_loss", "at": {"time_s": 1.0}}


def lost(_):
    return b""


def wrong_bit(answer):
    return bytes([*answer[:12], answer[12] ^ 1, *answer[13:]])


def test_it_says_who_it_is():
    assert Stage().head.identify() == Identity(model="Zaber 99001", serial="51234", firmware="7.38")


def test_it_has_the_device_send_checksums_and_go_at_its_speed():
    stage = Stage()
    stage.head.identify()
    assert "set comm.checksum 1" in stage.link.heard
    assert stage.link.device.hear(b"/1 1 get maxspeed\n").startswith(b"@01 1 OK IDLE WR 32768:")


def test_settings_that_are_right_are_not_written_again():
    stage = Stage().homed()
    stage.head.identify()
    assert not [command for command in stage.link.heard if command.startswith("set")]


def test_it_knows_its_angle_only_after_homing():
    stage = Stage()
    stage.head.identify()
    assert not stage.head.status().referenced
    stage.head.home()
    assert stage.settle().referenced


def test_an_unreferenced_head_does_not_move():
    stage = Stage()
    with pytest.raises(DeviceError, match="home it"):
        stage.head.start_move(10.0)


@pytest.mark.parametrize("steps_per_deg", [1000.0, -2133.3333])
def test_it_goes_where_it_is_sent(steps_per_deg):
    stage = Stage(steps_per_deg=steps_per_deg).homed()
    stage.head.start_move(90.0)
    assert stage.head.status().moving
    assert stage.settle().angle_deg == pytest.approx(90.0, abs=1e-3)
    assert stage.shared.head.status().angle_deg == pytest.approx(90.0, abs=1e-3)


def test_it_refuses_moves_outside_its_limits_without_a_word():
    stage = Stage().homed()
    with pytest.raises(LimitError, match="-180 to 760"):
        stage.head.start_move(760.1)
    assert stage.link.heard == []


def test_limits_of_the_device_are_limits_too():
    stage = Stage(limits_deg=(-999.0, 999.0)).homed()
    with pytest.raises(LimitError, match="out of range"):
        stage.head.start_move(800.0)


def test_a_move_that_the_device_refuses_for_another_reason_is_no_matter_of_limits():
    stage = Stage().homed()
    stage.link.spoil = once("move", lambda answer: _rejected(answer, "SOMETHING"))
    with pytest.raises(DeviceError, match=r"rejects the command \(SOMETHING\)") as raised:
        stage.head.start_move(5.0)
    assert not isinstance(raised.value, LimitError)


def test_a_move_that_is_never_answered_nor_begun_is_given_up():
    stage = Stage().homed()
    hear = stage.link.device.hear
    stage.link.device.hear = lambda line: b"" if b"move" in line else hear(line)
    with pytest.raises(NoReplyError, match="'move abs 5000' did not come"):
        stage.head.start_move(5.0)


def test_it_tells_its_limits_and_speed():
    head = Stage().head
    assert (head.limits_deg, head.speed_deg_s) == ((-180.0, 760.0), 20.0)


def test_a_rejection_other_than_not_knowing_the_setting_is_an_error():
    stage = Stage()
    stage.link.spoil = once("get peripheral.id", lambda answer: _changed(answer, flag="RJ", data="NOACCESS"))
    with pytest.raises(DeviceError, match="does not allow"):
        stage.head.identify()


def test_stop_may_be_said_twice():
    stage = Stage().homed()
    stage.head.start_move(90.0)
    stage.clock.sleep(1.0)
    stage.head.stop()
    stage.head.stop()
    status = stage.head.status()
    assert (status.moving, status.angle_deg) == (False, 20.0)


@pytest.mark.parametrize("spoilt", [lost, wrong_bit, lambda answer: answer[:9], lambda _: b"\xff\xfe\n"])
def test_a_question_whose_answer_is_lost_or_spoilt_is_asked_again(spoilt):
    stage = Stage().homed()
    stage.link.spoil = once("get pos", spoilt)
    assert stage.head.status().angle_deg == 0.0
    assert stage.link.heard == ["get pos", "get pos"]


def test_after_three_silences_it_gives_up():
    stage = Stage().homed()
    stage.link.spoil = lambda *_: b""
    with pytest.raises(NoReplyError, match="check power, cable"):
        stage.head.status()
    assert len(stage.link.heard) == 3


def test_an_answer_to_an_earlier_question_is_passed_over():
    stage = Stage().homed()
    stage.link.spoil = lambda _, answer: _line("@", "01 1 98 OK IDLE -- 777") + answer
    stage.head.start_move(30.0)
    assert stage.settle().angle_deg == 30.0


def test_a_doubled_answer_is_taken_once():
    stage = Stage().homed()
    stage.link.spoil = lambda _, answer: answer * 2
    stage.head.start_move(30.0)
    assert stage.settle().angle_deg == 30.0


def test_alerts_are_passed_over():
    stage = Stage().homed()
    stage.link.spoil = lambda _, answer: _line("!", "01 1 IDLE --") + answer
    assert stage.head.status().angle_deg == 0.0


def test_a_move_whose_answer_is_lost_is_not_sent_again_while_the_head_moves():
    stage = Stage().homed()
    stage.link.spoil = once("move abs", lost)
    stage.head.start_move(90.0)
    assert stage.link.heard.count("move abs 90000") == 1
    assert stage.settle().angle_deg == 90.0


def test_a_move_that_was_not_heard_is_sent_again():
    stage = Stage().homed()
    hear, deaf = stage.link.device.hear, [True]

    def hard_of_hearing(line):
        if b"move" in line and deaf:
            deaf.clear()
            return b""
        return hear(line)

    stage.link.device.hear = hard_of_hearing
    stage.head.start_move(90.0)
    assert stage.settle().angle_deg == 90.0
    assert stage.link.heard.count("move abs 90000") == 2


def test_homing_whose_answer_is_lost_is_checked_and_done():
    stage = Stage().homed()
    stage.head.start_move(90.0)
    stage.settle()
    stage.link.spoil = once("home", lost)
    stage.head.home()
    assert stage.settle().angle_deg == 0.0
    assert stage.link.heard.count("home") == 1


def test_a_device_that_is_not_ready_is_asked_again():
    stage = Stage().homed()
    stage.link.spoil = once("stop", lambda answer: _rejected(answer, "AGAIN"))
    stage.head.stop()
    assert stage.link.heard == ["stop", "stop"]


def test_a_rejection_is_told_in_words():
    stage = Stage().homed()
    stage.link.spoil = once("move", lambda answer: _rejected(answer, "PARKED"))
    with pytest.raises(DeviceError, match="it is parked; unpark it"):
        stage.head.start_move(5.0)


def test_a_stall_ends_the_move_with_an_error_and_then_the_standstill_can_be_read():
    stage = Stage(STALL).homed()
    stage.head.start_move(90.0)
    with pytest.raises(DeviceError, match="stalled and stopped"):
        stage.settle()
    status = stage.head.status()
    assert (status.moving, status.referenced, status.angle_deg) == (False, False, 45.0)


def test_homing_mends_a_stall():
    stage = Stage(STALL).homed()
    stage.head.start_move(90.0)
    with pytest.raises(DeviceError):
        stage.settle()
    stage.head.home()
    status = stage.settle()
    assert (status.referenced, status.angle_deg) == (True, 0.0)


def test_power_loss_leaves_it_unreferenced():
    stage = Stage(POWER_LOSS).homed()
    stage.head.start_move(90.0)
    stage.clock.sleep(10.0)
    assert not stage.head.status().referenced


def test_a_swapped_unit_has_another_serial_number():
    stage = Stage({"kind": "swapped", "at": {"time_s": 1.0}}).homed()
    stage.clock.sleep(2.0)
    stage.head.reconnect()
    assert stage.head.identify().serial == "51235"
    assert stage.link.reopened == 1


def test_a_stage_behind_a_controller_is_identified_too():
    stage = Stage()

    def with_peripheral(command, answer):
        if not command.startswith("get peripheral"):
            return answer
        value = "43211" if command.endswith("id") else "777"
        return _changed(answer, flag="OK", data=value)

    stage.link.spoil = with_peripheral
    assert stage.head.identify() == Identity(model="Zaber 99001/43211", serial="51234/777", firmware="7.38")


def test_a_position_that_is_no_number_is_an_error():
    stage = Stage().homed()
    stage.link.spoil = lambda _, answer: _changed(answer, data="NA")
    with pytest.raises(DeviceError, match="'NA' for its position"):
        stage.head.status()


def test_an_answer_in_two_packets_is_put_together():
    stage = Stage().homed()

    def in_two(command, answer):
        if command != "get version":
            return answer
        words = answer.decode().partition(":")[0].split()
        first = " ".join(words[:-1])[1:] + " 7\\"
        second = f"{words[0][1:]} {words[1]} {words[2]} cont 38"
        return _line("@", first) + _line("#", second)

    stage.link.spoil = in_two
    assert stage.head.identify().firmware == "7 38"


def _line(kind, text):
    return f"{kind}{text}:{-sum(text.encode()) & 0xFF:02X}\r\n".encode()


def _changed(answer, *, flag=None, data=None):
    words = answer.decode().partition(":")[0][1:].split()
    words[3] = flag or words[3]
    words[6:] = [data]
    return _line("@", " ".join(words))


def _rejected(answer, reason):
    return _changed(answer, flag="RJ", data=reason)


@pytest.mark.parametrize("spoilt", [lambda answer: answer.replace(b" 0\r", b" 1\r"), lambda answer: answer * 2])
def test_a_wrong_answer_to_the_only_question_without_a_checksum_does_no_harm(spoilt):
    stage = Stage()
    stage.link.spoil = once("get comm.checksum", spoilt)
    assert stage.head.identify().serial == "51234"
    assert "set comm.checksum 1" in stage.link.heard


def test_a_list_of_warnings_shorter_than_its_count_is_asked_for_again():
    stage = Stage(STALL).homed()
    stage.head.start_move(90.0)
    lists = []

    def shortened(command, answer):
        if command != "warnings":
            return answer
        lists.append(answer)
        return with_data(answer, b"02 WR") if len(lists) == 1 else answer

    stage.link.spoil = shortened
    with pytest.raises(DeviceError, match="stalled and stopped"):
        stage.settle()

    assert len(lists) == 2


@pytest.mark.parametrize("data", [b"02 WR", b"01 WR WH", b"00 WR", b"1 WR", b"WR", b"01 XX", b"99", b"01 wr"])
def test_a_list_of_warnings_that_stays_wrong_is_told(data):
    stage = Stage()
    stage.link.spoil = lambda command, answer: with_data(answer, data) if command == "warnings" else answer

    with pytest.raises(DeviceError, match="no list of warnings that can be believed in 3 attempts"):
        stage.head.status()


def test_a_stall_in_the_reply_counts_even_where_the_list_leaves_it_out():
    stage = Stage(STALL).homed()
    stage.head.start_move(90.0)
    stage.link.spoil = lambda command, answer: with_data(answer, b"00") if command == "warnings" else answer

    with pytest.raises(DeviceError, match="stalled and stopped"):
        stage.settle()


def with_data(answer, data):
    """The answer with other data and the checksum that belongs to it."""
    words = answer.split(b":")[0].split()
    text = b" ".join([*words[:6], data])
    return text + b":%02X\r\n" % lrc(text[1:])
