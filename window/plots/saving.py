"""Saving plots: which file is asked for by a dialog of the window, wherever the plot is."""

from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Final

from PySide6.QtCore import QEvent, QObject, QSettings
from PySide6.QtWidgets import QWidget

from tumble.app.exits import JobError
from tumble.app.files import replacing
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.window.frame import Frame
from tumble.window.look.language import tr
from tumble.window.plots.picture import save_png, save_svg
from tumble.window.plots.savable import Savable, SaveWanted
from tumble.window.widgets.dialog import FileDialog
from tumble.window.widgets.notice import Notice

FORMATS: Final = "PNG (*.png);;SVG (*.svg);;CSV (*.csv)"
_FOLDER: Final = "plots/folder"


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
        folder = Path(str(QSettings().value(_FOLDER) or Path.home()))
        dialog = FileDialog(tr("Save the plot"), folder / f"{savable.name}.png", FORMATS, saving=True)
        dialog.chosen.connect(partial(self._save, savable))
        self._frame.dialogs.show_dialog(dialog)

    def _save(self, savable: Savable, path: Path) -> None:
        try:
            save(savable, path)
        except (InputError, JobError) as error:
            self._tell(error)
            return
        QSettings().setValue(_FOLDER, str(path.parent))
        self._frame.notices.show_notice(Notice(text=tr("The plot is in {path}.", path=path)))


def save(savable: Savable, path: Path) -> None:
    """Write a plot in the format that the name of a file ends in, over no file that is there already.

    Raises `InputError`, `JobError`.
    """
    match path.suffix.lower():
        case ".png":
            write = partial(save_png, savable.plot)
        case ".svg":
            write = partial(save_svg, savable.plot)
        case ".csv":
            write = partial(_save_csv, savable)
        case suffix:
            raise InputError(
                Message(
                    "{path}: {ending} is no format of a plot; end it in .png, .svg or .csv",
                    path=path,
                    ending=suffix or Message("no ending"),
                )
            )
    with replacing(path, None) as begun:
        write(begun)


def _save_csv(savable: Savable, path: Path) -> None:
    path.write_text(savable.values().as_csv(), encoding="utf-8", newline="\n")
