"""Vibration rectification among the methods that the window shows."""

from typing import Final

from tumble.window.generic.drawn import present
from tumble.window.generic.figure_list import FigureList
from tumble.window.generic.section_list import section_tabs
from tumble.window.look.language import tr
from tumble.window.method import Tabs, WindowPart
from tumble.window.parts import ResultTab


def _tabs() -> Tabs:
    figures = FigureList()
    return (*section_tabs(), ResultTab(title=tr("Pictures"), widget=figures, show=figures.show_presentation))


PART: Final = WindowPart(present=present, tabs=_tabs)
"""What the window shows of vibration rectification."""
