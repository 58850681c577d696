"""Every kind of fault once through the wire, at one kind of step; the benchmark has all of them at every kind."""

import os

import pytest

from benchmarks.endurance.fault_runs import case_named, of_cases
from benchmarks.endurance.faults import cases, is_bad
from benchmarks.endurance.kinds import KINDS
from tumble.app.exits import Exit

SHORT = """\
name = "short"
settle_s = 0.05
dwell_s = 0.5

[[procedure]]
kind = "sweep"
mount = "face-up-90"
step_deg = 50.0
points = 4

[[procedure]]
kind = "sweep"
mount = "face-up"
step_deg = 50.0
points = 4
"""
SPEED = 10.0
PROCESSES = 5
"""Most of the time is spent waiting."""
GOOD, DEVICE, STOPPED, STORAGE = Exit.GOOD, Exit.DEVICE_FAULT, Exit.STOPPED, Exit.STORAGE

posix = pytest.mark.skipif(os.name == "nt", reason="there is no such signal, limit or removal on Windows")

HAPPENED = [
    ("head: reply late", "homing", "serial", GOOD, ""),
    ("head: reply cut", "move", "CAN", GOOD, ""),
    ("head: reply doubled", "dwell", "CAN", GOOD, ""),
    ("head: reply garbled", "mount prompt", "serial", GOOD, ""),
    ("head: replies out of order", "settling", "CAN", GOOD, ""),
    ("head: wrong checksum", "identification", "serial", GOOD, ""),
    ("head: port vanishes and returns", "identification", "serial", GOOD, "the step is repeated"),
    ("head: port vanishes and returns", "homing", "CAN", GOOD, "the step is repeated"),
    ("head: port vanishes for good", "settling", "serial", DEVICE, "did not come back within 30 s; check its power"),
    ("head: power lost", "move", "serial", GOOD, "has lost its reference; trying to go on"),
    ("head: another unit after a reconnect", "move", "CAN", DEVICE, "connect that one again, then resume the run"),
    ("head: bus-off", "dwell", "CAN", GOOD, "bus-off: too many errors on the wire"),
    ("head: stall", "move", "serial", DEVICE, "stalled and stopped (flag FS); remove what blocks it"),
    ("head: stall", "homing", "CAN", DEVICE, "following error"),
    ("head: overshoot", "move", "CAN", DEVICE, "when it should long have stood at 100 deg; look for what blocks it"),
    ("head: moving for ever", "move", "serial", DEVICE, "still moves at 100.0000 deg"),
    ("head: heartbeat lost", "mount prompt", "CAN", GOOD, ""),
    ("head: emergency message", "settling", "CAN", DEVICE, "excess temperature of the drive (code 4310h); remove"),
    ("head: old bits", "homing", "CAN", GOOD, ""),
    ("head: old bits", "move", "CAN", GOOD, ""),
    ("head: target reached flickers", "move", "CAN", GOOD, ""),
    ("head: no optional objects", "identification", "CAN", GOOD, ""),
    ("head: mode shown late", "homing", "CAN", GOOD, ""),
    ("head: foreign frames", "move", "CAN", GOOD, "error frames dropped"),
    ("head: noise on the bus", "move", "CAN", GOOD, "cut or garbled frames dropped"),
    ("daq: foreign frames", "dwell", "CAN", GOOD, "frames of another length than the DBC file says dropped"),
    ("daq: reply late", "settling", "CAN", GOOD, ""),
    ("daq: reply cut", "dwell", "serial", GOOD, ""),
    ("daq: port vanishes and returns", "identification", "serial", GOOD, "the step is repeated"),
    ("daq: another unit after a reconnect", "settling", "serial", DEVICE, "the run was begun with Keysight"),
    ("daq: power lost", "dwell", "serial", GOOD, ""),
    ("daq: reply garbled", "dwell", "plain meter", GOOD, ""),
    ("daq: error in its queue", "settling", "plain meter", GOOD, ""),
    ("daq: another unit after a reconnect", "dwell", "plain meter", DEVICE, "the run was begun with Keysight"),
    ("daq: reply cut", "settling", "Keithley 2000", GOOD, ""),
    ("daq: power lost", "dwell", "Keithley 2000", GOOD, ""),
    ("daq: port vanishes and returns", "dwell", "Keithley 2000", GOOD, "the step is repeated"),
    ("daq: NaN", "dwell", "serial", GOOD, "1 of 50 samples are overloads or no numbers; the point will be set aside"),
    ("daq: overload", "dwell", "CAN", GOOD, "1 of 50 samples are overloads or no numbers; the point will be set aside"),
    ("daq: frames lost", "dwell", "CAN", GOOD, ""),
    ("daq: error in its queue", "settling", "serial", GOOD, ""),
    ("mount not changed though confirmed", "mount prompt", "serial", GOOD, "fit face-up-90, where the unit sat before"),
    pytest.param("clock set back a day", "move", "serial", GOOD, "", marks=posix),
    ("bus: buffer full for a moment", "move", "CAN", GOOD, "frames sent only after a failure: 1"),
    pytest.param("disk full", "move", "serial", STORAGE, "has room; then resume the run", marks=posix),
    pytest.param("recording removed", "dwell", "serial", GOOD, "was removed while it was written", marks=posix),
    pytest.param("SIGTERM", "homing", "serial", STOPPED, "the operator stopped the run", marks=posix),
    pytest.param("SIGINT", "mount prompt", "CAN", STOPPED, "the operator stopped the run", marks=posix),
    pytest.param("SIGINT twice", "dwell", "serial", STOPPED, "", marks=posix),
]


@pytest.fixture(scope="module")
def results():
    """What came of each, in processes that trace no coverage: each stand has its interpreter to itself."""
    here = [parameters for parameters in HAPPENED if os.name != "nt" or posix not in getattr(parameters, "marks", ())]
    happening = [getattr(parameters, "values", parameters)[:3] for parameters in here]
    return of_cases([case_named(*parameters, SPEED) for parameters in happening], PROCESSES, SHORT)


@pytest.mark.parametrize(("kind", "moment", "pair", "status", "said"), HAPPENED)
def test_a_fault_loses_no_point_and_ends_well_or_at_a_standstill(results, kind, moment, pair, status, said):
    case = case_named(kind, moment, pair, SPEED)

    result = results[case]

    assert result.status is status, result.sentences
    assert any(said in sentence for sentence in result.sentences) or not said, result.sentences
    assert not is_bad(case, result), result
    assert result.read_back == (kind != "head: port vanishes for good")


def test_there_are_more_than_twenty_kinds_and_each_comes_at_every_step():
    assert len(KINDS) > 20
    assert {(case.kind.name, case.moment) for case in cases(KINDS, SPEED)} == {
        (kind.name, moment)
        for kind in KINDS
        for moment in ("identification", "homing", "mount prompt", "move", "settling", "dwell")
    }
