"""Whoever chooses a programme sees in the list what it is for, and what it takes."""

from threading import current_thread, main_thread

import pytest
from PySide6.QtGui import QFont, QFontMetrics
from PySide6.QtWidgets import QPushButton

from tumble.app.stand import load_stand
from tumble.window.look.theme import POINT_SIZE
from tumble.window.widgets.programme_box import ProgrammeBox, title_beside
from tumble.window.widgets.run_form import RunForm
from tumble.window.work.background import Background

OWN = """\
# Six angles, for a
# unit in a hurry.
name = "own"
dwell_s = 0.1

[[procedure]]
kind = "sweep"
step_deg = 60.0
points = 6
"""


@pytest.fixture
def background(qapp):
    made = Background()
    yield made
    made.leave()


@pytest.fixture
def form(qtbot, settings, background):
    made = RunForm(load_stand, background)
    qtbot.addWidget(made)
    return made


@pytest.fixture
def takes(qtbot, background):
    def told(box, name):
        box.takes(name)
        qtbot.waitUntil(lambda: not background.is_busy)
        return box.takes(name)

    return told


def test_a_programme_that_comes_along_says_what_it_is_for(form):
    assert form.programme.about("24") == "Three circles of eight positions: every face twice, every edge once."


def test_and_what_it_takes_on_the_stand_of_its_method(form, takes):
    assert takes(form.programme, "24") == "24 points, about 11:02"
    assert takes(form.programme, "seed") == "430 points, 11 mountings, about 27:45"


def test_so_does_one_of_a_file(form, tmp_path):
    (tmp_path / "own.toml").write_text(OWN, encoding="utf-8")
    form.add_programme(str(tmp_path / "own.toml"))
    assert form.programme.about(form.chosen) == "Six angles, for a unit in a hurry."
    assert form.programme.toolTip() == "Six angles, for a unit in a hurry."


def test_one_that_cannot_be_read_says_why_and_takes_nothing(form, takes, tmp_path):
    absent = str(tmp_path / "absent.toml")
    assert "there is no such file" in form.programme.about(absent)
    assert takes(form.programme, absent) == ""


def test_a_file_that_was_mended_is_read_anew_when_it_is_chosen_again(form, tmp_path):
    dialogs = []
    form.dialog_wanted.connect(dialogs.append)
    for text in ("", OWN):
        (tmp_path / "own.toml").write_text(text, encoding="utf-8")
        form.findChild(QPushButton).click()
        dialogs[-1].chosen.emit(tmp_path / "own.toml")
    assert form.programme.about(form.chosen) == "Six angles, for a unit in a hurry."
    assert form.summary.text() == "6 points, 1 mounting, about 1:17"


def test_each_is_asked_once_until_the_stand_is_another(qtbot, takes, background):
    asked = []
    box = ProgrammeBox(lambda name: asked.append(name) or "1 point", str.upper, background)
    qtbot.addWidget(box)
    assert [takes(box, "a"), takes(box, "a")] == ["1 point"] * 2
    assert asked == ["a"]
    box.forget()
    takes(box, "a")
    assert asked == ["a", "a"]


def test_what_was_asked_about_the_stand_before_is_not_shown(qtbot, background):
    box = ProgrammeBox(lambda _: "1 point", str.upper, background)
    qtbot.addWidget(box)
    box.takes("a")
    box.forget()
    background.start(lambda: None, lambda _: None)
    qtbot.waitUntil(lambda: not background.is_busy)
    assert box.takes("a") == ""


def test_the_list_opens_while_what_they_take_is_worked_out(qtbot, background):
    asked_in = []
    box = ProgrammeBox(lambda _: asked_in.append(current_thread()) or "1 point", str.upper, background)
    qtbot.addWidget(box)
    box.addItem("a", "a")
    box.show()
    box.showPopup()
    qtbot.waitUntil(lambda: box.takes("a") == "1 point")
    assert main_thread() not in asked_in
    box.hidePopup()


@pytest.mark.parametrize(
    "title", ["seed", "a folder of somebody/a programme with a long name for the second bench.toml"]
)
def test_a_name_leaves_room_for_what_a_programme_takes(qapp, title):
    takes, bold = "430 points, 11 mountings, about 27:45", QFont(qapp.font())
    bold.setBold(True)
    shown = title_beside(takes, title, qapp.font(), 580)
    wide = QFontMetrics(bold).horizontalAdvance(shown) + QFontMetrics(qapp.font()).horizontalAdvance(takes)
    assert wide <= 580
    assert (shown[:3], shown[-3:]) == (title[:3], title[-3:])


def test_the_list_has_room_for_all_that_is_said(qtbot, background):
    box = ProgrammeBox(lambda _: "", lambda name: f"{name} " * 60, background)
    qtbot.addWidget(box)
    box.addItem("short", "ab")
    box.addItem("long", "abcdefghijkl")
    box.show()
    box.showPopup()
    heights = [box.view().visualRect(box.model().index(row, 0)).height() for row in (0, 1)]
    assert box.view().width() >= 30 * POINT_SIZE
    assert heights[1] >= heights[0] + 2 * box.fontMetrics().height()
    box.hidePopup()
