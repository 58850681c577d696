"""Result (to come)."""

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QWidget


class ResultScreen(QWidget):
    experiment_wanted = Signal(object)
    refused = Signal(object)

    def __init__(self, background):
        super().__init__()

    def allow_runs(self, allowed): ...
    def use_stand(self, loaded): ...
    def show_result(self, concluded, store):
        self.concluded = concluded
