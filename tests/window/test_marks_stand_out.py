"""What is painted by hand stands out from its ground, in light, in dark and in high contrast."""

from itertools import product
from typing import get_args

import numpy as np
import pytest
from PySide6.QtGui import QColor, QPainter, QPen
from PySide6.QtWidgets import QProgressBar, QVBoxLayout, QWidget

from benchmarks.window_flaws import LEAST_CONTRAST, contrast
from benchmarks.window_marks import Mark, marks
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.window.look.shades import CONTRAST, DARK, LIGHT, Shade
from tumble.window.look.sheet import style_sheet
from tumble.window.look.signs import Ink
from tumble.window.look.theme import dress
from tumble.window.look.tints import BLUE
from tumble.window.methods.dividing_head.pose_picture import PosePicture
from tumble.window.methods.triad import pose_overview
from tumble.window.widgets.correlation_table import CorrelationTable
from tumble.window.widgets.run_log import RunLog
from tumble.window.widgets.series_plot import SeriesPlot
from tumble.window.widgets.table import Table
from tumble.window.work.presentation import Correlations


@pytest.fixture(params=[Shade.LIGHT, Shade.DARK, Shade.CONTRAST])
def shade(request, qapp):
    dress(qapp, request.param, 1.0)
    yield request.param
    dress(qapp, Shade.LIGHT, 1.0)


@pytest.fixture
def window(qtbot, qapp):
    made = QWidget()
    qtbot.addWidget(made)
    QVBoxLayout(made)
    made.resize(700, 300)
    return made


def shown(window, part):
    window.layout().addWidget(part)
    window.show()
    return part


def rgb(name):
    return int(name.removeprefix("#"), 16)


class Line(QWidget):
    """One thick line on white."""

    def __init__(self, colour):
        super().__init__()
        self.resize(60, 40)
        self._colour = colour

    def paintEvent(self, event):  # noqa: N802
        painter = QPainter(self)
        painter.fillRect(self.rect(), QColor("#FFFFFF"))
        painter.setPen(QPen(QColor(self._colour), 3))
        painter.drawLine(10, 20, 50, 20)


@pytest.mark.parametrize("shade", [Shade.LIGHT], indirect=True)
def test_a_mark_is_found_with_its_ground(shade, window):
    assert list(marks(shown(window, Line(LIGHT.good)))) == [Mark(colour=rgb(LIGHT.good), ground=0xFFFFFF)]


@pytest.mark.parametrize("shade", [Shade.CONTRAST], indirect=True)
def test_a_faint_mark_is_told(shade, window):
    """By hand: #FFE14D has the relative luminance 0.757, so its contrast with white is 1.05 / 0.807 = 1.30."""
    found = [mark for mark in marks(shown(window, Line(CONTRAST.accent))) if mark.colour == rgb(CONTRAST.accent)]
    assert [round(mark.contrast, 2) for mark in found] == [1.30]


@pytest.mark.parametrize("mount", list(MOUNTS))
def test_the_picture_of_a_mount_stands_out(shade, window, mount):
    picture = shown(window, PosePicture())
    picture.show_mount(mount)
    found = list(marks(picture))
    assert len(found) >= 5  # 0°, g with its arrow, at least two axes
    assert [mark for mark in found if mark.contrast < LEAST_CONTRAST] == []


@pytest.mark.parametrize(("outer_deg", "inner_deg"), list(product((0.0, 90.0, 180.0, 270.0), (0.0, 45.0, 135.0))))
def test_the_picture_of_a_position_stands_out_whatever_the_colours(shade, window, outer_deg, inner_deg):
    """It is the one of the report, whose colours are those of light."""
    picture = shown(window, pose_overview.PosePicture())
    picture.show_pose(outer_deg, inner_deg)
    found = list(marks(picture, LIGHT))
    assert {mark.colour for mark in found} >= {rgb(LIGHT.data[1]), rgb(LIGHT.data[2])}
    assert [mark for mark in found if mark.contrast < LEAST_CONTRAST] == []


