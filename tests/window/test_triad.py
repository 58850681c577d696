"""A triad in the window: the position that is taken, its three outputs, and the pictures of its result."""

from importlib import resources

import pytest
from PySide6.QtSvgWidgets import QSvgWidget
from PySide6.QtWidgets import QLabel

from tumble.window.generic.figure_list import FigureList
from tumble.window.generic.section_list import SectionList
from tumble.window.look.plots import Plot
from tumble.window.methods.triad.pose_overview import PoseOverview

STAND = resources.files("tumble.procedures.methods.triad") / "stand.toml"
LONG = """method = "triad"
name = "long"
dwell_s = 600
settle_s = 0.1

[[procedure]]
list = "6"
"""
SHORT = """method = "triad"
name = "short"
dwell_s = 0.2
settle_s = 0.1

[[procedure]]
list = "12o"
"""


@pytest.fixture(scope="module", autouse=True)
def figures():
    """They are drawn here."""


@pytest.fixture
def measured(lent_driver, write):
    lent_driver.window.stand.open(write("two_axes.toml", STAND.read_text("utf-8")))
    lent_driver.window.open(lent_driver.run)
    lent_driver.start(write("short.toml", SHORT))
    lent_driver.wait_for_result()
    return lent_driver


def test_from_a_programme_to_the_pictures_of_its_result(measured):
    view = measured.run.view
    assert isinstance(view.overview, PoseOverview)
    assert view.overview.done == 12
    assert view.overview.picture.accessibleName() == "outer 180°, inner -90°"
    assert view.overview.picture.renderer().isValid()
    (pictures,) = measured.window.result.findChildren(FigureList)
    assert len(pictures.figures) == 4
    drawn = [figure for figure in pictures.figures if isinstance(figure, QSvgWidget)]
    assert all(figure.renderer().isValid() for figure in drawn)
    plots = [plot for figure in pictures.figures for plot in figure.findChildren(Plot)]
    assert (len(drawn), len(plots)) == (3, 1)
    assert plots[0].values().series


def test_dwells_of_ten_minutes_show_how_the_noise_falls(lent_driver, write):
    stand = STAND.read_text("utf-8").replace("rate_hz = 50.0", "rate_hz = 0.5")
    lent_driver.window.stand.open(write("two_axes.toml", stand))
    lent_driver.window.open(lent_driver.run)
    lent_driver.start(write("long.toml", LONG))
    lent_driver.wait_for_result()

    (pictures,) = lent_driver.window.result.findChildren(FigureList)
    assert "Allan deviation" in [figure.accessibleName() for figure in pictures.figures]
    (details,) = lent_driver.window.result.findChildren(SectionList)
    said = [label.text() for label in details.findChildren(QLabel)]
    assert "How long to average" in said
