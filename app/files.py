"""Files that a user asked for."""

from pathlib import Path

from app.exits import Exit, JobError
from procedures.errors import InputError

RECORDING_SUFFIX = ".mcap"


def is_recording(path: Path) -> bool:
    """Whether a file is a recording, by its name."""
    return path.suffix.lower() == RECORDING_SUFFIX


def refuse_recording(path: Path) -> None:
    """Keep results from being written over raw data. Raises `InputError`."""
    if is_recording(path):
        raise InputError(f"{path}: has the name of a recording, and those are never overwritten; choose another name")


def write_text(path: Path, text: str) -> None:
    """Write a text file with its folder, UTF-8. Raises `JobError`, and `InputError` where it would be a recording."""
    refuse_recording(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        sentence = f"{path}: cannot be written ({error.strerror}); make room or choose another place"
        raise JobError(sentence, Exit.STORAGE) from error