def test_every_series_of_a_plot_stands_out(shade, window):
    names = [f"series {number}" for number in range(6)]
    plot = shown(window, SeriesPlot(names, "number", "output (V)"))
    plot.draw_series({name: (np.arange(5.0), np.full(5, float(place))) for place, name in enumerate(names)})
    found = list(marks(plot))
    assert {mark.colour for mark in found} >= {rgb(colour) for colour in plot.colours.data}
    assert [mark for mark in found if mark.contrast < LEAST_CONTRAST] == []


@pytest.mark.parametrize("chosen", [LIGHT, DARK, CONTRAST])
def test_colours_of_data_stand_out_from_paper_and_window(chosen):
    pairs = product(chosen.data, (chosen.paper, chosen.window))
    assert [pair for pair in pairs if contrast(*map(rgb, pair)) < LEAST_CONTRAST] == []


@pytest.mark.parametrize("chosen", [LIGHT, DARK, CONTRAST])
def test_signs_and_bars_stand_out_from_every_row_of_a_table(chosen):
    inks = {getattr(chosen, ink) for ink in get_args(Ink)} | set(chosen.data[:2])
    pairs = [*product(inks, (chosen.paper, chosen.other_row)), (chosen.highlighted, chosen.highlight)]
    assert [pair for pair in pairs if contrast(*map(rgb, pair)) < LEAST_CONTRAST] == []


@pytest.mark.parametrize("coefficient", [-1.0, -0.5, 0.5, 1.0])
def test_a_coefficient_stands_out_from_its_tint(shade, window, coefficient):
    table = shown(window, CorrelationTable())
    table.show_correlations(
        Correlations(names=["k"], coefficients=np.array([[coefficient]]), texts=[[f"{coefficient:.2f}"]])
    )
    image = table.viewport().grab(table.visualItemRect(table.item(0, 0))).toImage()
    ground = image.pixelColor(2, 2).rgb() & 0xFFFFFF
    assert ground != table.palette().base().color().rgb() & 0xFFFFFF
    assert contrast(ground, table.palette().text().color().rgb() & 0xFFFFFF) >= LEAST_CONTRAST


@pytest.fixture
def dressed_anew(qtbot, qapp):
    """Has parts written in light and shown in high contrast."""
    dress(qapp, Shade.LIGHT, 1.0)

    def dressed(part):
        qtbot.addWidget(part)
        part.show()
        dress(qapp, Shade.CONTRAST, 1.0)
        qapp.processEvents()
        return part

    yield dressed
    dress(qapp, Shade.LIGHT, 1.0)


def test_what_the_log_said_is_read_in_other_colours_too(dressed_anew):
    log = RunLog()
    log.resize(400, 80)
    log.say("The head stands.", warning=True)
    shown = dressed_anew(log)
    image = shown.viewport().grab().toImage()
    inks = {image.pixelColor(x, y).rgb() & 0xFFFFFF for x in range(image.width()) for y in range(24)}
    assert max(contrast(ink, rgb(CONTRAST.paper)) for ink in inks) >= LEAST_CONTRAST


def test_a_row_keeps_its_ink_in_other_colours(dressed_anew):
    table = Table(["unit"])
    table.fill([["A-1"]], ["bad"])
    assert table.item(0, 0).foreground().color().name().upper() == LIGHT.bad
    assert dressed_anew(table).item(0, 0).foreground().color().name().upper() == CONTRAST.bad


def test_how_far_a_run_is_stands_out_in_high_contrast(dressed_anew):
    bar = QProgressBar()
    bar.setStyleSheet(style_sheet(CONTRAST, 1.0, 10.5))
    bar.setRange(0, 12)
    bar.setValue(12)
    bar.setFormat("%v / %m")
    bar.resize(300, 30)
    on_what_is_done = [mark for mark in marks(dressed_anew(bar)) if mark.ground == rgb(BLUE.ground)]
    assert rgb(CONTRAST.ink) in {mark.colour for mark in on_what_is_done}
    assert [mark for mark in on_what_is_done if mark.contrast < LEAST_CONTRAST] == []
