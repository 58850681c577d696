"""Below the values stands the figure that says most, where there is room for it."""

import numpy as np
import pytest

from tumble.calibrations.core.view import Section
from tumble.calibrations.report.figure import Axis, Figure, Marks, Panel
from tumble.window.generic import drawn
from tumble.window.generic.presenting import SectionPresentation
from tumble.window.screens.values_view import ValuesView
from tumble.window.work.presentation import Drawn, ParameterLine, Presentation

MARKS = Marks(x=np.array([0.0, 90.0]), y=np.array([1.0, -1.0]), label="")
PANEL = Panel(layers=(MARKS,), x=Axis(label="head angle (°)"), y=Axis(label="residual (µV)"))
FIGURE = Figure(name="residual", description="Residual", panels=(PANEL,), columns=1)
RESIDUAL = Drawn(title="", svg="", caption="Measured minus fitted.", sheet=FIGURE)
LINES = [ParameterLine(name=name, value="1.0 V", interval="", standard="", note="") for name in ("u0", "kx", "ky")]


def result(picture, lines=LINES):
    return Presentation(concluded=None, verdict=None, notices=(), table=lines, picture=picture)


@pytest.fixture
def view(qtbot):
    view = ValuesView()
    qtbot.addWidget(view)
    view.resize(1400, 800)
    view.show()
    return view


def height_of_table(view):
    view.layout().activate()
    return view.table.height()


def test_the_figure_has_the_room_that_the_values_leave(view):
    view.show_presentation(result(RESIDUAL))
    assert view.picture.isVisible() and view.picture.height() > view.table.height()
    assert view.table.table.verticalScrollBar().maximum() == 0  # every line is in sight


def test_where_there_is_no_room_for_both_the_values_have_it_all(view):
    view.show_presentation(result(RESIDUAL))
    view.resize(1400, 220)
    assert not view.picture.isVisible()
    assert height_of_table(view) == 220


def test_the_figure_keeps_no_window_from_becoming_smaller(view):
    view.show_presentation(result(RESIDUAL))
    assert view.picture.isVisible()
    assert view.minimumSizeHint() == view.table.minimumSizeHint()


def test_a_picture_that_is_higher_than_the_room_is_left_out(view):
    svg = '<svg xmlns="http://www.w3.org/2000/svg" width="76" height="60" viewBox="0 0 76 60"/>'  # shown 600 px high
    view.show_presentation(result(Drawn(title="", svg=svg, caption="")))
    assert view.picture.isVisible()
    view.resize(1400, 600)
    assert not view.picture.isVisible()


def test_many_values_leave_no_room(view):
    view.show_presentation(result(RESIDUAL, 20 * LINES))
    assert not view.picture.isVisible()


def test_without_a_figure_the_values_have_it_all(view):
    view.show_presentation(result(RESIDUAL))
    view.show_presentation(result(None))
    assert not view.picture.isVisible()
    assert height_of_table(view) == 800


def test_the_figure_of_the_answer_comes_before_that_of_a_detail(monkeypatch):
    detail, answer = (
        Section(title=title, figure=lambda: FIGURE, brief=title == "answer") for title in ("detail", "answer")
    )
    plain = SectionPresentation(concluded=None, verdict=None, notices=(), table=(), sections=(detail, answer))
    monkeypatch.setattr(drawn, "present_sections", lambda _: plain)
    assert drawn.present(None).picture.title == "answer"
