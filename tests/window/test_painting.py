"""A plot is painted once for what is new in it, by the thread of the window alone."""

import sys
from pathlib import Path

import pytest
from PySide6.QtCore import QEvent
from PySide6.QtWidgets import QApplication

from tumble.window.look.plots import Plot


class Counted(Plot):
    """Counts how often it is painted."""

    painted = 0

    def paintEvent(self, event):  # noqa: N802  # Qt's name
        self.painted += 1
        super().paintEvent(event)


@pytest.fixture
def plot(qapp):
    plot = Counted("angle (°)", "voltage (V)")
    plot.resize(500, 300)
    plot.getAxis("left").setWidth(80)  # as those of plots above each other
    plot.line = plot.plot([0.0, 1.0], [0.0, 1.0])
    plot.show()
    settle()
    yield plot
    plot.hide()
    plot.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def settle():
    for _ in range(10):
        QApplication.processEvents()


def test_axes_that_are_fitted_before_are_painted_once(plot):
    plot.painted = 0
    plot.line.setData([0.0, 2.0], [0.0, 5.0])
    plot.fit_axes()
    settle()
    assert plot.painted == 1


@pytest.mark.skipif(sys.platform != "linux", reason="reads /proc")
def test_no_thread_of_a_pool_is_waited_for(plot):
    names = {(task / "comm").read_text().strip() for task in Path("/proc/self/task").iterdir()}
    assert "Thread (pooled)" not in names
