"""The file of a recording while it is written: on the disk when that is asked for, and put back where it is removed."""

import os
import shutil
import sys
from contextlib import suppress
from pathlib import Path
from typing import Final

from tumble.messages import Message
from tumble.procedures.recording.errors import RecordingError

_KEPT: Final = "kept"


class JournalFile:
    """A new file, as the MCAP writer wants its stream.

    A file that is open can be removed, or its folder, on every system but Windows: it then lives on without a name, and
    is gone when it is closed. `make_durable` notices that and writes it anew under its name. It can be cut shorter,
    too; what was cut off is lost, and nothing is written behind the gap: the file is closed with what is left.

    Parameters
    ----------
    path
        File to create.

    Raises
    ------
    FileExistsError
        There is one already.
    OSError
        From everything here: the disk fails.
    RecordingError
        From `write` and `make_durable`: another program has cut the file.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._stream = path.open("x+b")
        self._durable = 0
        """Bytes that were on the disk once."""

    @property
    def closed(self) -> bool:
        """Whether nothing can be written any more."""
        return self._stream.closed

    def write(self, data: bytes) -> int:
        """Append."""
        self._check_size()
        return self._stream.write(data)

    def tell(self) -> int:
        """Size so far."""
        return self._stream.tell()

    def flush(self) -> None:
        """Hand everything to the system."""
        self._stream.flush()

    def close(self) -> None:
        """Close it; a second call does nothing."""
        self._stream.close()

    def make_durable(self) -> bool:
        """Have everything on the disk under the file's name; true where it had to be put back there.

        Raises `RecordingError` where the file was cut, or where another file has that name by now; what was written is
        then kept beside it.
        """
        self._stream.flush()
        os.fsync(self._stream.fileno())
        self._check_size()
        self._durable = self._stream.tell()
        if self._is_there():
            return False
        self._put_back()
        return True

    def _check_size(self) -> None:
        size = os.fstat(self._stream.fileno()).st_size
        if size < self._durable:
            self._stream.close()
            raise RecordingError(
                self.path,
                Message.counted(
                    "was cut from {durable} to {count} byte by another program while it was written",
                    "was cut from {durable} to {count} bytes by another program while it was written",
                    durable=self._durable,
                    count=size,
                ),
                Message("keep other programs from it"),
            )

    def _is_there(self) -> bool:
        try:
            return os.path.samestat(self.path.stat(), os.fstat(self._stream.fileno()))
        except FileNotFoundError:
            return False

    def _put_back(self) -> None:
        path = self.path
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            self._go_on_in(path)
        except FileExistsError as error:
            kept = path.with_name(f"{path.stem}.{_KEPT}-{os.getpid()}{path.suffix}")
            self._go_on_in(kept)
            raise RecordingError(
                path,
                Message(
                    "was replaced by another file while it was written, and is kept in {kept_name}", kept_name=kept.name
                ),
                Message("give it its name back, then resume the run"),
            ) from error

    def _go_on_in(self, path: Path) -> None:
        """Copy everything into a new file and have what follows written there."""
        named = path.open("x+b")
        self._stream.seek(0)
        shutil.copyfileobj(self._stream, named)
        named.flush()
        os.fsync(named.fileno())
        self._stream.close()
        self.path, self._stream = path, named
        synchronise_folder(path.parent)


def synchronise_folder(folder: Path) -> None:
    """Put a new file's name on the disk, where the system has a way to (fsync(2), POSIX)."""
    if sys.platform == "win32":
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        with suppress(OSError):  # some network file systems cannot do it for a folder
            os.fsync(descriptor)
    finally:
        os.close(descriptor)
