"""The raw file of a record: where it lies and what its hash is."""

import hashlib
from pathlib import Path


def file_sha256(path: Path) -> str:
    """SHA-256 of a file, in hexadecimal digits. Raises `OSError` where it cannot be read."""
    with path.open("rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()


def stored_path(folder: Path, path: Path) -> str:
    """Path of a raw file as records hold it.

    Relative to the folder of the store, with `/`, where the file lies inside, so that the folder can be moved; absolute
    elsewhere.
    """
    folder, path = folder.resolve(), path.resolve()
    return path.relative_to(folder).as_posix() if path.is_relative_to(folder) else str(path)


def resolved_path(folder: Path, stored: str) -> Path:
    """Undo `stored_path`."""
    return folder / stored
