"""What went wrong, as a dialog: one sentence, and where the details are."""

import traceback
from datetime import UTC, datetime
from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtWidgets import QMessageBox, QWidget

from app.exits import status_of
from drivers.private_files import state_folder
from window.look.sentences import in_language


class ProblemDialog(QMessageBox):
    """Does not block: the window lives on behind it, and so does STOP."""

    def __init__(self, error: BaseException, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(self.tr("Something went wrong"))
        self.setTextFormat(Qt.TextFormat.PlainText)
        known = isinstance(error, Exception) and status_of(error) is not None
        if known:
            self.setIcon(QMessageBox.Icon.Warning)
            self.setText(in_language(str(error)))
        else:
            self.setIcon(QMessageBox.Icon.Critical)
            self.setText(self.tr("A fault of the program; the head was brought to rest."))
            place = keep_details(error)
            told = self.tr("{error}\nThe details are in {place}.")
            self.setInformativeText(told.format(error=f"{type(error).__name__}: {error}", place=place))
            self.setDetailedText(_details(error))


def keep_details(error: BaseException) -> Path:
    """Add an exception with its traceback to the file of the window's faults."""
    path = state_folder() / "window-faults.log"
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8") as file:
            file.write(f"{datetime.now(tz=UTC).isoformat(timespec='seconds')}\n{_details(error)}\n")
    except OSError:
        return Path("-")
    return path


def _details(error: BaseException) -> str:
    return "".join(traceback.format_exception(error))
