"""Shrunk samples of the endurance runs on an emulated shaker."""

import os

import pytest

from benchmarks.endurance.killed_runs import killed, whole_run
from benchmarks.endurance.shaker_faults import Case, carried_out, cases
from benchmarks.endurance.shaker_kills import KILLING, in_process
from tumble.procedures.events import FinishReason

posix = pytest.mark.skipif(os.name == "nt", reason="SIGKILL is POSIX's")


@posix
@pytest.mark.parametrize(("what", "number"), [("ramp", 2)])
def test_a_kill_loses_and_doubles_nothing(what, number, tmp_path):
    with in_process(tmp_path) as stand:
        whole = whole_run(stand, tmp_path / "whole.mcap")
        result = killed(KILLING, stand, tmp_path / "killed.mcap", what, number, whole)
    assert (result.lost, result.doubled, result.changed) == (0, 0, 0)


@pytest.mark.parametrize(
    ("case", "reason", "told"),
    [
        (Case(device="exciter", kind="drop"), FinishReason.COMPLETED, False),
        (Case(device="exciter", kind="power_loss"), FinishReason.COMPLETED, False),
        (Case(device="exciter", kind="alarm"), FinishReason.DEVICE_FAULT, False),
        (Case(device="exciter", kind="stuck"), FinishReason.DEVICE_FAULT, True),
        (Case(device="reference", kind="overload"), FinishReason.DEVICE_FAULT, False),
    ],
    ids=lambda each: f"{each.device}-{each.kind}" if isinstance(each, Case) else "",
)
def test_a_fault_loses_and_doubles_nothing_and_leaves_nothing_driving(case, reason, told, tmp_path):
    result = carried_out(case, tmp_path, speed=20.0)
    assert result.reason is reason, result.message
    assert (result.happened, result.lost, result.doubled, result.safe, result.told) == (True, 0, 0, True, told)
    assert result.resumed == (0 if reason is FinishReason.COMPLETED else 1)


def test_there_are_more_than_twenty_kinds():
    assert len({(case.device, case.kind) for case in cases()}) >= 20
