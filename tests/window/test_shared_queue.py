"""Two windows of one store: each sees what the other does with the queue, and none undoes it."""

import json
import os
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest
from PySide6.QtCore import QLockFile, QSysInfo, Qt

from tumble.app.exits import JobError
from tumble.calibrations.core.verdict import Outcome
from tumble.procedures.errors import InputError
from tumble.window.work import presence, queue_file
from tumble.window.work.queue_file import QueueFile
from tumble.window.work.run_queue import Entry, Stage

OTHER_STAND = "/elsewhere/bench.toml"
ADDING = """\
import sys
from pathlib import Path
from tumble.window.work.queue_file import QueueFile
from tumble.window.work.run_queue import Entry

queue = QueueFile(Path(sys.argv[1]))
for number in range(20):
    entry = Entry(number=0, serial_number=f"{sys.argv[2]}-{number}", programme="quick")
    queue.update(lambda each, entry=entry: each.add(entry))
queue.leave()
"""
CLAIMING = """\
import sys
from pathlib import Path
from tumble.window.work.queue_file import QueueFile

queue = QueueFile(Path(sys.argv[1]))
print(*(entry.number for entry in iter(lambda: queue.claim(""), None)), flush=True)
sys.stdin.read()
"""


def entry(serial_number="A-1", stand=""):
    return Entry(number=0, serial_number=serial_number, programme="quick", stand=stand)


def add(queue, *serial_numbers):
    for serial_number in serial_numbers:
        queue.update(lambda each, serial_number=serial_number: each.add(entry(serial_number)))


def stages(queue):
    return [(each.serial_number, each.stage) for each in queue.queue.entries]


@pytest.fixture
def both(tmp_path, qapp):
    """The queue of one store as two windows have it."""
    queues = QueueFile(tmp_path), QueueFile(tmp_path)
    yield queues
    for each in queues:
        each.leave()


def test_what_one_adds_the_other_sees(both):
    one, other = both
    add(one, "A-1")
    assert other.look()
    assert stages(other) == [("A-1", Stage.WAITING)]
    assert not other.look()


def test_neither_undoes_what_the_other_did_meanwhile(both):
    one, other = both
    add(one, "A-1", "B-2")
    add(other, "C-3")
    one.update(lambda queue: queue.remove(1))
    other.update(lambda queue: queue.move(3, -1))
    one.look()
    assert stages(one) == stages(other) == [("C-3", Stage.WAITING), ("B-2", Stage.WAITING)]
    assert [each.number for each in one.queue.entries] == [3, 2]


def test_an_entry_is_carried_out_by_one_of_them(both):
    one, other = both
    add(one, "A-1", "B-2")
    assert (one.claim("").serial_number, other.claim("").serial_number, one.claim("")) == ("A-1", "B-2", None)


def test_an_entry_of_another_stand_is_left_to_its_window(both):
    one, other = both
    one.update(lambda queue: queue.add(entry(stand=OTHER_STAND)))
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
    one.update(lambda queue: queue.add(entry()))
    one.update(lambda queue: queue.change(1, lambda each: each.begun(owner)))
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


@pytest.fixture
def impatient(monkeypatch):
    """Waits for nothing."""
    for name in ("_CHANGE_S", "_CLAIM_S", "_PATIENCE_S"):
        monkeypatch.setattr(queue_file, name, 0.0)


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
    add(one, "A-1")
    one.claim("")
    lock = QLockFile(str(tmp_path / "queue.json.lock"))
    lock.tryLock(0)
    one.update(lambda queue: queue.change(1, lambda each: each.judged(Outcome.PASS, "record")))
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


@pytest.fixture
def elsewhere(both, tmp_path, pass_time):
    """An entry that a window on another computer carries out, and the lock of that one."""
    owner = "deadbeef" * 4
    add(both[0], "A-1")
    lock = tmp_path / f"queue-{owner}.lock"
    lock.write_text("4242\npython3\nanother-computer\n", encoding="utf-8")
    both[0].update(lambda queue: queue.change(1, lambda each: each.begun(owner)))
    return lock


@pytest.fixture
def pass_time(monkeypatch):
    """Has time pass for who looks for signs of life."""
    now = [0.0]
    monkeypatch.setattr(presence, "monotonic", lambda: now[0])

    def passed(seconds):
        now[0] += seconds

    return passed


def test_a_window_on_another_computer_without_a_sign_of_life_is_gone(both, elsewhere, pass_time):
    one, _ = both
    one.look()
    assert stages(one) == [("A-1", Stage.MEASURING)]
    pass_time(61)
    one.look()
    assert stages(one) == [("A-1", Stage.STOPPED)]


