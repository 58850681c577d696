"""What went wrong, as a dialog: one sentence, and where the details are."""

import traceback
from datetime import UTC, datetime
from pathlib import Path

from tumble.app.exits import status_of
from tumble.drivers.private_files import state_folder
from tumble.window.look.language import tr
from tumble.window.look.plain import PlainLabel
from tumble.window.look.sentences import in_language
from tumble.window.widgets.dialog import Dialog


class ProblemDialog(Dialog):
    """One sentence in red, and for a fault of the program where the details are."""

    def __init__(self, error: BaseException) -> None:
        known = isinstance(error, Exception) and status_of(error) is not None
        text = tr("A fault of the program; the head was told to stop.")
        title = tr("Something went wrong")
        super().__init__(title, in_language(str(error)) if known else text, "fault")
        self._details = PlainLabel()
        self._details.setWordWrap(True)
        if not known:
            said, place = f"{type(error).__name__}: {error}", keep_details(error)
            self._details.setText(tr("{error}\nThe details are in {place}.", error=said, place=place))
            self.add(self._details)

    def informativeText(self) -> str:  # noqa: N802  # as Qt's dialogs have it
        """What is known of a fault of the program."""
        return self._details.text()

    def accept(self) -> None:
        """Close it."""
        self.dismiss()


def keep_details(error: BaseException) -> Path:
    """Add an exception with its traceback to the file of the window's faults."""
    try:
        path = state_folder() / "window-faults.log"
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8") as file:
            file.write(f"{datetime.now(tz=UTC).isoformat(timespec='seconds')}\n{_details(error)}\n")
    except (OSError, RuntimeError):  # of a user without a home
        return Path("-")
    return path


def _details(error: BaseException) -> str:
    return "".join(traceback.format_exception(error))
