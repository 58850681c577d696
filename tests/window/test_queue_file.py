"""The file of the queue: each window of a store sees what the others do with it, and none undoes it."""

import json
from pathlib import Path

import pytest
from PySide6.QtCore import QLockFile
from two_windows import add, entry, stages

from tumble.app.exits import JobError
from tumble.calibrations.core.verdict import Outcome
from tumble.procedures.errors import InputError
from tumble.window.work.queue_file import QueueFile
from tumble.window.work.run_queue import Stage

OTHER_STAND = "/elsewhere/bench.toml"


def test_what_one_adds_the_other_sees(both):
    one, other = both
    add(one, "A-1")
    assert other.look()
    assert stages(other) == [("A-1", Stage.WAITING)]
    assert not other.look()


def test_neither_undoes_what_the_other_did_meanwhile(both):
    one, other = both
    first, _ = add(one, "A-1", "B-2")
    (third,) = add(other, "C-3")
    one.update(lambda queue: queue.remove(first))
    other.update(lambda queue: queue.move(third, -1))
    one.look()
    assert stages(one) == stages(other) == [("C-3", Stage.WAITING), ("B-2", Stage.WAITING)]


def test_what_waits_to_be_changed_is_found_again_among_what_others_added(both, impatient, hanging):
    one, other = both
    (mine,) = add(one, "A-1")
    hanging.unlock()
    add(other, "B-2")
    hanging.tryLock(0)
    one.update(lambda queue: queue.remove(mine))
    hanging.unlock()
    one.look()
    assert stages(one) == [("B-2", Stage.WAITING)]


def test_an_entry_that_was_written_is_not_added_once_more(both):
    one, _ = both
    again = entry()
    one.update(lambda queue: queue.add(again))
    one.update(lambda queue: queue.add(again))
    assert stages(one) == [("A-1", Stage.WAITING)]


def test_the_numbers_of_the_first_version_are_ids(both, tmp_path):
    numbered = {"number": 7, "serial_number": "A-1", "programme": "quick", "stage": "waiting"}
    document = {"schema": "tumble.queue/1", "entries": [numbered]}
    (tmp_path / "queue.json").write_text(json.dumps(document), encoding="utf-8")
    one, other = both
    one.look()
    other.look()
    other.update(lambda queue: queue.remove("7"))
    one.look()
    assert stages(one) == []


def test_an_entry_is_carried_out_by_one_of_them(both):
    one, other = both
    add(one, "A-1", "B-2")
    assert (one.claim("").serial_number, other.claim("").serial_number, one.claim("")) == ("A-1", "B-2", None)


def test_an_entry_of_another_stand_is_left_to_its_window(both):
    one, other = both
    elsewhere = entry(stand=OTHER_STAND)
    one.update(lambda queue: queue.add(elsewhere))
    assert one.claim("") is None
    assert other.claim(OTHER_STAND).serial_number == "A-1"


def test_what_another_window_carries_out_is_neither_stopped_nor_taken_out(both):
    one, other = both
    add(one, "A-1")
    one.claim("")
    other.update(lambda queue: queue.clear())
    assert stages(other) == [("A-1", Stage.MEASURING)]


def test_what_a_window_left_under_way_is_stopped(both):
    one, other = both
    add(one, "A-1")
    one.claim("")
    other.look()
    one.leave()
    assert other.look()
    assert stages(other) == [("A-1", Stage.STOPPED)]
    assert other.queue.entries[0].owner == ""


@pytest.mark.parametrize("owner", ["", "../../x", "gone"])
def test_what_nobody_carries_out_is_stopped(both, owner):
    one, other = both
    (mine,) = add(one, "A-1")
    one.update(lambda queue: queue.change(mine, lambda each: each.begun(owner)))
    other.look()
    assert stages(other) == [("A-1", Stage.STOPPED)]


def test_a_damaged_file_is_no_empty_queue_to_who_knows_it(both, tmp_path):
    one, other = both
    add(one, "A-1")
    other.look()
    (tmp_path / "queue.json").write_text("{", encoding="utf-8")
    with pytest.raises(InputError, match="is no queue that can be read"):
        other.look()
    assert not other.look()
    assert stages(other) == [("A-1", Stage.WAITING)]
    add(other, "B-2")
    one.look()
    assert stages(one) == [("A-1", Stage.WAITING), ("B-2", Stage.WAITING)]


def test_a_file_that_is_found_damaged_by_a_change_is_told_and_the_change_is_kept(both, tmp_path):
    one, other = both
    add(one, "A-1")
    (tmp_path / "queue.json").write_text("{", encoding="utf-8")
    add(one, "B-2")
    with pytest.raises(InputError, match=r"is no queue that can be read; it is kept as queue.damaged-1\.json"):
        one.look()
    other.look()
    assert stages(other) == [("A-1", Stage.WAITING), ("B-2", Stage.WAITING)]


