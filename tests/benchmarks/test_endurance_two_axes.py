"""Shrunk samples of the endurance runs of stands with two axes."""

import os

import pytest

from benchmarks.endurance.killed_runs import killed, whole_run
from benchmarks.endurance.two_axes_faults import ONE_SOAK, WITHOUT_A_SOAK, Case, carried_out, cases
from benchmarks.endurance.two_axes_kills import KILLING, in_process
from tumble.procedures.events import FinishReason

posix = pytest.mark.skipif(os.name == "nt", reason="SIGKILL is POSIX's")


@pytest.fixture(scope="module")
def stand(tmp_path_factory):
    with in_process(tmp_path_factory.mktemp("stand")) as stand:
        yield stand


@pytest.fixture(scope="module")
def whole(stand):
    return whole_run(stand, stand.with_name("whole.mcap"))


@posix
@pytest.mark.parametrize(("what", "number"), [("point", 3), ("soak", 1)])
def test_a_kill_loses_and_doubles_nothing(stand, whole, what, number, tmp_path):
    result = killed(KILLING, stand, tmp_path / "killed.mcap", what, number, whole)
    assert (result.lost, result.doubled, result.changed) == (0, 0, 0)


@pytest.mark.parametrize(
    ("case", "reason"),
    [
        (Case(pair="serial", device="inner", kind="power_loss"), FinishReason.COMPLETED),
        (Case(pair="serial", device="inner", kind="stall"), FinishReason.DEVICE_FAULT),
        (Case(pair="CAN", device="inner", kind="heartbeat_lost"), FinishReason.COMPLETED),
        (Case(pair="serial", device="scanner", kind="drop"), FinishReason.COMPLETED),
        (Case(pair="serial", device="chamber", kind="alarm", soaking=True), FinishReason.DEVICE_FAULT),
        (Case(pair="serial", device="chamber", kind="power_loss", soaking=True), FinishReason.COMPLETED),
    ],
    ids=lambda each: f"{each.device}-{each.kind}" if isinstance(each, Case) else "",
)
def test_a_fault_loses_and_doubles_nothing(case, reason, tmp_path):
    result = carried_out(case, tmp_path, ONE_SOAK if case.soaking else WITHOUT_A_SOAK)
    assert result.reason is reason, result.message
    assert (result.happened, result.lost, result.doubled, result.resting) == (True, 0, 0, True)
    assert result.resumed == (0 if reason is FinishReason.COMPLETED else 1)


@pytest.mark.parametrize(("pair", "device"), [("serial", "inner"), ("CAN", "inner"), ("serial", "scanner")])
def test_another_unit_is_refused(pair, device, tmp_path):
    result = carried_out(Case(pair=pair, device=device, kind="swapped"), tmp_path, WITHOUT_A_SOAK)

    assert (result.happened, result.lost, result.doubled, result.resting) == (True, 0, 0, True)
    assert (result.reason, result.resumed) == (FinishReason.DEVICE_FAULT, -1)
    assert "the run was begun with" in result.message


def test_there_are_more_than_twenty_kinds():
    assert len({(case.device, case.kind) for pair in ("serial", "CAN") for case in cases(pair)}) >= 20
