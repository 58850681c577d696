"""The stand file as text: checked while it is written, and saved only where the loader takes it."""

import re
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path
from typing import Final

from PySide6.QtCore import Signal
from PySide6.QtGui import QColor, QTextCursor, QTextFormat
from PySide6.QtWidgets import QHBoxLayout, QPlainTextEdit, QPushButton, QTextEdit, QVBoxLayout, QWidget

from tumble.app.stand import LoadedStand, check_stand_text
from tumble.app.stand_editing import former_name, save_stand
from tumble.procedures.errors import InputError
from tumble.procedures.toml_lines import read_text
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.look.theme import colours
from tumble.window.widgets.dialog import FileDialog, QuestionDialog

_LINE: Final = re.compile(r", line (\d+)")


class StandEditor(QWidget):
    """Text, what is wrong with it, and Save; never while the stand is at work."""

    saved = Signal(object)
    """`LoadedStand`."""
    left = Signal()
    refused = Signal(object)
    """An exception that the person must see."""
    dialog_wanted = Signal(object)
    """`Dialog`."""

    def __init__(
        self, now: Callable[[], datetime] = lambda: datetime.now(tz=UTC), parent: QWidget | None = None
    ) -> None:
        super().__init__(parent)
        self._now, self._path = now, Path()
        self._before: str | None = None
        self.said, self.text = PlainLabel(), QPlainTextEdit()
        self.said.setWordWrap(True)
        self.text.setObjectName("code")
        self.text.setAccessibleName(tr("Stand file"))
        self.save_button = _button(tr("&Save"), self._save)
        self.copy_button = _button(tr("Save &as…"), self._choose_place)
        self.back_button = _button(tr("Bac&k"), self.leave)
        self.text.textChanged.connect(self._check)
        self._lay_out()

    def open(self, path: Path) -> None:
        """Show a stand file. Raises `InputError` where it cannot be read."""
        self._show(path, read_text(path))

    def allow(self, allowed: bool) -> None:
        """Whether the stand is free."""
        self.text.setReadOnly(not allowed)
        self._allow_saving(allowed and self.mistake is None)

    @property
    def mistake(self) -> InputError | None:
        """Why the loader would refuse the text; None where it would not, as far as that is known without its code."""
        try:
            check_stand_text(self.text.toPlainText(), self._path)
        except InputError as error:
            return error
        return None

    def leave(self) -> None:
        """Go back; ask first where something would be lost."""
        if self.text.toPlainText() == self._before:
            self.left.emit()
            return
        text = tr("What was changed in {path} is not saved.", path=self._path.name)
        question = QuestionDialog(tr("Leave the stand file"), text, tr("Leave it unsaved"))
        question.agreed.connect(self.left)
        self.dialog_wanted.emit(question)

    def _show(self, path: Path, text: str) -> None:
        self._path, self._before = path, text
        self.text.setPlainText(text)

    def _check(self) -> None:
        """Say what is wrong, and mark its line."""
        mistake = self.mistake
        said = in_language(str(mistake)) if mistake else tr("✓ This file can be used.")
        self.said.setText(said)
        self.said.setObjectName("bad" if mistake else "good")
        self.said.style().polish(self.said)
        self._mark(_line_of(mistake))
        self._allow_saving(mistake is None and not self.text.isReadOnly())

    def _allow_saving(self, allowed: bool) -> None:
        for button in (self.save_button, self.copy_button):
            button.setEnabled(allowed)

    def _mark(self, line: int | None) -> None:
        if line is None:
            self.text.setExtraSelections([])
            return
        marked = QTextEdit.ExtraSelection()
        cursor = QTextCursor(self.text.document().findBlockByNumber(line - 1))
        marked.cursor = cursor
        ground = QColor(colours(self).bad)
        ground.setAlphaF(0.25)
        marked.format.setBackground(ground)
        marked.format.setProperty(QTextFormat.Property.FullWidthSelection, True)
        self.text.setExtraSelections([marked])

    def _save(self) -> None:
        self._write(self._path, self._before)

    def _write(self, path: Path, before: str | None) -> None:
        text, now = self.text.toPlainText(), datetime.now(tz=UTC)
        try:
            loaded: LoadedStand = save_stand(path, text, before, now)
        except (InputError, OSError) as error:
            self.refused.emit(error)
            return
        self._show(path, text)
        if before is not None:
            self.said.setText(tr("✓ Saved; the former file is {name}.", name=former_name(path, now).name))
        self.saved.emit(loaded)

    def _choose_place(self) -> None:
        dialog = FileDialog(tr("Stand file"), self._path, tr("Stand files (*.toml)"), saving=True)
        dialog.chosen.connect(lambda path: self._write(path, None))
        self.dialog_wanted.emit(dialog)

    def _lay_out(self) -> None:
        buttons = QHBoxLayout()
        buttons.addWidget(self.said, stretch=1)
        for button in (self.save_button, self.copy_button, self.back_button):
            buttons.addWidget(button)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addLayout(buttons)
        column.addWidget(self.text, stretch=1)


def _button(text: str, do: Callable[[], None]) -> QPushButton:
    button = QPushButton(text)
    button.clicked.connect(lambda _checked: do())
    return button


def _line_of(mistake: InputError | None) -> int | None:
    """The line that a refusal names, counted from 1; None where it names none."""
    found = _LINE.search(str(mistake)) if mistake else None
    return int(found[1]) if found else None
