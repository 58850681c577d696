"""The programmes that can be chosen, each with what it takes and what it is for."""

from collections.abc import Callable
from functools import cache, partial
from typing import Final, TypeAlias

from PySide6.QtCore import QModelIndex, QPersistentModelIndex, QRect, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter
from PySide6.QtWidgets import QComboBox, QStyle, QStyledItemDelegate, QStyleOptionViewItem, QWidget

from tumble.window.look.theme import colours
from tumble.window.work.background import Background

_Index: TypeAlias = QModelIndex | QPersistentModelIndex
_MARGIN_PX: Final = 4
_WIDE: Final = 44
"""Width of the list in heights of a line, where the screen has so much."""
_WRAPPED: Final = Qt.TextFlag.TextWordWrap


class ProgrammeBox(QComboBox):
    """In its list what a programme `takes` stands beside its name, and below what it is `about`.

    Both are asked by what an item has as its data, once, when the list shows it for the first time. The first, for
    which a programme and its stand are loaded, is asked in the background: it is there a moment later.
    """

    def __init__(
        self,
        takes: Callable[[str], str],
        about: Callable[[str], str],
        background: Background,
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self._takes, self._about, self._background = takes, about, background
        self.setItemDelegate(_Described(self))
        self.setStyleSheet("QComboBox { combobox-popup: 0; }")  # a list beside the box, and none over the whole screen
        self.forget()

    def takes(self, name: str) -> str:
        """What a programme takes; empty until that is known."""
        if name not in self._taken:
            self._taken[name] = ""
            self._background.start(partial(self._takes, name), partial(self._hear, self._taken, name))
        return self._taken[name]

    def forget(self) -> None:
        """Ask anew, since the stand is another one, or a file says something else."""
        self._taken: dict[str, str] = {}
        self.about = cache(self._about)

    def room_px(self) -> int:
        """Width of the list."""
        return max(self.width(), min(_WIDE * self.fontMetrics().height(), self.screen().availableGeometry().width()))

    def showPopup(self) -> None:  # noqa: N802  # Qt's name
        """Give the list its width, however narrow the box is."""
        self.view().setMinimumWidth(self.room_px())
        super().showPopup()

    def _hear(self, asked: dict[str, str], name: str, taken: str) -> None:
        """Show an answer; one about a stand that was forgotten since goes where nobody looks."""
        asked[name] = taken
        self.view().viewport().update()


class _Described(QStyledItemDelegate):
    """Draws the rows of the list."""

    def __init__(self, box: ProgrammeBox) -> None:
        super().__init__(box)
        self._box = box

    def sizeHint(self, option: QStyleOptionViewItem, index: _Index) -> QSize:  # noqa: N802  # Qt's name
        """As high as everything that is said."""
        bar = self._box.style().pixelMetric(QStyle.PixelMetric.PM_ScrollBarExtent)
        width = self._box.room_px() - bar - 4 * _MARGIN_PX
        metrics = QFontMetrics(option.font)
        said = metrics.boundingRect(QRect(0, 0, width, 0), _WRAPPED, self._box.about(_name(index)))
        return QSize(width, metrics.height() + said.height() + 2 * _MARGIN_PX)

    def paint(self, painter: QPainter, option: QStyleOptionViewItem, index: _Index) -> None:
        """Draw the ground, the name in bold, beside it and below it in a paler ink what is said of it."""
        filled = QStyleOptionViewItem(option)
        self.initStyleOption(filled, index)
        title, filled.text = filled.text, ""
        filled.widget.style().drawControl(QStyle.ControlElement.CE_ItemViewItem, filled, painter, filled.widget)
        chosen, look = bool(filled.state & QStyle.StateFlag.State_Selected), colours(self._box)
        ink, pale = (look.highlighted, look.highlighted) if chosen else (look.ink, look.pale)
        inside = filled.rect.adjusted(_MARGIN_PX, _MARGIN_PX, -_MARGIN_PX, -_MARGIN_PX)
        name = _name(index)
        takes = self._box.takes(name)
        painter.save()
        _write(painter, inside, title_beside(takes, title, filled.font, inside.width()), ink, bold=True)
        _write(painter, inside, takes, pale, Qt.AlignmentFlag.AlignRight)
        _write(painter, inside.adjusted(0, filled.fontMetrics.height(), 0, 0), self._box.about(name), pale)
        painter.restore()


def title_beside(takes: str, title: str, font: QFont, room_px: int) -> str:
    """As much of both ends of a title as stands in bold beside what a programme takes, on one line of so much room."""
    left_px = room_px - QFontMetrics(font).horizontalAdvance(f"{takes}  ")
    bold = QFont(font)
    bold.setBold(True)
    return QFontMetrics(bold).elidedText(title, Qt.TextElideMode.ElideMiddle, left_px)


def _write(
    painter: QPainter,
    place: QRect,
    text: str,
    ink: str,
    side: Qt.AlignmentFlag = Qt.AlignmentFlag.AlignLeft,
    *,
    bold: bool = False,
) -> None:
    font = painter.font()
    font.setBold(bold)
    painter.setFont(font)
    painter.setPen(QColor(ink))
    painter.drawText(place, side | _WRAPPED, text)


def _name(index: _Index) -> str:
    return str(index.data(Qt.ItemDataRole.UserRole))
