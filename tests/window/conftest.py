"""The real main window, on a screen that nobody sees, with settings and a store of its own."""

import gc
import os
from pathlib import Path
from threading import Event

os.environ.setdefault("QT_QPA_PLATFORM", f"offscreen:configfile={Path(__file__).with_name('screen.json')}")

import pytest
from app_jobs import blank_figures, tracing_once
from PySide6.QtCore import QSettings
from window_driver import LONG, TINY, Driver, take_away

from tumble.calibrations.methods.dividing_head import analysis
from tumble.messages import Language
from tumble.window.start import Application, application
from tumble.window.work import queue_file
from tumble.window.work.queue_file import QueueFile
from tumble.window.work.session import StandSession


@pytest.fixture(scope="session")
def qapp():
    """The one application, under the name that its settings have."""
    QSettings.setDefaultFormat(QSettings.Format.IniFormat)
    return application()


@pytest.fixture(scope="module", autouse=True)
def garbage():
    """A window collects garbage itself; whatever else these tests do in the same process has Python do it again."""
    yield
    gc.enable()


@pytest.fixture(scope="module", autouse=True)
def few_trials():
    """Monte Carlo takes most of the time of a fit; how well it does is tested elsewhere."""
    simulate = analysis.monte_carlo
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(analysis, "monte_carlo", lambda *arguments: simulate(*arguments[:-1], 100))
        yield


@pytest.fixture(scope="module", autouse=True)
def traced_once():
    """Rows that several runs have in common are traced by the first of them."""
    with tracing_once():
        yield


@pytest.fixture(scope="module", autouse=True)
def figures():
    """Nobody looks at the figures of a report; a file where somebody does has a fixture of this name of its own."""
    with blank_figures():
        yield


@pytest.fixture
def no_report():
    """Drawing takes two seconds; a test of something else does without, whatever else it undoes."""
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr("tumble.calibrations.report.page.html", lambda _: "<html></html>")
        yield


@pytest.fixture
def settings(tmp_path, qapp):
    """Settings that nobody has changed."""
    QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(tmp_path / "settings"))
    QSettings().clear()
    QSettings().setValue("look/language", str(Language.ENGLISH))
    QSettings().setValue("look/shade", "light")
    return QSettings()


@pytest.fixture
def driver(qtbot, qapp, settings, tmp_path, monkeypatch):
    """The window, with its simulated stand hurried, and what a person does with it."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    settings.setValue("simulation/speed", 0)
    running = Application(qapp, tmp_path / "store")
    yield Driver(qtbot, running)
    take_away(qapp, running)


@pytest.fixture(scope="module")
def home(qapp, tmp_path_factory):
    """Settings, state and store of the windows that a module shares."""
    home = tmp_path_factory.mktemp("window")
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("XDG_STATE_HOME", str(home / "state"))
        QSettings.setPath(QSettings.Format.IniFormat, QSettings.Scope.UserScope, str(home / "settings"))
        QSettings().clear()
        QSettings().setValue("look/language", str(Language.ENGLISH))
        QSettings().setValue("look/shade", "light")
        yield home


@pytest.fixture(scope="module")
def shared_window(qapp, home):
    """One window for the tests of a module that do not mind each other, with settings and a store of its own."""
    running = Application(qapp, home / "store")
    yield running
    take_away(qapp, running)


@pytest.fixture(scope="module")
def windows(qapp, home):
    """The window that a module lends to its tests; those that close it leave none, and the next one has another."""
    windows = []
    yield windows
    for running in windows:
        take_away(qapp, running)


@pytest.fixture
def lent_driver(qtbot, qapp, home, windows, tmp_path, monkeypatch):
    """As `driver`, with a window that other tests have had, which looks as if it were new."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    if not windows:
        QSettings().setValue("simulation/speed", 0)
        windows.append(Application(qapp, tmp_path / "store"))
    driver = Driver(qtbot, windows[0])
    driver.begin_anew(tmp_path / "store")
    yield driver
    if not driver.window.isVisible():
        take_away(qapp, windows.pop())
        return
    driver.finish()


@pytest.fixture(scope="session")
def driver_of():
    """Makes of a window that is shared what a person does with it."""
    return Driver


@pytest.fixture
def write(tmp_path):
    """Writes a file and returns its path."""

    def write_file(name, text):
        path = tmp_path / name
        path.write_text(text, encoding="utf-8")
        return path

    return write_file


@pytest.fixture
def tiny(write):
    """Programme of six dwells."""
    return write("tiny.toml", TINY)


@pytest.fixture
def long(write):
    """Programme of six hundred dwells."""
    return write("long.toml", LONG)


@pytest.fixture
def both(tmp_path, qapp):
    """The queue of one store as two windows have it."""
    queues = QueueFile(tmp_path), QueueFile(tmp_path)
    yield queues
    for each in queues:
        each.leave()


@pytest.fixture
def impatient(monkeypatch):
    """Waits for nothing."""
    for name in ("_CHANGE_S", "_CLAIM_S", "_PATIENCE_S"):
        monkeypatch.setattr(queue_file, name, 0.0)


@pytest.fixture
def reaching(monkeypatch):
    """A stand that is reached for as long as nobody stops that; tells whether it is."""
    begun = Event()

    def identify(_session, connected):
        begun.set()
        while True:
            connected.stand.attention.check()

    monkeypatch.setattr(StandSession, "_identity", identify)
    return begun
