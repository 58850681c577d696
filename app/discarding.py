"""Taking a run that nobody needs out of the way, without losing it."""

from pathlib import Path
from typing import Final

from tumble.app.exits import Exit, JobError
from tumble.app.resuming import files_of
from tumble.app.stand_lock import holding_recording
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.system_errors import reason

FOLDER: Final = "discarded"
"""Of a store; nothing in it is looked at any more."""


def discard(store: Path, recording: Path) -> Path:
    """Move a run with everything that was set aside of it to the folder `discarded`; return where it lies now.

    Raises
    ------
    InputError
        There is no such recording.
    JobError
        Somebody has it open to go on with it, or a file cannot be moved; what was moved before is told.
    """
    files = files_of(recording)
    if not files:
        raise InputError(Message("{path}: there is no such recording", path=recording))
    folder = _free_folder(store / FOLDER / recording.parent.name, recording.stem)
    with holding_recording(recording, recording.parent.name):
        try:
            folder.mkdir(parents=True)
            for path in files:
                path.rename(folder / path.name)
        except OSError as error:
            raise JobError(
                Message(
                    "{path}: cannot be moved to {folder} ({reason})",
                    path=recording,
                    folder=folder,
                    reason=reason(error),
                ),
                Exit.STORAGE,
            ) from error
    return folder


def _free_folder(parent: Path, name: str) -> Path:
    """A folder that is not there yet."""
    number, folder = 1, parent / name
    while folder.exists():
        number += 1
        folder = parent / f"{name}-{number}"
    return folder
