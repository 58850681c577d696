"""A table of texts."""

from collections.abc import Callable, Collection, Sequence
from typing import Final, Literal, TypeAlias

from PySide6.QtCore import QEvent, Qt, QTimer
from PySide6.QtGui import QAction, QBrush, QColor, QContextMenuEvent, QFocusEvent, QGuiApplication, QKeySequence
from PySide6.QtWidgets import QAbstractItemView, QHeaderView, QTableWidget, QTableWidgetItem, QWidget

from tumble.window.look.language import tr
from tumble.window.look.plain import as_tooltip
from tumble.window.look.theme import colours
from tumble.window.widgets.action_menu import open_menu

Ink: TypeAlias = Literal["bad", "now"]
"""A colour of `Colours`, by its name there: what is written keeps its ink when others are chosen."""
_INK: Final = Qt.ItemDataRole.UserRole + 7
_LEAST_LINES: Final = 6
_NARROW_LINES: Final = 11
"""Width of a column of names, at most."""
_LAST_LINES: Final = 8
"""Width of the last column, at least, in lines of text; with less it is as wide as its texts, and out of sight."""
_BY_KEY: Final = (Qt.FocusReason.TabFocusReason, Qt.FocusReason.BacktabFocusReason, Qt.FocusReason.ShortcutFocusReason)


