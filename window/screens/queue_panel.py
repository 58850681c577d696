"""The queue as it is shown, and what a person does with it."""

from PySide6.QtWidgets import QWidget

from tumble.window.screens.queue_runner import QueueRunner
from tumble.window.widgets.queue_view import QueueView


class QueuePanel(QueueView):
    """Shows the queue that a runner carries out."""

    def __init__(self, runner: QueueRunner, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._runner = runner
        self.move_wanted.connect(runner.move)
        self.remove_wanted.connect(runner.remove)
        self.clear_wanted.connect(runner.clear)
        runner.changed.connect(self._show)
        self._show()

    def _show(self) -> None:
        self.show_entries(self._runner.queue.entries)
        self.say(self._runner.said)