def test_a_window_on_another_computer_that_gives_signs_of_life_is_there(both, elsewhere, pass_time):
    one, _ = both
    for second in (50, 100, 150):
        os.utime(elsewhere, (second, second))
        one.look()
        pass_time(50)
    assert stages(one) == [("A-1", Stage.MEASURING)]


def test_a_window_that_carries_out_gives_signs_of_life(both, tmp_path):
    one, _ = both
    add(one, "A-1")
    one.claim("")
    lock = tmp_path / f"queue-{one.owner}.lock"
    os.utime(lock, (1, 1))
    one.look()
    assert lock.stat().st_mtime > 1


def test_what_crashed_windows_left_is_swept_out_and_what_open_ones_hold_is_not(both, tmp_path, elsewhere):
    one, other = both
    add(one, "B-2")
    one.claim("")
    (tmp_path / "queue-0123abcd.lock").write_text(
        f"999999999\npython3\n{QSysInfo.machineHostName()}\n", encoding="utf-8"
    )
    other.sweep()
    assert set(tmp_path.glob("queue-*.lock")) == {elsewhere, tmp_path / f"queue-{one.owner}.lock"}


def test_an_entry_of_a_computer_that_is_gone_is_stopped_after_all(both, elsewhere, pass_time, tmp_path):
    one, _ = both
    one.look()
    pass_time(61)
    one.update(lambda queue: None)
    assert json.loads((tmp_path / "queue.json").read_text(encoding="utf-8"))["entries"][0]["stage"] == "stopped"


@pytest.fixture
def python():
    """Begins processes, which are gone after the test."""
    with ExitStack() as stack:

        def begin(script, *arguments):
            process = subprocess.Popen(
                [sys.executable, "-c", script, *map(str, arguments)],
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                cwd=Path.cwd(),
            )
            stack.enter_context(process)
            stack.callback(process.kill)
            return process

        yield begin


def test_processes_that_add_at_the_same_time_lose_nothing(python, tmp_path, qapp):
    adding = [python(ADDING, tmp_path, name) for name in "ABC"]
    assert [process.wait(60) for process in adding] == [0, 0, 0]
    queue = QueueFile(tmp_path)
    queue.look()
    entries = queue.queue.entries
    assert sorted(each.number for each in entries) == list(range(1, 61))
    assert {each.serial_number for each in entries} == {f"{name}-{number}" for name in "ABC" for number in range(20)}


def test_processes_that_begin_at_the_same_time_share_the_entries(python, tmp_path, qapp):
    queue = QueueFile(tmp_path)
    queue.update(lambda each: each.add(entry(), 30))
    claiming = [python(CLAIMING, tmp_path) for _ in range(3)]
    claimed = [list(map(int, process.stdout.readline().split())) for process in claiming]
    assert sorted(number for numbers in claimed for number in numbers) == list(range(1, 31))
    queue.look()
    assert {each.stage for each in queue.queue.entries} == {Stage.MEASURING}


def test_what_a_process_that_dies_had_under_way_is_stopped(python, tmp_path, qapp):
    queue = QueueFile(tmp_path)
    add(queue, "A-1")
    process = python(CLAIMING, tmp_path)
    assert process.stdout.readline() == b"1\n"
    queue.look()
    assert stages(queue) == [("A-1", Stage.MEASURING)]
    process.kill()
    process.wait(60)
    queue.look()
    assert stages(queue) == [("A-1", Stage.STOPPED)]


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def test_the_window_shows_what_another_one_adds_and_measures_it(driver, tiny, tmp_path, no_report):
    driver.window.stand.simulation.imagined.setChecked(True)
    other = QueueFile(tmp_path / "store")
    other.update(lambda queue: queue.add(Entry(number=0, serial_number="X-9", programme=str(tiny))))
    driver.wait(lambda: [each.serial_number for each in driver.run.queue.queue.entries] == ["X-9"], 10)
    driver.window.open(driver.run)
    driver.press(Qt.Key.Key_F4)
    driver.wait(lambda: other.look() or stages(other)[0][1] is Stage.JUDGED)
    driver.wait(lambda: (other.look(), stages(other)[0][1] is Stage.JUDGED)[1])


def test_the_window_leaves_alone_what_another_one_measures(driver, tiny, tmp_path):
    other = QueueFile(tmp_path / "store")
    other.update(lambda queue: queue.add(Entry(number=0, serial_number="X-9", programme=str(tiny))))
    other.claim("")
    driver.wait(lambda: [each.stage for each in driver.run.queue.queue.entries] == [Stage.MEASURING], 10)
    driver.window.open(driver.run)
    driver.run.queue.start()
    driver.run.queue.proceed()
    assert driver.run.queue_view.said.text() == "Everything in the queue was measured."
    assert not driver.window.busy
    other.leave()
    driver.wait(lambda: [each.stage for each in driver.run.queue.queue.entries] == [Stage.STOPPED], 10)
