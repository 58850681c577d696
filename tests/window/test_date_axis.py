"""Days and months below a trend are in the language of the window."""

from datetime import datetime

import pytest
from pyqtgraph.graphicsItems.DateAxisItem import (
    DAY_HOUR_ZOOM_LEVEL,
    DAY_SPACING,
    HOUR_SPACING,
    MONTH_DAY_ZOOM_LEVEL,
    MONTH_SPACING,
)

from tumble.messages import Language
from tumble.window.look.date_axis import DateAxis
from tumble.window.look.language import speak
from tumble.window.widgets.trend_plot import TrendPlot

SUNDAY_S = datetime(2026, 3, 29, 15, 30).timestamp()


@pytest.fixture
def axis(qapp):
    """An axis that is looked at in German."""
    speak(Language.GERMAN)
    yield DateAxis(orientation="bottom")
    speak(Language.ENGLISH)


@pytest.mark.parametrize(
    ("zoom", "spacing_s", "written"),
    [
        (DAY_HOUR_ZOOM_LEVEL, DAY_SPACING, "So. 29"),
        (MONTH_DAY_ZOOM_LEVEL, MONTH_SPACING, "März"),
        (DAY_HOUR_ZOOM_LEVEL, HOUR_SPACING, "15:30"),
    ],
)
def test_words_are_german(axis, zoom, spacing_s, written):
    axis.zoomLevel = zoom
    assert axis.tickStrings([SUNDAY_S], 1.0, spacing_s) == [written]


def test_a_trend_of_nothing_tells_no_time(qtbot, qapp):
    trend = TrendPlot()
    qtbot.addWidget(trend)
    trend.show_records(())
    assert trend.plot.getAxis("bottom") is trend._numbers
