"""Records (to come)."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget


class RecordsScreen(QWidget):
    opened = Signal(object)
    refused = Signal(object)
    resume_wanted = Signal(object, object)

    def __init__(self, background, store):
        super().__init__()

    def allow_runs(self, allowed): ...
    def refresh(self): ...
