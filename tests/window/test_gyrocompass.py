"""Gyrocompassing in the window: the pictures of its result stand beside the others."""

import pytest

from tumble.procedures.methods.gyrocompass.layout import LAYOUT
from tumble.procedures.steps import Point, Reading
from tumble.window.generic.figure_list import FigureList
from tumble.window.generic.point_table import PointTable
from tumble.window.registry import window_part


@pytest.mark.usefixtures("qapp")
def test_its_pictures_have_a_tab():
    tabs = window_part("gyrocompass").tabs()

    assert [tab.title for tab in tabs if isinstance(tab.widget, FigureList)] == ["Pictures"]


@pytest.mark.usefixtures("qapp")
def test_a_channel_that_the_stand_lacks_stands_empty_beside_the_others():
    reading = Reading(mean=1.25, sd=0.01, samples=100)
    point = Point(
        index=0,
        positions_deg={"azimuth": 90.0},
        directions={"azimuth": 1},
        readings=dict.fromkeys(("levelling_rate_deg_h", "tilt_gamma_deg"), reading),
        time_s=5.0,
        temperature_degc=None,
        procedure="position",
        realisation=1,
        settled=True,
    )
    shown = PointTable(LAYOUT)

    shown.show_plan((), [point])

    assert [shown.table.item(0, column).text() for column in range(2, 6)] == ["90.0000", "1.2500", "", "1.2500"]
