"""Gyrocompassing in the window: the pictures of its result stand beside the others."""

import pytest

from tumble.window.generic.figure_list import FigureList
from tumble.window.registry import window_part


@pytest.mark.usefixtures("qapp")
def test_its_pictures_have_a_tab():
    tabs = window_part("gyrocompass").tabs()

    assert [tab.title for tab in tabs if isinstance(tab.widget, FigureList)] == ["Pictures"]