def test_a_store_that_cannot_be_is_told(tmp_path, qapp):
    (tmp_path / "file").write_text("")
    queue = QueueFile(tmp_path / "file" / "store")
    with pytest.raises((InputError, JobError), match=r"queue\.json"):
        add(queue, "A-1")
    assert stages(queue) == [("A-1", Stage.WAITING)]


@pytest.fixture
def hanging(tmp_path):
    """A lock that another window has and does not give up."""
    lock = QLockFile(str(tmp_path / "queue.json.lock"))
    assert lock.tryLock(0)
    yield lock
    lock.unlock()


def test_a_change_that_another_window_is_in_the_way_of_is_told_once_and_written_later(
    both, tmp_path, impatient, hanging
):
    one, other = both
    add(one, "A-1")
    with pytest.raises(InputError, match="another window has it in use all the time"):
        one.look()
    assert not one.look()
    assert stages(one) == [("A-1", Stage.WAITING)]
    assert not (tmp_path / "queue.json").exists()
    hanging.unlock()
    one.look()
    other.look()
    assert stages(other) == [("A-1", Stage.WAITING)]


def test_nothing_is_begun_while_another_window_is_in_the_way(both, impatient, hanging):
    one, _ = both
    add(one, "A-1")
    with pytest.raises(InputError):
        one.claim("")
    assert stages(one) == [("A-1", Stage.WAITING)]


def test_a_verdict_that_could_not_be_written_outlasts_what_others_wrote_meanwhile(both, tmp_path, impatient):
    one, other = both
    (mine,) = add(one, "A-1")
    one.claim("")
    lock = QLockFile(str(tmp_path / "queue.json.lock"))
    lock.tryLock(0)
    one.update(lambda queue: queue.change(mine, lambda each: each.judged(Outcome.PASS, "record")))
    lock.unlock()
    add(other, "B-2")
    one.look()
    other.look()
    assert stages(one) == stages(other) == [("A-1", Stage.JUDGED), ("B-2", Stage.WAITING)]
    assert other.queue.entries[0].record_id == "record"


def test_a_window_that_is_closed_writes_what_it_could_not(both, impatient, hanging):
    one, other = both
    add(one, "A-1")
    hanging.unlock()
    one.leave()
    other.look()
    assert stages(other) == [("A-1", Stage.WAITING)]


@pytest.fixture
def refusing(monkeypatch):
    """Has the queue's file be refused to readers, as often as it is said."""
    read_text, left = Path.read_text, []

    def refused(path, *arguments, **named):
        if path.name == "queue.json" and left:
            left.pop()
            raise PermissionError(13, "in use", str(path))
        return read_text(path, *arguments, **named)

    monkeypatch.setattr(Path, "read_text", refused)
    return lambda times: left.extend([None] * times)


def test_what_cannot_be_read_for_a_moment_is_read_at_the_next_look(both, refusing):
    one, other = both
    add(one, "A-1")
    refusing(1)
    other.look()
    assert other.look()
    assert stages(other) == [("A-1", Stage.WAITING)]


@pytest.mark.parametrize("times", [1, 1_000_000])
def test_a_change_to_what_cannot_be_read_takes_nothing_away(both, refusing, impatient, times):
    one, other = both
    add(one, "A-1")
    refusing(times)
    add(other, "B-2")
    refusing(0)
    one.look()
    assert ("A-1", Stage.WAITING) in stages(one)


def test_what_cannot_be_read_for_long_is_told(both, refusing, impatient):
    one, other = both
    add(one, "A-1")
    refusing(1)
    with pytest.raises(InputError, match="cannot be read"):
        other.look()


def test_a_damaged_file_that_another_window_replaces_meanwhile_is_not_moved_away(both, tmp_path, monkeypatch):
    one, other = both
    (tmp_path / "queue.json").write_text("{", encoding="utf-8")
    locked, replaced = one._locked, []

    def replaced_before():
        (tmp_path / "queue.json").unlink()
        add(other, "B-2")
        replaced.append(True)
        return locked()

    monkeypatch.setattr(one, "_locked", replaced_before)
    assert one.look()
    assert replaced
    assert stages(one) == [("B-2", Stage.WAITING)]
    assert not list(tmp_path.glob("queue.damaged-*"))


def test_a_field_of_a_later_version_is_passed_over(both, tmp_path):
    one, other = both
    add(one, "A-1")
    document = json.loads((tmp_path / "queue.json").read_text(encoding="utf-8"))
    document["entries"][0]["priority"] = 1
    (tmp_path / "queue.json").write_text(json.dumps(document), encoding="utf-8")
    other.look()
    assert stages(other) == [("A-1", Stage.WAITING)]
