"""Correlations as a table whose colours say how strong they are: blue one way, orange the other."""

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from tumble.window.look.numbers import local
from tumble.window.work.presentation import Correlations

_BLUE, _ORANGE = "#0072B2", "#D55E00"


class CorrelationTable(QTableWidget):
    """One row and one column for each parameter that has a value."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
        self.setTabKeyNavigation(False)
        self.horizontalHeader().setSectionResizeMode(QHeaderView.ResizeMode.Stretch)

    def show_correlations(self, correlations: Correlations) -> None:
        """Show those of another result."""
        names = [name for name, row in zip(correlations.names, correlations.texts, strict=True) if any(row)]
        places = [correlations.names.index(name) for name in names]
        self.setRowCount(len(names))
        self.setColumnCount(len(names))
        self.setHorizontalHeaderLabels(names)
        self.setVerticalHeaderLabels(names)
        for row, first in enumerate(places):
            for column, second in enumerate(places):
                coefficient = float(correlations.coefficients[first, second])
                item = QTableWidgetItem(local(correlations.texts[first][second]))
                tint = QColor(_BLUE if coefficient > 0 else _ORANGE)
                tint.setAlphaF(min(abs(coefficient), 1.0) * 0.45)
                item.setBackground(tint)
                item.setTextAlignment(Qt.AlignmentFlag.AlignCenter)
                self.setItem(row, column, item)
