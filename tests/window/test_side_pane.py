"""A pane stands beside the other parts where there is room for it, and is one of their tabs where there is none."""

import pytest
from PySide6.QtGui import QFont
from PySide6.QtWidgets import QLabel, QTabWidget

from tumble.window.widgets.side_pane import SidePane


@pytest.fixture
def pane(qtbot, qapp):
    tabs = QTabWidget()
    made = SidePane(tabs, tabs, QLabel("in short"), "In short")
    qtbot.addWidget(made)
    made.resize(90 * made.fontMetrics().height(), 300)
    made.show()
    return made


def test_it_is_a_tab_where_the_screen_is_narrow(pane):
    assert not pane.is_folded
    pane.resize(pane.width() - 1, 300)
    assert pane.is_folded


def test_it_is_a_tab_where_text_grows(pane):
    font = QFont(pane.font())
    font.setPointSizeF(2.0 * font.pointSizeF())
    pane.setFont(font)
    assert pane.is_folded
