"""A programme of many mounts: its plots keep their right end in sight, and its circles their names legible."""

import numpy as np
import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QFont, QFontMetricsF
from PySide6.QtWidgets import QApplication

from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.messages import Language
from tumble.window.look.language import speak
from tumble.window.methods.dividing_head.mounts import mount_name
from tumble.window.methods.dividing_head.pose_map import fitting_font
from tumble.window.methods.dividing_head.run_plots import OutputPlot


@pytest.fixture
def plot(qtbot, qapp):
    """A plot of a point in every mount, as wide as it is beside the dials on a small screen."""
    plot = OutputPlot()
    qtbot.addWidget(plot)
    plot.resize(560, 200)
    plot.show()
    angles = np.arange(float(len(MOUNTS)))
    plot.draw(list(MOUNTS), angles, angles)
    look_at(plot)
    return plot


def look_at(plot):
    """Have a plot laid out and painted."""
    for _ in range(3):
        QApplication.processEvents()
        plot.grab()


def test_the_key_of_many_mounts_leaves_the_plot_in_sight(plot):
    assert plot.getViewBox().sceneBoundingRect().right() <= plot.width()


def test_the_whole_key_is_in_sight(plot):
    title = plot.getPlotItem().titleLabel.item
    place = title.mapRectToScene(title.boundingRect())
    assert place.right() <= plot.width()
    assert place.bottom() <= plot.getViewBox().sceneBoundingRect().top() + 1.0
    assert place.height() > 1.5 * plot.fontMetrics().height()


def test_a_short_key_takes_one_line(plot):
    plot.entitle()
    look_at(plot)
    assert plot.getPlotItem().titleLabel.height() < 2.0 * plot.fontMetrics().height()


def test_the_key_is_laid_out_anew_where_the_plot_is_wider(plot):
    before = plot.getPlotItem().titleLabel.height()
    plot.resize(1600, 200)
    look_at(plot)
    assert plot.getPlotItem().titleLabel.height() < before


@pytest.mark.parametrize("language", Language)
def test_the_name_of_every_mount_is_legible_in_a_small_circle(qapp, language):
    speak(language)
    room = QRectF(0.0, 0.0, 66.0, 66.0)  # a circle of 90 px
    sizes = [fitting_font(QFont(), f"{mount_name(mount)}\n318/477", room).pointSizeF() for mount in MOUNTS]
    speak(Language.ENGLISH)
    assert min(sizes) >= 0.59 * QFont().pointSizeF()


def test_a_word_is_not_broken_to_keep_its_size(qapp):
    font = fitting_font(QFont(), "on the other edge\n318/477", QRectF(0.0, 0.0, 66.0, 66.0))
    assert QFontMetricsF(font).horizontalAdvance("318/477") <= 66.0
