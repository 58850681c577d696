import pytest
from pydantic import ValidationError

from tumble.drivers.clock import VirtualClock
from tumble.emulators.faults import At, Fault, Faults, FaultScript
from tumble.emulators.stand_faults import StandFaults


def one(clock=None, points=lambda: 0, **fault):
    script = FaultScript.model_validate({"fault": [{"device": "head", **fault}]})
    return Faults(script, "head", clock or VirtualClock(0), points)


def test_nothing_goes_wrong_without_a_script():
    assert Faults().take("drop") is None


def test_a_fault_happens_at_its_command_and_once():
    faults = one(kind="late", at={"command": 2})
    taken = []
    for _ in range(4):
        faults.note_command(b"get pos\n")
        taken.append(faults.take("late", "cut") is not None)
    assert taken == [False, True, False, False]


def test_only_commands_that_contain_the_text_are_counted_and_hit():
    faults = one(kind="cut", at={"command": 2, "containing": "move"}, times=2)
    taken = []
    for command in (b"move 1", b"get pos", b"move 2", b"get pos", b"move 3", b"move 4"):
        faults.note_command(command)
        taken.append(faults.take("cut") is not None)
    assert taken == [False, False, True, False, True, False]


def test_a_fault_happens_at_its_time():
    clock = VirtualClock(0)
    faults = one(clock, kind="drop", at={"time_s": 5.0})
    assert faults.take("drop") is None
    clock.sleep(5.0)
    assert faults.take("drop")


def test_a_fault_happens_at_its_point():
    begun = [2]
    faults = one(points=lambda: begun[0], kind="nan", at={"point": 3})
    assert faults.take("nan") is None
    begun[0] = 3
    assert faults.take("nan")


def test_a_fault_is_taken_only_by_who_asks_for_its_kind():
    faults = one(kind="stall", at={"time_s": 0.0})
    assert faults.take("overshoot") is None
    assert faults.take("stall")


def test_each_instrument_has_its_own_faults():
    script = FaultScript(fault=(Fault(device="daq", kind="nan", at=At(time_s=0.0)),))
    assert Faults(script, "head").take("nan") is None
    assert Faults(script, "daq").take("nan")


@pytest.mark.parametrize(
    ("at", "says"),
    [
        ({}, "exactly one"),
        ({"point": 1, "command": 2}, "exactly one"),
        ({"time_s": 1.0, "containing": "move"}, "give command, too"),
        ({"command": 0}, "greater than or equal to 1"),
    ],
)
def test_a_moment_that_is_none_is_refused(at, says):
    with pytest.raises(ValidationError, match=says):
        At.model_validate(at)


def test_what_is_added_later_happens_from_then_on_and_is_listed_with_its_time():
    clock = VirtualClock(0)
    faults = Faults(None, "head", clock)
    clock.sleep(7.0)
    stall = Fault(device="head", kind="stall", at=At(command=1, containing="move"))
    faults.add(stall)
    faults.note_command(b"move abs 1")

    assert faults.happened == []
    assert faults.take("stall") == stall
    assert faults.take("stall") is None
    assert faults.happened == [(7.0, stall)]


def test_a_link_that_vanishes_is_the_bus_where_instruments_share_one():
    scripted = Fault(device="daq", kind="drop", at=At(time_s=0.0))
    stand = StandFaults(FaultScript(fault=(scripted,)), VirtualClock(0), lambda: 0)
    bus = stand.of_bus(["head", "daq"])
    told = Fault(device="head", kind="drop", at=At(time_s=0.0))
    stand.add(told)
    stand.add(Fault(device="head", kind="late", at=At(time_s=0.0)))

    assert [bus.take("drop"), bus.take("drop"), bus.take("drop")] == [scripted, told, None]
    assert bus.take("late") is None
    assert stand.of("head").take("late") is not None
    assert sorted(fault.kind for _, fault in stand.happened) == ["drop", "drop", "late"]


def test_the_link_of_another_instrument_is_not_that_of_the_bus():
    stand = StandFaults(None, VirtualClock(0), lambda: 0)
    bus = stand.of_bus(["head"])
    stand.add(Fault(device="daq", kind="drop", at=At(time_s=0.0)))

    assert bus.take("drop") is None
