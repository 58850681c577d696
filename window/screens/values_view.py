"""The values to use, and below them, where there is room, the figure that says most."""

from typing import Final

from PySide6.QtCore import QSize
from PySide6.QtGui import QResizeEvent
from PySide6.QtWidgets import QSizePolicy, QVBoxLayout, QWidget

from tumble.window.generic.figure_list import figure_of
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.values_table import ValuesTable
from tumble.window.work.presentation import Drawn, Presentation

_HIGH_LINES: Final = 10
"""A figure that is less high than so many lines of text is left out: tabs have it, too."""


class ValuesView(QWidget):
    """Values come first: the figure has the room that they leave."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.table, self.picture = ValuesTable(), QWidget()
        self._drawn = False
        self._caption = PlainLabel()
        self._caption.setWordWrap(True)
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSizeConstraint(QVBoxLayout.SizeConstraint.SetNoConstraint)
        self._column.addWidget(self.table, stretch=1)
        self._column.addWidget(self.picture, stretch=2)
        self._column.addWidget(self._caption)
        self._share_out()

    def show_presentation(self, presentation: Presentation) -> None:
        """Show another result."""
        self.table.show_lines(presentation.table)
        self._take(presentation.picture)
        self._share_out()

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """What the values cannot do without: the figure goes where a window becomes smaller."""
        return self.table.minimumSizeHint()

    def resizeEvent(self, event: QResizeEvent) -> None:  # noqa: N802  # Qt's name
        """See whether there is room for the figure."""
        super().resizeEvent(event)
        self._share_out()

    def _take(self, drawn: Drawn | None) -> None:
        before, self.picture = self.picture, QWidget() if drawn is None else figure_of(drawn)
        self._drawn = drawn is not None
        self._column.replaceWidget(before, self.picture)
        before.hide()
        before.deleteLater()
        self._caption.setText("" if drawn is None else in_language(drawn.caption or drawn.title))

    def _share_out(self) -> None:
        """Give the table the height of its lines, and the figure what is left; without one the table has it all."""
        least = max(self.picture.minimumSizeHint().height(), self.picture.minimumHeight())  # a picture has the latter
        wanted = max(_HIGH_LINES * self.fontMetrics().height(), least)
        left = self.height() - self.table.sizeHint().height() - self._caption.sizeHint().height()
        has_room = self._drawn and left >= wanted
        vertical = QSizePolicy.Policy.Maximum if has_room else QSizePolicy.Policy.Expanding
        self.table.setSizePolicy(QSizePolicy.Policy.Expanding, vertical)
        for part in (self.picture, self._caption):
            part.setVisible(has_room)
