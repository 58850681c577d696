"""A queue that awaits its next unit: the question ends with its entry, and nothing is taken for begun."""

import pytest
from two_windows import add, stages

from tumble.app.stand import load_stand
from tumble.window.screens import queue_runner
from tumble.window.screens.queue_runner import QueueRunner
from tumble.window.work.queue_file import NAME, QueueFile
from tumble.window.work.run_queue import Stage


@pytest.fixture
def awaiting(qapp, tmp_path, monkeypatch):
    """Wants A-1 on the stand, where something else was measured before; B-2 waits."""
    monkeypatch.setattr(queue_runner, "planned", lambda *_: (None, None))
    monkeypatch.setattr(queue_runner, "asks_first", lambda _: False)
    stand = load_stand()
    runner = QueueRunner(lambda _: True, lambda: stand, lambda: tmp_path)
    add(runner._file, "A-1", "B-2")
    runner._seated = "X-9"
    runner.start()
    runner.proceed()
    assert stages(runner) == [("A-1", Stage.MOUNTING), ("B-2", Stage.WAITING)]
    yield runner
    runner.leave()


@pytest.fixture
def wanted(awaiting):
    """The units that are asked for from now on, an empty one for none."""
    units = []
    awaiting.unit_wanted.connect(units.append)
    return units


def test_a_unit_whose_entry_is_gone_is_asked_for_no_more(awaiting, wanted, tmp_path):
    (tmp_path / NAME).unlink()
    awaiting.look()
    assert wanted == [""]
    assert not awaiting.going


def test_a_unit_whose_entry_was_stopped_is_asked_for_no_more(awaiting, wanted, tmp_path):
    other = QueueFile(tmp_path)
    other.look()
    other.update(lambda queue: queue.change(queue.entries[0].id, lambda each: each.at(Stage.STOPPED)))
    awaiting.look()
    assert wanted == [""]
    assert stages(awaiting) == [("A-1", Stage.STOPPED), ("B-2", Stage.WAITING)]


def test_an_entry_whose_unit_was_awaited_waits_on_when_the_window_is_left(awaiting, tmp_path):
    awaiting.leave()
    other = QueueFile(tmp_path)
    other.look()
    assert stages(other) == [("A-1", Stage.WAITING), ("B-2", Stage.WAITING)]


def test_another_store_is_asked_nothing_for_the_last_one(awaiting, wanted):
    awaiting.open()
    assert wanted == [""]
    assert stages(awaiting) == [("A-1", Stage.WAITING), ("B-2", Stage.WAITING)]
