import threading

import pytest

from tumble.window.work.background import Background
from tumble.window.work.newest import Newest


@pytest.fixture
def background(qapp):
    background = Background()
    yield background
    background.leave()


def test_wishes_between_the_first_and_the_newest_are_left_out(qtbot, background):
    free, called, told = threading.Event(), [], []
    newest = Newest(background)
    newest.start(lambda: free.wait(10) and called.append("A"), lambda _: told.append("A"))
    for name in ("B", "C", "D"):
        newest.start(lambda name=name: called.append(name), lambda _, name=name: told.append(name))
    free.set()
    qtbot.waitUntil(lambda: not background.is_busy)
    assert (called, told) == (["A", "D"], ["D"])


def test_after_a_failure_the_next_wish_is_heard(qtbot, background):
    failures, told = [], []
    background.failed.connect(failures.append)
    newest = Newest(background)
    newest.start(lambda: 1 / 0, told.append)
    qtbot.waitUntil(lambda: bool(failures))
    newest.start(lambda: "found", told.append)
    qtbot.waitUntil(lambda: bool(told))
    assert told == ["found"]
    assert isinstance(failures[0], ZeroDivisionError)
