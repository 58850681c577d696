"""Every plot tells the values of its points at a crosshair, copies them, and is saved as a picture or a table."""

import csv
import io
import resource
import signal
import xml.etree.ElementTree as ET

import numpy as np
import pytest
from PySide6.QtCore import QEvent, QPointF, Qt
from PySide6.QtGui import QContextMenuEvent, QGuiApplication, QImage, QMouseEvent
from PySide6.QtWidgets import QApplication, QMenu

from tumble.app.exits import JobError
from tumble.messages import Language
from tumble.procedures.errors import InputError
from tumble.window.look.language import speak
from tumble.window.look.plots import Plot
from tumble.window.look.shades import Shade
from tumble.window.look.theme import dress
from tumble.window.plots import saving
from tumble.window.plots.sight import sight_of
from tumble.window.plots.values import Series, Values
from tumble.window.widgets.series_plot import SeriesPlot


@pytest.fixture
def plot(qapp):
    """Two series against an angle: `lower` at 0, 10 and 20 degrees, `upper` at 0 and 20."""
    speak(Language.ENGLISH)
    dress(qapp, Shade.LIGHT, 1.0)
    plot = SeriesPlot(("lower", "upper"), bottom="angle (°)", left="voltage (V)")
    plot.resize(500, 300)
    plot.draw_series(
        {
            "lower": (np.array([0.0, 20.0, 10.0]), np.array([1.0, 1.25, 1.125])),
            "upper": (np.array([0.0, 20.0]), np.array([3.0, 3.5])),
        }
    )
    plot.show()
    plot.getViewBox().updateAutoRange()
    plot.setFocus()
    yield plot
    speak(Language.ENGLISH)
    plot.hide()
    plot.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)


def move_to(plot, x, y, buttons=Qt.MouseButton.NoButton):
    """Bring the mouse a few pixels beside a point."""
    place = QPointF(*sight_of(plot).pixels(np.array([x]), np.array([y]))[:, 0]) + QPointF(4.0, 3.0)
    button, modifiers = Qt.MouseButton.NoButton, Qt.KeyboardModifier.NoModifier
    event = QMouseEvent(QEvent.Type.MouseMove, place, plot.viewport().mapToGlobal(place), button, buttons, modifiers)
    QApplication.sendEvent(plot.viewport(), event)


def test_the_point_at_the_mouse_is_told_with_units(plot):
    move_to(plot, 20.0, 3.5)
    assert plot.crosshair.isVisible()
    assert plot.crosshair.text == "upper\nangle: 20.0000°\nvoltage: 3.50000 V"


def test_it_is_told_in_the_language_of_the_window(plot):
    speak(Language.GERMAN)
    move_to(plot, 10.0, 1.125)
    assert plot.crosshair.text.splitlines()[-1] == "voltage: 1,12500 V"


def test_far_from_any_point_nothing_is_told(plot):
    move_to(plot, 10.0, 2.3)
    assert not plot.crosshair.isVisible()


def test_nothing_is_told_while_the_mouse_drags(plot):
    move_to(plot, 20.0, 3.5)
    move_to(plot, 20.0, 3.5, Qt.MouseButton.LeftButton)
    assert not plot.crosshair.isVisible()


def test_the_mouse_takes_it_away(plot):
    move_to(plot, 20.0, 3.5)
    QApplication.sendEvent(plot.viewport(), QEvent(QEvent.Type.Leave))
    assert plot.crosshair.text == ""


def test_arrow_keys_go_from_point_to_point_along_the_abscissa(qtbot, plot):
    seen = []
    for _ in range(4):
        qtbot.keyClick(plot, Qt.Key.Key_Right)
        seen.append(plot.crosshair.point.place)
    assert seen == [(0.0, 1.0), (10.0, 1.125), (20.0, 1.25), (20.0, 1.25)]
    qtbot.keyClick(plot, Qt.Key.Key_Left)
    assert plot.crosshair.point.place == (10.0, 1.125)


def test_arrow_keys_go_to_the_nearest_point_of_another_series(qtbot, plot):
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Right, Qt.Key.Key_Down):
        qtbot.keyClick(plot, key)
    assert plot.crosshair.point.place == (20.0, 3.5)
    qtbot.keyClick(plot, Qt.Key.Key_Up)
    assert plot.crosshair.point.place == (20.0, 1.25)


