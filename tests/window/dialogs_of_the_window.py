"""Every dialog, menu and list that the window can open, and how; `test_stop_everywhere` presses STOP under each."""

from pathlib import Path

from PySide6.QtCore import QPoint, Qt
from PySide6.QtGui import QContextMenuEvent
from PySide6.QtWidgets import QApplication, QMenu

from tumble.app.stand import load_stand
from tumble.window import main_window


class _Elsewhere:
    """A run that belongs to another stand."""

    def __init__(self, path):
        self.job = type("Job", (), {"stand": load_stand(path)})()


def _menu(number):
    def open_it(driver):
        menu = driver.window.menuBar().findChildren(QMenu, options=Qt.FindChildOption.FindDirectChildrenOnly)[number]
        menu.popup(driver.window.mapToGlobal(QPoint(10, 30)))

    return open_it


def _list(screen, box):
    def open_it(driver):
        driver.window.open(getattr(driver.window, screen))
        box(driver.window).showPopup()

    return open_it


def _context_menu(screen, field):
    def open_it(driver):
        driver.window.open(getattr(driver.window, screen))
        part = field(driver.window)
        centre = part.rect().center()
        reason = QContextMenuEvent.Reason.Mouse
        QApplication.postEvent(part, QContextMenuEvent(reason, centre, part.mapToGlobal(centre)))

    return open_it


def _plot_menu(driver):
    driver.window.open(driver.window.run)
    driver.window.run.view.figures.output.menu.open_at(driver.window.mapToGlobal(QPoint(600, 300)))


def _export_over(driver, path):
    driver.window.records._exporting._write_unless_there(path)


def _leave_changed(driver, path):
    editor = driver.window.stand.editor
    editor.open(path)
    editor.text.appendPlainText("# a remark")
    editor.leave()


DIALOGS = {
    "stand file": lambda driver, path: driver.window.stand._choose(),
    "programme": lambda driver, path: driver.run.form._choose_file(),
    "file to analyse": lambda driver, path: driver.window.records._choose_file(),
    "export": lambda driver, path: driver.window.records._exporting.ask("20260101-1", "SN 1"),
    "replace": _export_over,
    "discard": lambda driver, path: driver.window.records.discard(path),
    "another stand": lambda driver, path: driver.window.beginning.begin(_Elsewhere(path)),
    "copy of the stand file": lambda driver, path: driver.window.stand.editor._choose_place(),
    "leave the stand file": _leave_changed,
    "leave": lambda driver, path: driver.window.way_out._ask(),
    "save a plot": lambda driver, path: driver.window.run.view.temperature.save(),
}
"""Each is called with the driver and with the path of a stand file, and opens a `Dialog`."""

OVER_THE_SCREENS = {
    "what went wrong": lambda driver, path: driver.window.tell(ValueError("bent")),
    "what a person can mend": lambda driver, path: driver.window.stand.open(path.with_name("absent.toml")),
    "esc stops nothing": lambda driver, path: driver.window._say_what_stops(),
    "finder": lambda driver, path: driver.window.finding.begin(),
}
"""Each is called likewise, and opens what lies over the screens."""

POPUPS = {
    "menu view": _menu(0),
    "menu language": _menu(1),
    "menu help": _menu(2),
    "step": _list("stand", lambda window: window.stand.jog.step),
    "speed": _list("stand", lambda window: window.stand.simulation.speed),
    "programmes": _list("run", lambda window: window.run.form.programme),
    "programmes of records": _list("records", lambda window: window.records.search.programme),
    "verdicts": _list("records", lambda window: window.records.search.verdict),
    "trend": _list("records", lambda window: window.records.trend.parameter),
    "menu of a field": _context_menu("run", lambda window: window.run.form.serial),
    "menu of the log": _context_menu("run", lambda window: window.run.view.log.viewport()),
    "menu of a plot": _plot_menu,
    "menu of a card": _context_menu("stand", lambda window: window.stand.cards.cards["head"]),
    "menu of a table": _context_menu("records", lambda window: window.records.table.viewport()),
}
"""Each is called with the driver, and opens what takes keyboard and mouse to itself."""

SOURCES = {
    ("menus.py", "QMenu"),
    ("finder/sources.py", "QMenu"),
    ("frame.py", "Dialogs"),
    ("beginning.py", "QuestionDialog"),
    ("way_out.py", "QuestionDialog"),
    ("plots/menu.py", "QMenu"),
    ("widgets/action_menu.py", "QMenu"),
    ("plots/saving.py", "FileDialog"),
    ("screens/stand.py", "FileDialog"),
    ("screens/stand_editor.py", "FileDialog"),
    ("screens/stand_editor.py", "QuestionDialog"),
    ("screens/exporting.py", "FileDialog"),
    ("screens/exporting.py", "QuestionDialog"),
    ("screens/records.py", "FileDialog"),
    ("screens/records.py", "QuestionDialog"),
    ("widgets/run_form.py", "FileDialog"),
    ("widgets/dialog.py", "Dialog"),
    ("widgets/dialog.py", "QFileDialog"),
}
"""Where in the package the window's dialogs are named: whoever adds one adds it above, too."""

ROOT = Path(main_window.__file__).parent
