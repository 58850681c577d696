"""Files that a user asked for."""

from pathlib import Path

from app.exits import Exit, JobError


def write_text(path: Path, text: str) -> None:
    """Write a text file with its folder, UTF-8. Raises `JobError`."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8", newline="\n")
    except OSError as error:
        sentence = f"{path}: cannot be written ({error.strerror}); make room or choose another place"
        raise JobError(sentence, Exit.STORAGE) from error
