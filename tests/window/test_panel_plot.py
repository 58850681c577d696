"""A described figure is a plot of the window where it can be, and else a picture in the language of the window."""

from dataclasses import replace

import numpy as np
import pytest
from pyqtgraph import LinearRegionItem
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication

from tumble.calibrations.core.view import Section
from tumble.calibrations.report.figure import BAND, COLOURS, INK, Area, Axis, Cells, Figure, Line, Marks, Panel, Span
from tumble.messages import Language, Message
from tumble.window.generic.drawn import DrawnPresentation, _drawn
from tumble.window.generic.figure_list import FigureList
from tumble.window.generic.panel_plot import panel_plots, plottable
from tumble.window.look.language import speak

X = np.array([0.0, 10.0, 20.0])
PANEL = Panel(
    layers=(
        Span(low=-2.0, high=2.0),
        Span(low=0.0, high=0.0, colour=INK),
        Area(x=X, low=X - 1.0, high=X + 1.0, colour=BAND),
        Line(x=X, y=2.0 * X, colour=COLOURS[1], dashed=True, label=Message("model")),
        Marks(x=X, y=X, shape="cross", y_ends=(X - 1.0, X + 1.0), x_ends=(X - 1.0, X + 1.0), label="face-up"),
    ),
    x=Axis(label=Message("head angle (°)"), ends=(0.0, 25.0), ticks=(0.0, 20.0), names=("none", "much")),
    y=Axis(label="residual (µV)"),
    title="edge",
)
FIGURE = Figure(name="two", description="Two panels", panels=(PANEL, replace(PANEL, x=Axis(), y=Axis())), columns=2)

NOTHING = {"concluded": None, "verdict": None, "notices": (), "table": (), "sections": ()}


@pytest.fixture(scope="module", autouse=True)
def figures():
    """They are drawn here."""


@pytest.fixture
def plots(qapp):
    speak(Language.ENGLISH)
    made = panel_plots(FIGURE)
    yield made
    for plot in made:
        plot.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def test_its_points_and_lines_are_the_values_of_the_plot(plots):
    values = plots[0].values()
    assert [each.name for each in values.series] == ["face-up", "model"]
    assert values.series[1].y.tolist() == [0.0, 20.0, 40.0]


def test_a_band_is_as_pale_as_that_of_every_plot(plots):
    (band,) = (item for item in plots[0].items() if isinstance(item, LinearRegionItem))
    assert band.brush.color() == plots[0].band


def test_a_circle_is_round_however_wide_the_plot_is(qtbot):
    around = np.linspace(0.0, 2.0 * np.pi, 50)
    panel = Panel(layers=(Line(x=np.cos(around), y=np.sin(around)),), equal_units=True)
    (plot,) = panel_plots(replace(FIGURE, panels=(panel,), columns=1))
    qtbot.addWidget(plot)
    plot.resize(1200, 300)
    plot.show()
    across, up = plot.getViewBox().viewPixelSize()
    assert across == pytest.approx(up, rel=0.01)


def test_axes_are_as_they_are_described(plots):
    (left, right), _ = plots[0].viewRange()
    assert (left, right) == (0.0, 25.0)
    assert plots[0].getAxis("bottom")._tickLevels == [[(0.0, "none"), (20.0, "much")]]
    assert plots[0].values().left == "residual (µV)"


def test_what_a_neighbour_says_of_an_axis_is_said_by_every_plot(plots):
    assert (plots[1].values().bottom, plots[1].values().left) == ("head angle (°)", "residual (µV)")


def test_it_is_drawn_anew_in_other_colours(plots):
    before = len(plots[0].getPlotItem().items)
    plots[0].recoloured.emit()
    assert len(plots[0].getPlotItem().items) == before
    assert len(plots[0].values().series) == 2


@pytest.mark.parametrize(
    ("changed", "expected"),
    [
        ({}, True),
        ({"layers": (Cells(values=np.eye(2)),)}, False),
        ({"x": Axis(logarithmic=True)}, False),
    ],
)
def test_boxes_matrices_and_powers_of_ten_stay_pictures(changed, expected):
    assert plottable(replace(FIGURE, panels=(replace(PANEL, **changed),))) is expected


def test_a_picture_is_in_the_language_of_the_window(qapp):
    speak(Language.GERMAN)
    picture = replace(FIGURE, panels=(replace(PANEL, x=Axis(label=Message("head angle (°)"), logarithmic=True)),))
    try:
        assert "head angle" not in _drawn(Section(title="two", figure=lambda: picture)).svg
    finally:
        speak(Language.ENGLISH)


def test_a_picture_is_on_white_paper_in_every_colour(qtbot, qapp):
    picture = replace(FIGURE, panels=(replace(PANEL, layers=(Cells(values=np.eye(2)),)),))
    drawn = _drawn(Section(title="two", figure=lambda: picture))
    figures = FigureList()
    qtbot.addWidget(figures)
    figures.setStyleSheet("background: black;")
    figures.show_presentation(DrawnPresentation(**NOTHING, figures=(drawn,)))
    assert figures.figures[0].grab().toImage().pixelColor(1, 1).name() == "#ffffff"


def test_a_figure_that_is_plotted_is_not_drawn_besides(qapp):
    drawn = _drawn(Section(title="two", figure=lambda: FIGURE))
    assert (drawn.svg, drawn.sheet) == ("", FIGURE)
