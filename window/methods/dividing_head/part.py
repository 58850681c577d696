"""The dividing head among the methods that the window shows."""

from typing import Final

from tumble.window.generic.section_list import SectionList
from tumble.window.look.language import tr
from tumble.window.method import Tabs, WindowPart
from tumble.window.methods.dividing_head.figures import HeadFigures
from tumble.window.methods.dividing_head.mount_prompt import MountPrompt
from tumble.window.methods.dividing_head.mounts import MountWords
from tumble.window.methods.dividing_head.pose_map import PoseMap
from tumble.window.methods.dividing_head.presenting import budget_of, present
from tumble.window.methods.dividing_head.result_plots import FitPlot, ResidualFigure
from tumble.window.parts import ResultTab


def _tabs() -> Tabs:
    fit, residuals, budget = FitPlot(), ResidualFigure(), SectionList()
    return (
        ResultTab(title=tr("Fit"), widget=fit, show=fit.show_presentation),
        ResultTab(title=tr("Residuals"), widget=residuals, show=residuals.show_presentation),
        ResultTab(
            title=tr("Budget"), widget=budget, show=lambda presentation: budget.show_sections(budget_of(presentation))
        ),
    )


PART: Final = WindowPart(
    words=MountWords(),
    prompt=MountPrompt,
    overview=PoseMap,
    figures=HeadFigures,
    present=present,
    tabs=_tabs,
)
