"""The rows of buttons and progress above a run."""

from typing import Final

from PySide6.QtWidgets import QHBoxLayout, QLabel, QProgressBar, QSpinBox, QVBoxLayout, QWidget

from tumble.procedures.progress import TimeLeft
from tumble.window.look.language import tr
from tumble.window.look.numbers import minutes
from tumble.window.screens.run_state import RunState
from tumble.window.widgets.folding_row import FoldingRow
from tumble.window.widgets.motion_button import MotionButton

_MOST_REPEATS: Final = 99


class RunControls(QWidget):
    """Start, pause, go on, repeat; the queue likewise; how far a run is. Knows which of them means something now."""

    def __init__(self, summary: QWidget, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.start = MotionButton(tr("Start"), "F5")
        self.pause = MotionButton(tr("Pause"), "F6")
        self.resume = MotionButton(tr("Go on"), "F7")
        self.again = MotionButton(tr("Repeat point"), "Ctrl+F7")
        self.add = MotionButton(tr("Add to the queue"), "F2")
        self.start_queue = MotionButton(tr("Start the queue"), "F4")
        self.hold_queue = MotionButton(tr("Hold the queue"), "F4")
        self.repeats = QSpinBox()
        self._summary = summary
        self._bar, self._left, self.state = QProgressBar(), QLabel(), QLabel()
        self._lay_out()

    def show_form(self, shown: bool) -> None:
        """Whether it is shown what the form asks for: what goes with it is out of the way of a scanner otherwise."""
        for part in (self._summary, self.repeats):
            part.setVisible(shown)

    def show_state(self, now: RunState, free: bool, named: bool) -> None:
        """Show where the run stands; `free` is the stand where nobody uses it, `named` a unit that is typed."""
        running = now.running
        self.start.setEnabled(free and named)
        self.pause.setEnabled(running and not now.paused and not now.pausing)
        self.resume.setEnabled(now.paused or now.pausing)
        self.again.setEnabled(now.repeatable)
        self.state.setText(now.text)

    def show_queue(self, waiting: int, going: bool) -> None:
        """Show what can be done with the queue, in which so many runs wait; it begins when the stand is free."""
        self.start_queue.setVisible(not going)
        self.start_queue.setEnabled(waiting > 0)
        self.hold_queue.setVisible(going)

    def begin(self, dwells: int, points: int) -> None:
        """Count a run that begins with some points of its dwells."""
        self._bar.setRange(0, dwells)
        self.count(points, None)

    def count(self, done: int, left: TimeLeft | None) -> None:
        """Show how many points are done, and the time that is left."""
        self._bar.setUpdatesEnabled(False)  # it would be painted at once, and with it whatever else has changed
        self._bar.setValue(done)
        self._bar.setFormat(f"{done} / {self._bar.maximum()}")
        self._bar.setUpdatesEnabled(True)
        self.say("" if left is None else _time_left(left))

    def say(self, text: str) -> None:
        """Say how far it is, in place of the time that is left."""
        self._left.setText(text)

    def say_stage(self, stage: str) -> None:
        """Say how far an analysis is."""
        stages = {
            "fitting": tr("Fitting…"),
            "tracing": tr("Tracing what is left…"),
            "storing": tr("Storing…"),
            "reporting": tr("Writing the report…"),
        }
        self.say(stages.get(stage, stage))

    def _lay_out(self) -> None:
        self.start.setObjectName("primary")
        self.state.setObjectName("heading")
        self.repeats.setRange(1, _MOST_REPEATS)
        self.repeats.setSuffix(" ×")
        self.repeats.setAccessibleName(tr("How often it is measured"))
        self.repeats.setToolTip(self.repeats.accessibleName())
        run, queue = QHBoxLayout(), QHBoxLayout()
        for button in (self.start, self.pause, self.resume, self.again):
            run.addWidget(button)
        run.addStretch()
        queue.addStretch()
        for part in (self.repeats, self.add, self.start_queue, self.hold_queue):
            queue.addWidget(part)
        progress = QHBoxLayout()
        progress.addWidget(self.state)
        progress.addWidget(self._bar, stretch=1)
        progress.addWidget(self._left)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(FoldingRow((_row(run), _row(queue))))
        layout.addWidget(self._summary)
        layout.addLayout(progress)


def _row(parts: QHBoxLayout) -> QWidget:
    row = QWidget()
    parts.setContentsMargins(0, 0, 0, 0)
    row.setLayout(parts)
    return row


def _time_left(left: TimeLeft) -> str:
    return tr("{time} ± {error} left", time=minutes(left.time_s), error=minutes(left.standard_error_s))