class Table(QTableWidget):
    """Read, selected and copied by rows; columns as wide as their texts, which wrap in the last one.

    The right button and the key Menu show what can be done with the rows that are chosen. Enter is left to whoever has
    connected `itemActivated`.
    """

    def __init__(self, headings: Sequence[str], parent: QWidget | None = None) -> None:
        super().__init__(0, len(headings), parent)
        self._narrow: Collection[int] = ()
        self._fitting = QTimer(self, singleShot=True)
        self._fitting.timeout.connect(self._fit_last)
        self.setHorizontalHeaderLabels(list(headings))
        self.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
        self.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
        self.setAlternatingRowColors(True)
        self.setTabKeyNavigation(False)
        self.verticalHeader().setVisible(False)
        header = self.horizontalHeader()
        header.setStretchLastSection(True)
        header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self._measure(QHeaderView.ResizeMode.ResizeToContents)
        self._keep_lines()
        self._copying = self._action(tr("Copy rows"), self._copy, QKeySequence(QKeySequence.StandardKey.Copy))
        self.addAction(self._copying)
        self._copying.setEnabled(False)
        self.selectionModel().selectionChanged.connect(lambda: self._copying.setEnabled(bool(self.chosen)))

    def keep_narrow(self, *columns: int) -> None:
        """Have columns of names that people gave leave room for the others, however long one of them is."""
        self._narrow = columns

    def sizeHintForColumn(self, column: int) -> int:  # noqa: N802  # Qt's name
        """Width of the texts of a column, in pixels, and of names no more than there is room for."""
        wanted = super().sizeHintForColumn(column)
        return min(wanted, _NARROW_LINES * self.fontMetrics().height()) if column in self._narrow else wanted

    def offer(self, text: str, do: Callable[[], None], key: str = "") -> QAction:
        """Have something in the menu that can be done with the rows, by a `key` also while the table has the keyboard.

        A button of the same is an `ActionButton` of what is returned.
        """
        action = self._action(text, do, QKeySequence(key))
        self.insertAction(self._copying, action)
        return action

    def _action(self, text: str, do: Callable[[], None], key: QKeySequence) -> QAction:
        action = QAction(text, self)
        action.setShortcut(key)
        action.setShortcutContext(Qt.ShortcutContext.WidgetShortcut)
        action.triggered.connect(lambda _checked: do())
        return action

    def contextMenuEvent(self, event: QContextMenuEvent) -> None:  # noqa: N802  # Qt's name
        """Show what can be done with the rows that are chosen."""
        open_menu(self, event)

    def fill(self, rows: Sequence[Sequence[str]], inks: Sequence[Ink | None] = ()) -> None:
        """Show other rows, each in an ink of its own where one is given."""
        self.clearSpans()
        self._measure(QHeaderView.ResizeMode.Fixed)  # once at the end, and not all cells again after each
        self.write(rows, inks)
        self.colour()
        self._measure(QHeaderView.ResizeMode.ResizeToContents)

    def write(self, rows: Sequence[Sequence[str]], inks: Sequence[Ink | None]) -> None:
        """Put other texts into the cells."""
        self.setRowCount(len(rows))
        for number, row in enumerate(rows):
            ink = inks[number] if number < len(inks) else None
            for column, text in enumerate(row):
                item = self.item_made(text, number, column)
                item.setToolTip(as_tooltip(text))
                if ink is not None:
                    item.setData(_INK, ink)
                self.setItem(number, column, item)

    def colour(self) -> None:
        """Write in the colours of the window; called again where they change."""
        chosen = colours(self)
        for row in range(self.rowCount()):
            for column in range(self.columnCount()):
                item = self.item(row, column)
                if item is not None and (ink := item.data(_INK)):
                    item.setForeground(QBrush(QColor(getattr(chosen, ink))))

    def item_made(self, text: str, row: int, column: int) -> QTableWidgetItem:  # noqa: ARG002  # for tables that are sorted
        """A cell, by its numbers."""
        return QTableWidgetItem(text)

    def cell(self, row: int, column: int) -> QTableWidgetItem:
        """A cell that was written."""
        item = self.item(row, column)
        assert item is not None, "every cell of a row is written"
        return item

    def _measure(self, mode: QHeaderView.ResizeMode) -> None:
        """How rows and columns find their sizes."""
        for header in (self.horizontalHeader(), self.verticalHeader()):
            header.setSectionResizeMode(mode)

    def updateGeometries(self) -> None:  # noqa: N802  # Qt's name
        """See whether the last column has room once the others have found their places."""
        super().updateGeometries()
        self._fitting.start()

    def _fit_last(self) -> None:
        """Wrap in the last column only where there is room for words."""
        header = self.horizontalHeader()
        last = max((each for each in range(self.columnCount()) if not self.isColumnHidden(each)), default=0)
        room = self.viewport().width() - header.sectionPosition(last)
        has_room = room >= _LAST_LINES * self.fontMetrics().height()
        if header.stretchLastSection() and not has_room:
            header.setStretchLastSection(False)
            header.resizeSections(QHeaderView.ResizeMode.ResizeToContents)
        elif has_room and not header.stretchLastSection():
            header.setStretchLastSection(True)
            header.resizeSection(last, room)  # it would stay as wide as its texts

    def _copy(self) -> None:
        """Put the rows that are chosen where a spreadsheet takes them from; with none of them leave what is there."""
        if rows := self.copied():
            QGuiApplication.clipboard().setText(rows)

    def focusInEvent(self, event: QFocusEvent) -> None:  # noqa: N802  # Qt's name
        """Choose a row for whoever comes by the keyboard: Enter and buttons are about what is chosen."""
        super().focusInEvent(event)
        if event.reason() in _BY_KEY and self.rowCount() and not self.chosen:
            self.selectRow(max(self.currentRow(), 0))

    def copied(self) -> str:
        """The rows that are selected, their cells divided by tabs."""
        rows = sorted({index.row() for index in self.selectionModel().selectedRows()})
        texts = self.texts()
        return "\n".join("\t".join(texts[row]) for row in rows)

    def changeEvent(self, event: QEvent) -> None:  # noqa: N802  # Qt's name
        """Keep as many lines in sight with larger text, and take over another palette."""
        super().changeEvent(event)
        if event.type() == QEvent.Type.FontChange:
            self._keep_lines()
        elif event.type() == QEvent.Type.PaletteChange:
            self.colour()

    def _keep_lines(self) -> None:
        self.setMinimumHeight(_LEAST_LINES * self.fontMetrics().height())

    def widen(self, row: int, column: int) -> None:
        """Give a cell all the room to the end of its row."""
        self.setSpan(row, column, 1, self.columnCount() - column)

    def show_whole(self) -> None:
        """Be as high as all rows together."""
        self.resizeRowsToContents()
        rows = sum(self.rowHeight(row) for row in range(self.rowCount()))
        bar = self.horizontalScrollBar().sizeHint().height()
        self.setFixedHeight(self.horizontalHeader().sizeHint().height() + rows + bar + 4)

    @property
    def chosen(self) -> list[int]:
        """Numbers of the rows that are selected, in the order of the table."""
        return sorted({index.row() for index in self.selectionModel().selectedRows()})

    def texts(self) -> list[list[str]]:
        """What the cells say."""
        return [
            [item.text() if (item := self.item(row, column)) else "" for column in range(self.columnCount())]
            for row in range(self.rowCount())
        ]
