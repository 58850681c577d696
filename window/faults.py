"""Faults as notices: one sentence, where the details are, and which files they name."""

import traceback
from collections.abc import Iterator
from datetime import UTC, datetime
from pathlib import Path

from tumble.app.exits import sentence_of, status_of
from tumble.drivers.private_files import state_folder
from tumble.messages import Message
from tumble.window.look.language import tr
from tumble.window.look.sentences import in_language
from tumble.window.widgets.notice import Action, Kind, Notice


def is_known(error: BaseException) -> bool:
    """Whether a person can do something about it; anything else is a fault of the program."""
    return isinstance(error, Exception) and status_of(error) is not None


def fault_notice(error: BaseException, action: Action | None) -> Notice:
    """What went wrong; of a fault of the program that, and in which file the details are."""
    if isinstance(error, Exception) and status_of(error) is not None:
        return Notice(text=in_language(sentence_of(error)), kind=Kind.FAULT, action=action)
    said, place = f"{type(error).__name__}: {error}", keep_details(error)
    return Notice(
        text=tr("A fault of the program; the head was told to stop."),
        kind=Kind.FAULT,
        details=tr("{error}\nThe details are in {place}.", error=said, place=place),
        action=action,
    )


def details_file() -> Path:
    """The file of the window's faults. Raises `RuntimeError` for a user without a home."""
    return state_folder() / "window-faults.log"


def keep_details(error: BaseException) -> Path:
    """Add an exception with its traceback to the file of the window's faults."""
    try:
        path = details_file()
        path.parent.mkdir(parents=True, exist_ok=True)
        with path.open("a", encoding="utf-8") as file:
            file.write(f"{datetime.now(tz=UTC).isoformat(timespec='seconds')}\n{_details(error)}\n")
    except (OSError, RuntimeError):  # of a user without a home
        return Path("-")
    return path


def files_named(error: BaseException) -> list[Path]:
    """Files that a sentence names and that are there, the first named first."""
    return [path for path in _paths(str(error)) if _is_there(path)]


def _paths(told: object) -> Iterator[Path]:
    """Paths in the fields of a message, however deep."""
    if isinstance(told, Message):
        for value in told.fields.values():
            yield from _paths(value)
    elif isinstance(told, Path | str):
        yield Path(told)


def _is_there(path: Path) -> bool:
    """Whether a file is where a path leads; words that are none lead nowhere."""
    try:
        return path.is_absolute() and path.is_file()
    except OSError:  # too long for a name
        return False


def _details(error: BaseException) -> str:
    return "".join(traceback.format_exception(error))
