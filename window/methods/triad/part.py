"""The triad among the methods that the window shows."""

from typing import Final

from tumble.window.generic.drawn import present
from tumble.window.generic.figure_list import FigureList
from tumble.window.generic.section_list import section_tabs
from tumble.window.look.language import tr
from tumble.window.method import Tabs, WindowPart
from tumble.window.methods.triad.pose_overview import PoseOverview
from tumble.window.parts import ResultTab


def _tabs() -> Tabs:
    figures = FigureList()
    return (*section_tabs(), ResultTab(title=tr("Pictures"), widget=figures, show=figures.show_presentation))


PART: Final = WindowPart(overview=PoseOverview, present=present, tabs=_tabs)
