"""Asking for a file into which a record is written."""

import re
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import QObject, Signal

from tumble.window.look.language import tr
from tumble.window.widgets.dialog import FileDialog, QuestionDialog

FORMATS: Final = "JSON (*.json);;HTML (*.html);;CSV (*.csv);;PDF (*.pdf)"


class Exporting(QObject):
    """Asks for a file, and once more before one is replaced."""

    wanted = Signal(object)
    """Path."""
    dialog_wanted = Signal(object)
    """`Dialog`."""

    def ask(self, record_id: str, serial_number: str) -> None:
        """Ask into which file a record of a unit is to be written, which is called after both."""
        name = re.sub(r"[^\w.-]+", "-", serial_number).strip("-.")
        dialog = FileDialog(tr("Export"), Path.home() / f"{name}-{record_id}.json", FORMATS, saving=True)
        dialog.chosen.connect(self._write_unless_there)
        self.dialog_wanted.emit(dialog)

    def _write_unless_there(self, path: Path) -> None:
        if not path.exists():
            self.wanted.emit(path)
            return
        title, text = tr("Export"), tr("{path} is there already. Replace it?", path=path)
        question = QuestionDialog(title, text, tr("Replace"))
        question.agreed.connect(partial(self.wanted.emit, path))
        self.dialog_wanted.emit(question)
