"""Asking for a file into which a record is written."""

import re
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import QObject, QSettings, Signal

from tumble.window.kept import kept_text
from tumble.window.look.language import tr
from tumble.window.widgets.dialog import FileDialog, QuestionDialog

FORMATS: Final = "PDF (*.pdf);;HTML (*.html);;JSON (*.json);;CSV (*.csv)"
_LAST: Final = "records/export"
"""The file into which a record was written last: the next one goes beside it, in the same format."""


class Exporting(QObject):
    """Asks for a file, beside the last one and in its format, and once more before one is replaced."""

    wanted = Signal(object)
    """Path."""
    dialog_wanted = Signal(object)
    """`Dialog`."""

    def ask(self, record_id: str, serial_number: str) -> None:
        """Ask into which file a record of a unit is to be written, which is called after both."""
        name = re.sub(r"[^\w.-]+", "-", serial_number).strip("-.")
        last = Path(kept_text(_LAST, str(Path.home() / "record.pdf")))
        folder = last.parent if last.parent.is_dir() else Path.home()
        dialog = FileDialog(tr("Export"), folder / f"{name}-{record_id}{last.suffix}", FORMATS, saving=True)
        dialog.chosen.connect(self._write_unless_there)
        self.dialog_wanted.emit(dialog)

    def _write_unless_there(self, path: Path) -> None:
        if not path.exists():
            self._write(path)
            return
        title, text = tr("Export"), tr("{path} is there already. Replace it?", path=path)
        question = QuestionDialog(title, text, tr("Replace"))
        question.agreed.connect(partial(self._write, path))
        self.dialog_wanted.emit(question)

    def _write(self, path: Path) -> None:
        if f"(*{path.suffix.lower()})" in FORMATS:
            QSettings().setValue(_LAST, str(path))
        self.wanted.emit(path)
