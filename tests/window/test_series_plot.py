"""A plot of several series says how many points of each are drawn."""

import numpy as np
import pytest
from PySide6.QtGui import QFontMetricsF

from tumble.procedures.methods.dividing_head.layout import LAYOUT, dwell_at
from tumble.procedures.methods.dividing_head.rows import Row
from tumble.window.look.plots import LocalAxis
from tumble.window.methods.dividing_head.figures import HeadFigures
from tumble.window.methods.dividing_head.run_plots import OutputPlot
from tumble.window.widgets.series_plot import SeriesPlot
from tumble.window.work.background import Background


def test_a_series_without_a_point_yet_has_none_drawn(qapp):
    plot = SeriesPlot(["u"], "angle (°)", "voltage (V)")
    plot.draw_series({"u": (np.array([]), np.array([]))})
    assert plot.drawn("u") == 0


def test_the_key_names_a_mount_as_an_operator_reads_it(qapp):
    plot = OutputPlot()
    plot.draw(["face-up"], np.array([0.0]), np.array([1.0]))
    assert "</span> face up" in plot.getPlotItem().titleLabel.text


@pytest.mark.parametrize("height_px", [42.0, 90.0, 500.0])
def test_numbers_beside_an_ordinate_do_not_lie_on_each_other(qapp, height_px):
    axis = LocalAxis("left")
    line_px = QFontMetricsF(axis.font()).height()
    widest, _ = axis.tickSpacing(-250.0, 250.0, height_px)[0]
    assert widest * height_px / 500.0 >= line_px


def test_redrawing_keeps_no_further_symbol(qtbot, qapp):
    plot = SeriesPlot(["u"], "angle (°)", "voltage (V)")
    qtbot.addWidget(plot)
    for points in range(1, 6):
        plot.draw_series({"u": (np.arange(points), np.arange(points))})
        plot.grab()
    assert len(plot.listDataItems()[0].scatter.fragmentAtlas) == 1


@pytest.mark.parametrize(
    ("low", "high", "lines", "numbers"),
    [(-290.0, 290.0, 2.5, [-160.0, 160.0]), (-180.0, 180.0, 2.4, [-100.0, 100.0])],
)
def test_a_low_plot_has_two_numbers_on_its_ordinate(qapp, low, high, lines, numbers):
    axis = LocalAxis("left")
    (_, written), *_ = axis.tickValues(low, high, lines * QFontMetricsF(axis.font()).height())
    assert written == pytest.approx(numbers)


def test_where_there_is_little_room_the_residual_has_as_much_of_it_as_the_output(qtbot):
    figures = HeadFigures(LAYOUT, Background())
    qtbot.addWidget(figures)
    figures.resize(700, 300)
    figures.show()
    assert figures.residual.height() == pytest.approx(figures.output.height(), abs=1)


@pytest.fixture
def expecting(qtbot):
    """Figures of a run from 0 to 400°, of which nothing is measured yet."""
    figures = HeadFigures(LAYOUT, Background())
    qtbot.addWidget(figures)
    ends = [
        dwell_at(angle_deg=angle_deg, procedure="sweep", realisation=1, mount="face-up") for angle_deg in (0.0, 400.0)
    ]
    figures.expect(ends)
    figures.begin([])
    while figures.draw_next():
        pass
    return figures


def test_the_axis_of_the_head_angle_holds_the_whole_programme_from_the_start(expecting):
    (lowest_deg, highest_deg), _ = expecting.residual.getViewBox().viewRange()
    assert lowest_deg <= 0.0 and highest_deg >= 400.0


def test_a_further_point_moves_no_axis_of_the_head_angle(expecting):
    take(expecting, 0.0)
    moved = []
    for plot in (expecting.output, expecting.residual):
        plot.getViewBox().sigXRangeChanged.connect(lambda *_: moved.append(1))
    take(expecting, 5.0)
    assert not moved


def take(figures, angle_deg):
    """Have a point at a head angle drawn."""
    figures.add(
        Row(
            index=0, angle_deg=angle_deg, voltage_v=2.5, voltage_sd_v=1e-3, samples=50, time_s=1.0, direction=1,
            temperature_degc=23.0, realisation=1, procedure="sweep", mount="face-up", settled=True,
        ).point
    )  # fmt: skip
    while figures.draw_next():
        pass
