"""A triad in the window: the position that is taken, its three outputs, and the pictures of its result."""

from importlib import resources

import pytest

from tumble.window.generic.figure_list import FigureList
from tumble.window.methods.triad.pose_overview import PoseOverview

STAND = resources.files("tumble.procedures.methods.triad") / "stand.toml"
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
    assert all(figure.renderer().isValid() for figure in pictures.figures)
