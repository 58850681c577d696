"""What a person does at the window, in the words of the tests."""

import time

from PySide6.QtCore import QEvent, Qt

from tumble.app.stand import load_stand
from tumble.messages import Language
from tumble.window.look.language import speak
from tumble.window.screens.run import Phase
from tumble.window.widgets.notice import Kind

STAND = """\
name = "bench-1"

[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]

[daq]
driver = "simulated"

[simulated]
preset = "DXL203EB"
"""

TINY = """\
name = "tiny"
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "sweep"
step_deg = 60.0
points = 6
"""
"""Six dwells in one mount."""

LONG = TINY.replace("tiny", "long").replace("points = 6", "points = 600").replace("60.0", "1.0")
"""A run that does not end while a test looks at it."""


class Driver:
    """Keys and clicks, and waiting for what comes of them: no longer than a machine takes that is busy with more."""

    def __init__(self, qtbot, running):
        self.bot = qtbot
        self.running = running

    def begin_anew(self, store):
        """Show a window that was used as one that nobody has touched, with another store."""
        window = self.window
        window.store = self.running._store = store
        window.stand.simulation.speed.setCurrentIndex(0)
        window.stand.simulation.imagined.setChecked(False)
        window.stand.jog.angle.clear()
        window.run.form.programme.setCurrentText("seed")
        window.run.form.serial.clear()
        window.run.view.points = []
        window.run.view.log.clear()
        window.run.offered.offer([])
        window.run.broken_off = False
        window.run.queue.open()
        window.run.queue._seated = ""
        window.result.presentation = None
        window.records.tabs.setCurrentIndex(0)
        window.records.refresh()
        window.open(window.stand)
        self.wait(lambda: not (window.background.is_busy or window.records.surveyor.is_busy))

    def finish(self):
        """Stop, leave the stand, close the dialogs: nothing goes on when another test begins."""
        window = self.window
        window.worker.stop()
        self.wait_for_end()
        window.stand.use(load_stand())
        self.wait(lambda: not (window.worker.session.is_connected or window.background.is_busy))
        self.dismiss_all()

    @property
    def window(self):
        return self.running.window

    @property
    def run(self):
        return self.window.run

    @property
    def log(self):
        return self.run.view.log.toPlainText()

    def wait(self, condition, timeout_s=60):
        self.bot.waitUntil(lambda: bool(condition()), timeout=round(timeout_s * 1000))

    def press(self, key, modifiers=Qt.KeyboardModifier.NoModifier, at=None):
        if at is None:  # a shortcut, which only the window that is active has
            self.window.activateWindow()
            self.wait(self.window.isActiveWindow)
        self.bot.keyClick(at or self.window, key, modifiers)

    def type(self, text, at):
        at.setFocus()
        self.bot.keyClicks(at, text)

    def scan(self, text, at=None):
        """Type as a barcode scanner does, with Enter at the end."""
        field = at or self.run.form.serial
        self.bot.keyClicks(field, text)
        self.press(Qt.Key.Key_Return, at=field)

    def open_run(self, programme, serial="SN-1", imagined=True):
        self.window.stand.simulation.imagined.setChecked(imagined)
        self.window.open(self.run)
        self.run.form.add_programme(str(programme))
        self.scan(serial)

    def start(self, programme, serial="SN-1", imagined=True):
        self.open_run(programme, serial, imagined)
        phases = set()
        seen = self.run.course.changed.connect(lambda: phases.add(self.run.phase))
        self.press(Qt.Key.Key_F5)
        self.wait(lambda: phases - {Phase.IDLE} or self.complaints)  # a short run may be over between two looks
        self.run.course.changed.disconnect(seen)

    def wait_for_points(self, count):
        self.wait(lambda: len(self.run.view.points) >= count)

    def wait_for_end(self, timeout_s=60):
        self.wait(lambda: self.run.phase is Phase.IDLE and not self.window.busy, timeout_s)

    def wait_for_result(self, timeout_s=120):
        self.wait(lambda: self.window.result.presentation is not None or self.complaints, timeout_s)
        assert not self.complaints
        return self.window.result.presentation

    @property
    def complaints(self):
        """What the notices of faults say, the oldest first."""
        return [card.notice.text for card in self.window.notices.cards if card.notice.kind is Kind.FAULT]

    def dismiss_all(self):
        """Close dialogs and notices."""
        while self.window.frame.close_newest():
            pass


def take_away(qapp, running):
    """Leave a window, and have Qt forget it."""
    running.window.leave()
    deadline = time.monotonic() + 60.0
    while running.window.isVisible():
        assert time.monotonic() < deadline, "the window does not close"
        qapp.processEvents()
    for made in (running.window, running):
        made.deleteLater()
    qapp.sendPostedEvents(None, QEvent.Type.DeferredDelete)
    speak(Language.ENGLISH)  # tests of parts without a window go by it
