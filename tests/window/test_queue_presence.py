"""Windows of one store that come and go: what one that is gone had under way is stopped, and nothing else."""

import json
import os
import subprocess
import sys
from contextlib import ExitStack
from pathlib import Path

import pytest
from PySide6.QtCore import QSysInfo
from two_windows import add, entry, stages

from tumble.window.work import presence
from tumble.window.work.queue_file import QueueFile
from tumble.window.work.run_queue import Stage

ADDING = """\
import sys
from pathlib import Path
from tumble.window.work.queue_file import QueueFile
from tumble.window.work.run_queue import Entry

queue = QueueFile(Path(sys.argv[1]))
for number in range(20):
    entry = Entry(serial_number=f"{sys.argv[2]}-{number}", programme="quick")
    queue.update(lambda each, entry=entry: each.add(entry))
queue.leave()
"""
CLAIMING = """\
import sys
from pathlib import Path
from tumble.window.work.queue_file import QueueFile

queue = QueueFile(Path(sys.argv[1]))
print(*(entry.id for entry in iter(lambda: queue.claim(""), None)), flush=True)
sys.stdin.read()
"""


@pytest.fixture
def elsewhere(both, tmp_path, pass_time):
    """An entry that a window on another computer carries out, and the lock of that one."""
    owner = "deadbeef" * 4
    (mine,) = add(both[0], "A-1")
    lock = tmp_path / f"queue-{owner}.lock"
    lock.write_text("4242\npython3\nanother-computer\n", encoding="utf-8")
    both[0].update(lambda queue: queue.change(mine, lambda each: each.begun(owner)))
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
    assert len(entries) == len({each.id for each in entries}) == 60
    assert {each.serial_number for each in entries} == {f"{name}-{number}" for name in "ABC" for number in range(20)}


def test_processes_that_begin_at_the_same_time_share_the_entries(python, tmp_path, qapp):
    queue = QueueFile(tmp_path)
    runs = entry().repeated(30)
    queue.update(lambda each: each.add(*runs))
    claiming = [python(CLAIMING, tmp_path) for _ in range(3)]
    claimed = [process.stdout.readline().decode().split() for process in claiming]
    assert sorted(each for ids in claimed for each in ids) == sorted(run.id for run in runs)
    queue.look()
    assert {each.stage for each in queue.queue.entries} == {Stage.MEASURING}


def test_what_a_process_that_dies_had_under_way_is_stopped(python, tmp_path, qapp):
    queue = QueueFile(tmp_path)
    (mine,) = add(queue, "A-1")
    process = python(CLAIMING, tmp_path)
    assert process.stdout.readline().decode() == f"{mine}\n"
    queue.look()
    assert stages(queue) == [("A-1", Stage.MEASURING)]
    process.kill()
    process.wait(60)
    queue.look()
    assert stages(queue) == [("A-1", Stage.STOPPED)]
