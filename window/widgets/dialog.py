"""Dialogs that are parts of the window: what a person has to decide. What there is only to tell is a notice.

None is a window of its own and none is modal: STOP is never behind one, and whatever is shown stays usable.
"""

from collections.abc import Callable
from pathlib import Path
from typing import Final

from PySide6.QtCore import QSize, Qt, Signal
from PySide6.QtWidgets import (
    QApplication,
    QFileDialog,
    QFrame,
    QHBoxLayout,
    QLabel,
    QLineEdit,
    QPushButton,
    QScrollArea,
    QVBoxLayout,
    QWidget,
)
from shiboken6 import isValid

from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.widgets.motion_button import MotionButton

YES_KEY: Final = "F3"
"""No scanner types it, and nothing else uses it."""
_MOST: Final = 0.45
"""Of the height of the window."""


class Dialog(QFrame):
    """A title, a text, whatever else is added, and buttons; the last one closes it, and Esc does."""

    dismissed = Signal()

    def __init__(self, title: str, text: str, kind: str = "card", parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setObjectName(kind)
        self.setAccessibleName(title)
        self._before: QWidget | None = None
        """What had the keyboard."""
        self._text = PlainLabel(text)
        self._text.setWordWrap(True)
        self._text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._text.setVisible(bool(text))
        heading = QLabel(title)
        heading.setObjectName("heading")
        self._close = QPushButton(tr("Close  [Esc]"))
        self._close.setFocusPolicy(Qt.FocusPolicy.NoFocus)
        self._close.clicked.connect(self.dismiss)
        self._buttons = QHBoxLayout()
        self._buttons.addWidget(heading, stretch=1)
        self._buttons.addWidget(self._close)
        self._column = QVBoxLayout(self)
        self._column.addLayout(self._buttons)
        self._column.addWidget(self._text)

    def text(self) -> str:
        """What it says."""
        return self._text.text()

    def add(self, part: QWidget) -> None:
        """Put something below what is there."""
        self._column.addWidget(part)

    def add_button(self, button: QPushButton) -> None:
        """Put a button beside the one that closes."""
        self._buttons.insertWidget(self._buttons.count() - 1, button)

    def take_focus(self) -> None:
        """Have the keyboard, where there is anything to type or to choose, and know where it was before."""
        self._before = QApplication.focusWidget()

    def give_back_focus(self) -> None:
        """Have the keyboard go back to where it was, if that is still there."""
        if self._before is not None and isValid(self._before) and self._before.isVisible():
            self._before.setFocus()

    def dismiss(self) -> None:
        """Close it."""
        here = QApplication.focusWidget()
        had_focus = here is not None and self.isAncestorOf(here)
        self.hide()
        if had_focus:
            self.give_back_focus()
        self.deleteLater()
        self.dismissed.emit()


class QuestionDialog(Dialog):
    """Asks; a yes comes by the mouse or by a function key, which no scanner types."""

    agreed = Signal()

    def __init__(self, title: str, text: str, yes: str) -> None:
        super().__init__(title, text, "question")
        self.yes = MotionButton(yes, YES_KEY)
        self.yes.setObjectName("primary")
        self.yes.clicked.connect(self.dismiss)
        self.yes.clicked.connect(self.agreed)
        self.add_button(self.yes)


class FileDialog(Dialog):
    """Asks for a file; it asks nothing further itself, which would be modal."""

    chosen = Signal(object)
    """Path."""

    def __init__(self, title: str, start: Path, filters: str, saving: bool = False) -> None:
        super().__init__(title, "")
        self.files = QFileDialog(self, title, str(start.parent if saving else start), filters)
        for option in ("DontUseNativeDialog", "DontConfirmOverwrite", "ReadOnly"):
            self.files.setOption(QFileDialog.Option[option])
        if saving:
            self.files.setAcceptMode(QFileDialog.AcceptMode.AcceptSave)
            self.files.selectNameFilter(_filter_of(start, filters))
            self.files.selectFile(start.name)
            self.files.filterSelected.connect(self._take_ending)
            self._take_ending(self.files.selectedNameFilter())
        self.files.setFileMode(QFileDialog.FileMode.AnyFile)
        self.files.setWindowFlags(Qt.WindowType.Widget)
        self.files.setModal(False)
        self.files.fileSelected.connect(lambda name: self.chosen.emit(Path(name)))
        self.files.finished.connect(self.give_back_focus)  # it is hidden already, and had the keyboard
        self.files.finished.connect(self.dismiss)
        self.add(self.files)

    def take_focus(self) -> None:
        """Have the name of the file typed."""
        super().take_focus()
        name = self.files.findChild(QLineEdit)
        if name is not None:
            name.setFocus()
            name.selectAll()

    def _take_ending(self, name_filter: str) -> None:
        """Give the name the ending of the format that is chosen, whatever is typed before it."""
        ending = name_filter.rpartition("*.")[2].rstrip(")")
        self.files.setDefaultSuffix(ending)
        if named := self.files.selectedFiles():
            self.files.selectFile(Path(named[0]).with_suffix(f".{ending}").name)


def _filter_of(path: Path, filters: str) -> str:
    """The filter of a file's format; the first where none is of that."""
    each_one = filters.split(";;")
    return next((each for each in each_one if each.endswith(f"*{path.suffix})")), each_one[0])


class Dialogs(QScrollArea):
    """Where the dialog is shown, one at a time, scrolled where it takes more than the `room`, in pixels."""

    def __init__(self, room: Callable[[], int], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._room = room
        self.setFrameShape(QFrame.Shape.NoFrame)
        self.setWidgetResizable(True)
        self._all = QWidget()
        self._column = QVBoxLayout(self._all)
        self._column.setContentsMargins(8, 0, 8, 0)
        self.setWidget(self._all)
        self.hide()

    @property
    def open(self) -> list[Dialog]:
        """Those that are shown, the newest first."""
        there = self._all.findChildren(Dialog, options=Qt.FindChildOption.FindDirectChildrenOnly)
        return sorted((dialog for dialog in there if not dialog.isHidden()), key=self._column.indexOf)

    def show_dialog(self, dialog: Dialog) -> None:
        """Show a dialog in the place of the one that is there, which is so declined: there are never two."""
        for other in self.open:
            other.dismiss()
        self._column.insertWidget(0, dialog)
        dialog.dismissed.connect(self._fit)
        dialog.show()
        dialog.take_focus()
        self._fit()
        self.verticalScrollBar().setValue(0)

    def close_newest(self) -> bool:
        """Close the dialog; false where there is none."""
        shown = self.open
        if shown:
            shown[0].dismiss()
        return bool(shown)

    def minimumSizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """As high as what is shown, up to a part of the window, and no higher than its room."""
        width, needed = max(self.viewport().width(), 200), self._column
        high = needed.heightForWidth(width) if needed.hasHeightForWidth() else needed.sizeHint().height()
        return QSize(0, min(high, round(_MOST * self.window().height()), self._room()))

    def sizeHint(self) -> QSize:  # noqa: N802  # Qt's name
        """No more than that."""
        return self.minimumSizeHint()

    def _fit(self) -> None:
        self.setVisible(bool(self.open))
        self.updateGeometry()
