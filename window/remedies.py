"""What can be done at once about what went wrong, as an action of its notice."""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from PySide6.QtCore import QUrl
from PySide6.QtGui import QDesktopServices

from tumble.app.files import is_recording
from tumble.app.stand_changes import StandChangedError
from tumble.drivers.errors import DeviceError
from tumble.procedures.errors import InputError
from tumble.window.faults import details_file, files_named, is_known
from tumble.window.look.language import tr
from tumble.window.screens.stand import StandScreen
from tumble.window.widgets.notice import Action


@dataclass(frozen=True, kw_only=True)
class Remedies:
    """What the window can do."""

    is_free: Callable[[], bool]
    """Whether nothing is connected and nothing under way."""
    stand: StandScreen
    resume: Callable[[Path], None]
    """Goes on with the run of a recording."""

    def remedy_of(self, error: BaseException) -> Action | None:
        """What helps against an error; None where that is not known."""
        if not is_known(error):
            return Action(title=tr("Open the details"), act=lambda: open_file(details_file()))
        if isinstance(error, StandChangedError):
            return Action(title=tr("Read it again"), act=lambda: self.stand.open(error.path))
        files = files_named(error)
        recordings = [path for path in files if is_recording(path)]
        others = [path for path in files if path not in recordings]
        begun = next((path for path in recordings if path.stat().st_size), None)
        if begun is not None and not isinstance(error, InputError):  # that would be what going on with it came to
            return Action(title=tr("Go on with it"), act=lambda: self.resume(begun), about=begun)
        if others:
            return Action(title=tr("Open the file"), act=lambda: open_file(others[0]))
        if isinstance(error, DeviceError) and self.is_free():
            return Action(title=tr("Connect again"), act=self.stand.connect_button.click)
        return None


def open_file(path: Path) -> None:
    """Have the desktop open a file."""
    QDesktopServices.openUrl(QUrl.fromLocalFile(str(path)))
