"""The file by which a run is told what is wanted of it: `RUN.control`, beside its recording, while the run lasts.

Whoever wants something writes one line into it, a word of `tumble.app.wishes`; the run heeds it and empties the file.
An empty line only asks whether a run hears.
"""

import errno
import os
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO, Final

from tumble.app.plain_files import FLAGS, alone, is_still, open_plain
from tumble.app.wishes import is_wish
from tumble.messages import Message

SUFFIX: Final = ".control"
_MOST_BYTES: Final = 4096
"""More was written by nobody who wants anything."""
_LOOK_S: Final = 0.05
_BYTE_ORDER_MARKS: Final = (b"\xff\xfe", b"\xef\xbb\xbf")


class ControlFile:
    """The file of a run, by the path of its recording."""

    def __init__(self, recording: Path) -> None:
        self.path = recording.with_suffix(SUFFIX)
        self._unfinished = b""

    def open(self) -> None:
        """Be there, without a wish: one from before the run is of another.

        Raises `OSError`: `FileExistsError` where something else has that name, which is left alone; and where no file
        can be had alone.
        """
        self.close()
        with suppress(FileExistsError):
            os.close(os.open(self.path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | FLAGS, 0o666))
        with self._opened() as stream, alone(stream):
            self._check_is_its_own(stream)
            stream.truncate(0)

    def close(self) -> None:
        """Be gone, unless it has become something else; raises nothing."""
        with suppress(OSError):
            with self._opened() as stream:
                self._check_is_its_own(stream)
            self.path.unlink()

    def taken(self) -> list[str]:
        """The lines that were written since, of too many the last ones.

        A line that is not at its end is one where it stands the same at the next call. Raises `OSError`, as `open`.
        """
        with self._opened() as stream, alone(stream) as undisturbed:
            written = _end_of(stream)
            if not undisturbed or (not written.endswith(b"\n") and written != self._unfinished):
                self._unfinished = written
                return []
            self._unfinished = b""
            if written:
                stream.truncate(0)
        return _lines(written)

    def tell(self, line: str, patience_s: float) -> bool:
        """Write a line, once all before it are taken; returns whether a run takes it within `patience_s` real seconds.

        Raises as `open`.
        """
        deadline_s = time.monotonic() + patience_s
        with self._opened() as stream:
            if not self._comes_true(lambda: _written(stream, line), stream, deadline_s):
                self._check_is_its_own(stream)
                return False
            return self._comes_true(lambda: not _size(stream), stream, deadline_s)

    def _comes_true(self, holds: Callable[[], bool], stream: IO[bytes], deadline_s: float) -> bool:
        """Wait for something of a file until then, or until that is gone."""
        while True:
            over = time.monotonic() > deadline_s or not is_still(self.path, stream)
            if (held := holds()) or over:
                return held
            time.sleep(_LOOK_S)

    @contextmanager
    def _opened(self) -> Iterator[IO[bytes]]:
        """The file, unbuffered. Raises `OSError`."""
        try:
            descriptor = open_plain(self.path)
        except OSError as error:
            if error.errno in (errno.EINVAL, errno.ELOOP, errno.EISDIR, errno.ENXIO):
                raise self._of_somebody_else() from error
            raise
        with os.fdopen(descriptor, "r+b", buffering=0) as stream:
            yield stream

    def _check_is_its_own(self, stream: IO[bytes]) -> None:
        """Make sure that nothing stands in it but wishes. Raises `FileExistsError`."""
        if _size(stream) > _MOST_BYTES or not all(map(is_wish, filter(str.strip, _lines(_end_of(stream))))):
            raise self._of_somebody_else()

    def _of_somebody_else(self) -> FileExistsError:
        return FileExistsError(errno.EEXIST, Message("it is no control file of a run"), str(self.path))


def deaf(file: ControlFile, error: OSError) -> str:
    """Why nothing can be told by a file."""
    why = error.strerror or str(error)
    return Message("{path}: the run cannot be told anything by it ({reason})", path=file.path, reason=why)


def _written(stream: IO[bytes], line: str) -> bool:
    """Write a line where nothing stands, and nobody else writes."""
    with alone(stream) as undisturbed:
        if not undisturbed or _size(stream):
            return False
        stream.seek(0)
        stream.write(f"{line}\n".encode())
    return True


def _size(stream: IO[bytes]) -> int:
    return os.fstat(stream.fileno()).st_size


def _end_of(stream: IO[bytes]) -> bytes:
    """What was written, of too much the end; of UTF-16, as Windows PowerShell redirects it into files, the ASCII."""
    stream.seek(max(_size(stream) - _MOST_BYTES, 0))
    written = stream.read(_MOST_BYTES)
    for mark in _BYTE_ORDER_MARKS:
        written = written.removeprefix(mark)
    return written.replace(b"\0", b"")


def _lines(written: bytes) -> list[str]:
    return written.decode("utf-8", "replace").splitlines()
