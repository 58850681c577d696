"""Every screen in every language: nothing is cut off, in another language, on something else, or too faint."""

from itertools import combinations

import pytest
from PySide6.QtCore import QSettings
from PySide6.QtWidgets import QLabel, QPushButton, QScrollArea, QTabWidget, QVBoxLayout, QWidget

from benchmarks.window_flaws import LEAST_CONTRAST, access_keys, flaws, painted_contrast
from benchmarks.window_tour import Tour, pale
from tumble.messages import Language
from tumble.window.look.shades import CONTRAST, DARK, LIGHT, Shade

SMALL = (1264, 760)
"""1280 × 800 without the frame of a window manager."""


@pytest.fixture(scope="module")
def tour(shared_window, tmp_path_factory):
    """A window with a result and a record, led through its states."""
    QSettings().setValue("simulation/speed", 0)
    QSettings().setValue("simulation/imagined", "true")
    shared_window.window.stand.simulation.imagined.setChecked(True)
    shared_window.window.stand.simulation.speed.setCurrentIndex(0)
    made = Tour(shared_window, tmp_path_factory.mktemp("tour"))
    made.measure()
    return made


@pytest.mark.parametrize("scale", [1.0, 2.0])
@pytest.mark.parametrize("language", Language)
def test_every_text_is_whole_and_in_the_language(tour, language, scale):
    tour.take(language, Shade.LIGHT, SMALL, scale)
    assert [(state, flaw) for state in tour.states() for flaw in flaws(tour.window, language)] == []


@pytest.mark.parametrize("shade", [Shade.LIGHT, Shade.DARK, Shade.CONTRAST])
def test_every_text_and_mark_stands_out_from_its_ground(tour, shade):
    tour.take(Language.ENGLISH, shade, SMALL, 1.0)
    assert [(state, faint) for state in tour.states() for faint in pale(tour.window)] == []


@pytest.mark.parametrize("colours", [LIGHT, DARK, CONTRAST])
def test_inks_are_told_apart(colours):
    inks = (colours.ink, colours.accent, colours.now, colours.bad, colours.good)
    assert all(one != other for one, other in combinations(inks, 2))


def label(qtbot, ink, ground):
    part = QLabel("Ready")
    part.setStyleSheet(f"color: {ink}; background: {ground};")
    qtbot.addWidget(part)
    part.show()
    return part


@pytest.mark.parametrize(
    ("ink", "ground", "contrast"),
    [("#000000", "#FFFFFF", 21.0), ("#777777", "#FFFFFF", 4.48), ("#FFFFFF", "#0000FF", 8.59)],
)
def test_contrast_is_measured_as_it_is_painted(qtbot, qapp, ink, ground, contrast):
    """By hand from the definition of WCAG 2.1: (lighter + 0.05) / (darker + 0.05) of the relative luminances."""
    assert painted_contrast(label(qtbot, ink, ground)) == pytest.approx(contrast, abs=0.01)


def test_faint_text_is_found(qtbot, qapp):
    assert painted_contrast(label(qtbot, "#777777", "#FFFFFF")) < LEAST_CONTRAST


def test_text_without_room_is_found(qtbot, qapp):
    place = QWidget()
    qtbot.addWidget(place)
    part = QLabel("a text that is long", place)
    part.setGeometry(0, 0, 20, 30)
    place.show()
    assert flaws(place, Language.ENGLISH) == ["cut off: QLabel “a text that is long”"]


def test_a_page_that_is_moved_sideways_is_found(qtbot):
    window, page = QWidget(), QWidget()
    qtbot.addWidget(window)
    area = QScrollArea(window)
    area.setFrameShape(QScrollArea.Shape.NoFrame)
    page.setFixedSize(300, 10)
    area.setWidget(page)
    area.resize(200, 100)
    window.show()
    assert flaws(window, Language.ENGLISH) == ["100 px sideways: QWidget"]


def test_tabs_without_room_are_found(qtbot):
    tabs = QTabWidget()
    qtbot.addWidget(tabs)
    for title in ("Parameters", "Correlations", "Closed loop"):
        tabs.addTab(QWidget(), title)
    tabs.resize(150, 100)
    tabs.show()
    assert flaws(tabs, Language.ENGLISH) == ["no room for all tabs: Parameters, Correlations, Closed loop"]


def test_a_key_that_is_underlined_twice_is_found(qtbot):
    window = QWidget()
    qtbot.addWidget(window)
    column = QVBoxLayout(window)
    for text in ("&Open", "C&lose", "&Order"):
        column.addWidget(QPushButton(text))
    window.show()
    assert access_keys(window) == {"Alt+O": ["&Open", "&Order"], "Alt+L": ["C&lose"]}
    assert flaws(window, Language.ENGLISH) == ["one key, Alt+O, for &Open and &Order"]
