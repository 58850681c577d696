"""The file by which a run is told what is wanted of it: `RUN.control`, beside its recording, while the run lasts.

Whoever wants something writes one line into it, a word of `tumble.app.wishes`; the run heeds it and empties the file.
"""

import errno
import time
from contextlib import suppress
from pathlib import Path
from typing import Final

from tumble.app.wishes import is_wish
from tumble.messages import Message

SUFFIX: Final = ".control"
_MOST_BYTES: Final = 4096
"""More was written by nobody who wants anything."""
_LOOK_S: Final = 0.05


class ControlFile:
    """The file of a run, by the path of its recording."""

    def __init__(self, recording: Path) -> None:
        self.path = recording.with_suffix(SUFFIX)

    def open(self) -> None:
        """Be there, without a wish: one from before the run is of another.

        Raises `OSError`: `FileExistsError` where something else has that name, which is left alone.
        """
        with suppress(FileNotFoundError):
            self._check_is_its_own()
        self.path.write_bytes(b"")

    def close(self) -> None:
        """Be gone, unless it has become something else; raises nothing."""
        with suppress(OSError):
            self._check_is_its_own()
            self.path.unlink()

    def taken(self) -> list[str]:
        """The lines that were written since; a line that is not at its end yet is left. Raises `OSError`."""
        with self.path.open("r+b") as stream:
            text = stream.read(_MOST_BYTES)
            if not text.endswith(b"\n") and len(text) < _MOST_BYTES:
                return []
            stream.truncate(0)
        return text.decode("utf-8", "replace").splitlines()

    def tell(self, line: str, patience_s: float) -> bool:
        """Write a line; returns whether a run has taken it within `patience_s` real seconds. Raises as `open`."""
        self._check_is_its_own()
        with self.path.open("r+b") as stream:
            stream.seek(0, 2)
            stream.write(f"{line}\n".encode())
        deadline_s = time.monotonic() + patience_s
        while self._waits():
            if time.monotonic() > deadline_s:
                return False
            time.sleep(_LOOK_S)
        return True

    def _check_is_its_own(self) -> None:
        """Make sure that nothing stands in it but wishes. Raises `OSError`."""
        with self.path.open("rb") as stream:
            text = stream.read(_MOST_BYTES + 1)
        if len(text) > _MOST_BYTES or not all(map(is_wish, text.decode("utf-8", "replace").splitlines())):
            raise FileExistsError(errno.EEXIST, Message("it is no control file of a run"), str(self.path))

    def _waits(self) -> bool:
        """Whether something stands in it; what is gone was taken with it."""
        try:
            return self.path.stat().st_size > 0
        except FileNotFoundError:
            return False
