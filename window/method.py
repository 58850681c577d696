"""What a calibration method brings along for the window; `registry` finds it."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TypeAlias

from tumble.procedures.layout import Layout
from tumble.window.generic.channel_plots import ChannelPlots
from tumble.window.generic.point_table import PointTable
from tumble.window.generic.presenting import present
from tumble.window.generic.section_list import section_tabs
from tumble.window.look.conditions import ConditionWords
from tumble.window.parts import Figures, Overview, ResultTab
from tumble.window.widgets.prompts import ConditionPrompt
from tumble.window.work.activity import Concluded
from tumble.window.work.background import Background
from tumble.window.work.presentation import Presentation

Tabs: TypeAlias = Sequence[ResultTab]


@dataclass(frozen=True, kw_only=True)
class WindowPart:
    """How a method is shown. What it does not bring along is shown as of any method, by what it declares of itself."""

    words: ConditionWords = field(default_factory=ConditionWords)
    """What the log says of a condition that the operator sets."""
    prompt: Callable[[Layout], ConditionPrompt] = ConditionPrompt
    """Asks the operator to set a condition."""
    overview: Callable[[Layout], Overview] = PointTable
    """Shows where a run is in its programme."""
    figures: Callable[[Layout, Background], Figures] = ChannelPlots
    """Draws the points of a run while it goes on."""
    present: Callable[[Concluded], Presentation] = present
    """Works out what is shown of a result; called outside of the event loop."""
    tabs: Callable[[], Tabs] = section_tabs
    """What the screen Result shows beside parameters, correlations and closed loop."""