def test_arrow_keys_reach_every_series_without_names(qtbot, qapp):
    plot = Plot("x (s)", "y (V)")
    for height in (0.0, 1.0, 2.0):
        plot.plot([0.0, 1.0], [height, height])
    plot.resize(500, 300)
    plot.show()
    plot.getViewBox().updateAutoRange()
    qtbot.keyClick(plot, Qt.Key.Key_Right)
    heights = {plot.crosshair.point.place[1]}
    for _ in range(2):
        qtbot.keyClick(plot, Qt.Key.Key_Down)
        heights.add(plot.crosshair.point.place[1])
    assert heights == {0.0, 1.0, 2.0}
    plot.deleteLater()


def test_repeats_at_one_abscissa_are_all_reached(qtbot, plot):
    plot.draw_series({"lower": (np.zeros(3), np.array([1.0, 2.0, 3.0]))})
    plot.getViewBox().updateAutoRange()
    seen = []
    for _ in range(3):
        qtbot.keyClick(plot, Qt.Key.Key_Right)
        seen.append(plot.crosshair.point.place[1])
    assert seen == [1.0, 2.0, 3.0]


def test_what_is_told_is_told_to_a_screen_reader(qtbot, plot):
    qtbot.keyClick(plot, Qt.Key.Key_Right)
    assert plot.accessibleDescription() == "lower\nangle: 0.0000°\nvoltage: 1.00000 V"
    plot.clearFocus()
    assert plot.accessibleDescription() == ""


def test_points_out_of_sight_are_passed_over(qtbot, plot):
    plot.getViewBox().setRange(xRange=(5.0, 25.0), padding=0)
    qtbot.keyClick(plot, Qt.Key.Key_Right)
    assert plot.crosshair.point.place == (10.0, 1.125)


def test_without_points_the_keys_do_nothing(qtbot, plot):
    plot.draw_series({})
    for key in (Qt.Key.Key_Right, Qt.Key.Key_Down):
        qtbot.keyClick(plot, key)
    assert not plot.crosshair.isVisible()


def test_a_new_run_takes_the_crosshair_away(qtbot, plot):
    qtbot.keyClick(plot, Qt.Key.Key_Right)
    plot.begin_anew()
    assert not plot.crosshair.isVisible()


def test_the_values_are_copied_as_a_spreadsheet_takes_them(qtbot, plot):
    qtbot.keyClick(plot, Qt.Key.Key_C, Qt.KeyboardModifier.ControlModifier)
    lines = QGuiApplication.clipboard().text().splitlines()
    assert lines[0] == "series\tangle (°)\tvoltage (V)"
    assert lines[1:3] == ["lower\t0\t1", "lower\t20\t1.25"]
    assert len(lines) == 6


def test_a_single_line_needs_no_name_and_what_is_no_number_is_left_empty(plot):
    plot.draw_series({})
    plot.name_axes("time (min)", "temperature (°C)")
    plot.plot([1.0, 2.0], [23.5, np.nan])
    assert plot.values().as_csv() == "time (min),temperature (°C)\n1,23.5\n2,\n"


def test_intervals_and_moments_are_told_where_a_plot_states_them():
    series = Series(
        name="SN-1",
        x=np.array([0.0]),
        y=np.array([1.0]),
        low=np.array([0.9]),
        high=np.array([1.1]),
        x_texts=("2026-11-20 10:00:00+01:00",),
    )
    (headings, row) = csv.reader(io.StringIO(Values(bottom="time", left="kx (V/g)", series=(series,)).as_csv()))
    assert headings == ["series", "time", "kx (V/g)", "lower end", "upper end"]
    assert row == ["SN-1", "2026-11-20 10:00:00+01:00", "1", "0.9", "1.1"]


def test_a_table_holds_every_digit(plot, tmp_path):
    plot.draw_series({"lower": (np.array([1.0 / 3.0]), np.array([2.5e-7]))})
    saving.save(saving.contents(plot.savable), tmp_path / "plot.csv")
    assert (tmp_path / "plot.csv").read_text("utf-8").splitlines()[1] == "lower,0.333333333333,2.5e-07"


def test_a_picture_in_pixels_is_twice_as_sharp_as_the_screen(plot, tmp_path):
    saving.save(saving.contents(plot.savable), tmp_path / "plot.png")
    picture = QImage(str(tmp_path / "plot.png"))
    assert (picture.width(), picture.height()) == (2 * plot.viewport().width(), 2 * plot.viewport().height())
    assert picture.pixelColor(0, 0) == plot.backgroundBrush().color()


def test_a_picture_in_lines_holds_no_pixels(plot, tmp_path):
    saving.save(saving.contents(plot.savable), tmp_path / "plot.svg")
    names = {each.tag.rpartition("}")[2] for each in ET.fromstring((tmp_path / "plot.svg").read_text("utf-8")).iter()}
    assert "image" not in names
    assert {"path", "text"} <= names


