import random

import pytest

from benchmarks.endurance import stops
from tumble.procedures.events import FinishReason

STANDS = [
    "two Zaber heads on a line each, scanner",
    "two CiA 402 nodes, three CAN DAQs",
    "a function generator, two multimeters",
]


@pytest.mark.parametrize("name", STANDS)
def test_a_run_without_a_fault_is_stopped_at_a_standstill_at_once(name, tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(stops, "KINDS", ("late",))
    monkeypatch.setattr(stops, "LASTING_S", (0.0,))
    monkeypatch.setattr(stops, "_LATEST_S", 1.0)
    found = stops.stopped(name, tmp_path, random.Random(2))
    assert (found.outcome.reason, found.outcome.at_standstill) == (FinishReason.STOPPED, True)
    stops.tell([found])
    assert "1 stopped; at a standstill after" in capsys.readouterr().out
