"""The queue as it is shown, and what a person does with it."""

from typing import Final

from PySide6.QtWidgets import QWidget

from tumble.window.look.language import tr
from tumble.window.look.names import short_name
from tumble.window.screens.queue_runner import QueueRunner
from tumble.window.widgets.queue_view import QueueView

_TOLD: Final = 2
"""Units that are said to wait twice: more would push the queue out of sight."""


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
        queue = self._runner.queue
        self.show_entries(queue.entries)
        twice = [_twice_text(unit) for unit in queue.twice]
        self.say("\n".join(filter(None, (self._runner.said, *twice[:_TOLD]))))


def _twice_text(unit: str) -> str:
    return tr("{unit} waits more than once, and is measured as often; Del takes a line out.", unit=short_name(unit))
