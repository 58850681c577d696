"""Words for what is wanted of a run, and what becomes of others."""

import pytest

from tumble.app.control_file import ControlFile
from tumble.app.wishes import Wishes
from tumble.procedures.control import Control
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    ReadingRequested,
    RunResumed,
    State,
    StateChanged,
)


@pytest.mark.parametrize(
    "garbage", ["", "pause", "pause never\n", "pause -1\n", "pause nan\n", "dance\n", "\n\n", "x" * 9000]
)
def test_what_says_nothing_clear_is_not_heeded(tmp_path, garbage):
    file, said = ControlFile(tmp_path / "x.mcap"), []
    control = Control()
    wishes = Wishes(control, said.append)
    file.open()
    file.path.write_text(garbage)
    for line in file.taken():
        wishes.told(line)
    assert not (control.pause_wanted() or control.stop_wanted())
    assert all(sentence.endswith("known are pause, continue, again, stop") for sentence in said)


def test_bytes_that_are_no_text_are_not_heeded(tmp_path):
    file, said = ControlFile(tmp_path / "x.mcap"), []
    file.open()
    file.path.write_bytes(b"\xfe\xff\x00stop\n")
    Wishes(Control(), said.append).told(*file.taken())
    assert len(said) == 1


def test_without_a_point_none_is_taken_again():
    control, said = Control(), []
    assert Wishes(control, said.append).typed("again\n")
    assert (control.heed_again(), said) == (None, ["there is no point yet that could be taken again"])


def test_a_mistyped_word_is_told_of():
    said = []
    assert not Wishes(Control(), said.append).typed("pasue\n")
    assert said == ["'pasue' is nothing that a run can do; known are pause, continue, again, stop"]


@pytest.mark.parametrize(
    "request_",
    [ConditionRequested(condition="mount", value="edge", prompt=""), ReadingRequested(setting_deg=0.0, prompt="")],
)
def test_what_is_typed_while_a_question_is_open_is_its_answer(request_):
    wishes = Wishes(Control(), pytest.fail)
    wishes(request_)
    assert not wishes.typed("45 00 00\n")


def test_an_empty_line_wants_nothing():
    assert not Wishes(Control(), pytest.fail).typed("\n")


def test_after_a_question_a_mistyped_word_is_told_of_again():
    said = []
    wishes = Wishes(Control(), said.append)
    wishes(ConditionRequested(condition="mount", value="edge", prompt=""))
    wishes(ConditionAnswered(condition="mount", value="edge", answer="yes", confirmed=True))
    wishes.typed("pasue\n")
    assert len(said) == 1


def test_after_a_break_the_last_point_is_the_one_before_it():
    control = Control()
    wishes = Wishes(control, pytest.fail)
    wishes(RunResumed(points=17))
    wishes.typed("повтор")
    assert control.heed_again() == 16


def test_a_pause_that_was_ended_does_not_end_the_run():
    control, now_s = Control(), [0.0]
    wishes = Wishes(control, pytest.fail, lambda: now_s[0])
    wishes.told("pause")
    wishes(StateChanged(state=State.PAUSED))
    now_s[0] = 3599.0
    wishes.watch()
    assert control.pause_wanted()
    wishes.told("continue")
    now_s[0] = 7200.0
    wishes.watch()
    assert not control.stop_wanted()


def test_a_pause_begins_once_everything_stands():
    control, now_s = Control(), [0.0]
    wishes = Wishes(control, pytest.fail, lambda: now_s[0])
    wishes.told("pause 1")
    now_s[0] = 300.0  # samples are being taken
    wishes.watch()
    assert not control.stop_wanted()
    wishes(StateChanged(state=State.PAUSED))
    now_s[0] = 361.0
    wishes.watch()
    assert control.stop_wanted()