def test_the_screen_is_drawn_as_before_afterwards(plot, tmp_path):
    before = plot.grab().toImage()
    saving.save(saving.contents(plot.savable), tmp_path / "plot.svg")
    assert plot.grab().toImage() == before


@pytest.mark.parametrize("name", ["plot.svg", "plot.png", "plot.csv"])
def test_a_full_disk_is_told_and_leaves_nothing(plot, tmp_path, name):
    before, handler = resource.getrlimit(resource.RLIMIT_FSIZE), signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
    contents = saving.contents(plot.savable)
    resource.setrlimit(resource.RLIMIT_FSIZE, (16, before[1]))
    try:
        with pytest.raises(JobError, match="cannot be written"):
            saving.save(contents, tmp_path / name)
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)
        signal.signal(signal.SIGXFSZ, handler)
    assert not list(tmp_path.iterdir())


def test_a_file_that_is_there_is_not_written_over(plot, tmp_path):
    (tmp_path / "plot.png").write_bytes(b"a picture")
    with pytest.raises(InputError, match="is there already"):
        saving.save(saving.contents(plot.savable), tmp_path / "plot.png")


@pytest.mark.parametrize(("name", "told"), [("plot.bmp", ".bmp is no format"), ("plot", "no ending is no format")])
def test_another_format_is_refused_in_a_sentence(plot, tmp_path, name, told):
    with pytest.raises(InputError, match=told):
        saving.save(saving.contents(plot.savable), tmp_path / name)


def test_what_cannot_be_written_is_told_and_leaves_nothing(plot, tmp_path):
    (tmp_path / "file").write_text("no folder")
    with pytest.raises(JobError):
        saving.save(saving.contents(plot.savable), tmp_path / "file" / "plot.png")


@pytest.mark.parametrize(("left", "name"), [("output (V)", "output"), ("", "plot"), ("k/x: ±", "k-x")])
def test_a_file_is_called_after_the_ordinate(plot, left, name):
    plot.name_axes("angle (°)", left)
    assert plot.savable.name == name


def titles(menu):
    return [action.text().partition("\t")[0].replace("&", "") for action in menu.actions()]


def test_the_menu_key_shows_what_can_be_done(qtbot, plot):
    place = plot.rect().center()
    event = QContextMenuEvent(QContextMenuEvent.Reason.Keyboard, place, plot.mapToGlobal(place))
    QApplication.sendEvent(plot, event)
    menu = plot.findChild(QMenu)
    assert titles(menu) == ["Copy the values", "Save…", "One step back", "The whole picture"]
    menu.actions()[0].trigger()
    assert QGuiApplication.clipboard().text().startswith("series\t")
    menu.close()


def test_the_right_button_does_so_too(qtbot, plot):
    qtbot.mouseClick(plot.viewport(), Qt.MouseButton.RightButton)
    qtbot.waitUntil(lambda: plot.findChild(QMenu) is not None)
    plot.findChild(QMenu).close()


def test_the_window_asks_for_the_file_and_says_where_it_is(driver, tmp_path):
    window = driver.window
    window.open(window.run)
    plot = window.run.view.figures.output
    driver.bot.keyClick(plot, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    (dialog,) = window.dialogs.open
    dialog.chosen.emit(tmp_path / "output.svg")
    assert (tmp_path / "output.svg").is_file()
    assert "output.svg" in window.notices.cards[0].notice.text


def test_a_file_that_cannot_be_written_is_a_notice(driver, tmp_path):
    window = driver.window
    window.open(window.run)
    driver.bot.keyClick(window.run.view.figures.output, Qt.Key.Key_S, Qt.KeyboardModifier.ControlModifier)
    window.dialogs.open[0].chosen.emit(tmp_path / "output.bmp")
    assert ".bmp is no format of a plot" in window.notices.cards[0].notice.text


@pytest.mark.parametrize("ending", ["svg", "png", "csv"])
def test_a_plot_that_goes_while_its_file_is_chosen_is_saved(driver, tmp_path, ending):
    gone = Plot("x (s)", "y (V)", parent=driver.window)
    gone.plot([1.0, 2.0], [3.0, 4.0])
    gone.save()
    gone.deleteLater()
    QApplication.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    driver.window.dialogs.open[0].chosen.emit(tmp_path / f"gone.{ending}")
    assert (tmp_path / f"gone.{ending}").stat().st_size
