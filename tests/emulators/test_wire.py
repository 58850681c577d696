import pytest

from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.wire import MOST_WAITING_BYTES, Wire


class Echo:
    """Answers every command that is not empty with itself; says what it was given unasked."""

    def __init__(self):
        self.heard = []
        self.unasked = b""

    def received(self, data):
        self.heard.append(data)
        return b"<" + data.strip() + b">\r\n" if data.strip() else b""

    def due(self):
        said, self.unasked = self.unasked, b""
        return said


def wire(kind=None, **more):
    faults = [{"device": "head", "kind": kind, "at": {"command": 2}, **more}] if kind else []
    return Wire(Echo(), Faults(FaultScript.model_validate({"fault": faults})), b"\r\n")


def test_commands_are_heard_whole_however_they_come():
    w = wire()
    assert [w.hear(part, 0.0) for part in (b"ge", b"t\nmo", b"ve\n")] == [b"", b"<get>\r\n", b"<move>\r\n"]


def test_what_has_no_end_is_thrown_away():
    w = wire()
    w.hear(b"x" * (MOST_WAITING_BYTES + 1), 0.0)
    assert w.hear(b"get\n", 0.0) == b"<get>\r\n"


def test_what_the_instrument_says_unasked_is_sent():
    w = wire()
    w._session.unasked = b"!\r\n"
    assert (w.due(0.0), w.due(0.1)) == (b"!\r\n", b"")


def test_empty_commands_are_not_counted():
    w = wire("cut")
    assert w.hear(b"a\r\nb\r\n", 0.0) == b"<a>\r\n<b"


@pytest.mark.parametrize(
    ("kind", "sent"),
    [
        ("cut", b"<s"),
        ("double", b"<second>\r\n<second>\r\n"),
        ("wrong_checksum", b"<second0\r\n"),
    ],
)
def test_the_second_answer_is_spoilt(kind, sent):
    w = wire(kind)
    assert w.hear(b"first\n", 0.0) == b"<first>\r\n"
    assert w.hear(b"second\n", 0.0)[: len(sent)] == sent


def test_a_garbled_answer_has_one_wrong_bit():
    w = wire("garble")
    w.hear(b"first\n", 0.0)
    sent, right = w.hear(b"second\n", 0.0), b"<second>\r\n"
    assert sum((a ^ b).bit_count() for a, b in zip(sent, right, strict=True)) == 1
    assert sent.endswith(b"\r\n")


def test_a_late_answer_comes_after_those_to_later_commands():
    w = wire("late", lasts_s=2.0)
    assert w.hear(b"first\nsecond\nthird\n", 0.0) == b"<first>\r\n<third>\r\n"
    assert w.due(1.9) == b""
    assert w.due(2.0) == b"<second>\r\n"
    assert w.due(3.0) == b""


def test_a_reordered_answer_comes_right_behind_the_next():
    w = wire("reorder")
    assert w.hear(b"first\nsecond\nthird\nfourth\n", 0.0) == b"<first>\r\n<third>\r\n<second>\r\n<fourth>\r\n"


def test_a_reordered_answer_with_none_behind_it_comes_late():
    w = wire("reorder", lasts_s=1.0)
    w.hear(b"first\nsecond\n", 0.0)
    assert (w.due(0.5), w.due(1.0)) == (b"", b"<second>\r\n")
