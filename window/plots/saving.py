"""Saving plots: which file is asked for by a dialog of the window, wherever the plot is."""

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Final, TypeAlias

from PySide6.QtCore import QEvent, QObject, QSettings
from PySide6.QtWidgets import QWidget

from tumble.app.exits import JobError
from tumble.app.files import replacing
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.window.frame import Frame
from tumble.window.kept import kept_text
from tumble.window.look.language import tr
from tumble.window.plots.picture import drawn
from tumble.window.plots.savable import Savable, SaveWanted
from tumble.window.widgets.dialog import FileDialog
from tumble.window.widgets.notice import Notice

FORMATS: Final = "PNG (*.png);;SVG (*.svg);;CSV (*.csv)"
_FOLDER: Final = "plots/folder"

Formats: TypeAlias = Mapping[str, bytes]
"""What the file of a plot holds, by the ending of its name."""


class SavingPlots(QObject):
    """Asks for the file of each plot in a window that is to be saved, and writes it in the format of its name.

    Parameters
    ----------
    window
        Of the plots.
    frame
        Where dialogs and notices are shown.
    tell
        Shows an error.
    """

    def __init__(self, window: QWidget, frame: Frame, tell: Callable[[BaseException], None]) -> None:
        super().__init__(window)
        self._frame, self._tell = frame, tell
        window.installEventFilter(self)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:  # noqa: N802  # Qt's name
        """Hear of plots that are to be saved."""
        if isinstance(event, SaveWanted):
            self._ask(event.savable)
            return True
        return super().eventFilter(watched, event)

    def _ask(self, savable: Savable) -> None:
        folder = Path(kept_text(_FOLDER) or Path.home())
        dialog = FileDialog(tr("Save the plot"), folder / f"{savable.name}.png", FORMATS, saving=True)
        dialog.chosen.connect(partial(self._save, contents(savable)))
        self._frame.dialogs.show_dialog(dialog)

    def _save(self, formats: Formats, path: Path) -> None:
        try:
            save(formats, path)
        except (InputError, JobError) as error:
            self._tell(error)
            return
        QSettings().setValue(_FOLDER, str(path.parent))
        self._frame.notices.show_notice(Notice(text=tr("The plot is in {path}.", path=path)))


def contents(savable: Savable) -> Formats:
    """What a file of a plot would hold now, in each format; the plot may go before one is chosen."""
    picture = drawn(savable.plot)
    return {".png": picture.png, ".svg": picture.svg, ".csv": savable.values().as_csv().encode()}


def save(formats: Formats, path: Path) -> None:
    """Write a plot in the format that the name of a file ends in, over no file that is there already.

    Raises `InputError`, `JobError`.
    """
    suffix = path.suffix.lower()
    if suffix not in formats:
        raise InputError(
            Message(
                "{path}: {ending} is no format of a plot; end it in .png, .svg or .csv",
                path=path,
                ending=suffix or Message("no ending"),
            )
        )
    with replacing(path, None) as begun:
        begun.write_bytes(formats[suffix])
