"""Files that a user asked for: the one way in which a result reaches the disk.

A result is written beside its place and put there at once when it is whole: a full disk leaves what was there before.
It takes the place of an earlier result of the same kind only, and of nothing else: not of an input of the command, a
table, a store, a recording, a programme or a stand file, by whatever name or link it is called.
"""

import os
import secrets
import stat
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from tumble.app.exits import Exit, JobError, status_of
from tumble.app.kinds import BEGINNING_BYTES, Kind, kind_of, kind_of_file
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.procedures.recording.file import synchronise_folder

RECORDING_SUFFIX = ".mcap"
_STORE_SUFFIX = ".sqlite"


def is_recording(path: Path) -> bool:
    """Whether a file is a recording, by its name."""
    return path.suffix.lower() == RECORDING_SUFFIX


def check_recording_name(path: Path) -> None:
    """Make sure that a name is one of a recording. Raises `InputError`."""
    if not is_recording(path):
        raise InputError(
            Message("{path}: is no name of a recording; end it in {suffix}", path=path, suffix=RECORDING_SUFFIX)
        )


def check_result(path: Path, kind: Kind | None) -> None:
    """Find out whether a result of a kind may be written, before anything is done for it.

    Raises
    ------
    InputError
        It has the name of a recording or a store, or something else than an earlier result of its kind is there.
    JobError
        The place is write-protected, or cannot be looked at.
    """
    _refuse_names_of_raw_data(path)
    with _storage(path):
        place = _place(path)
        with suppress(FileNotFoundError):
            _check_earlier(path, place, place.stat(), kind)
        _check_folder(path, place.parent)


@contextmanager
def replacing(path: Path, kind: Kind | None) -> Iterator[Path]:
    """Give a place to write a result to, and put it where it belongs when it is whole.

    Raises
    ------
    InputError, JobError
        As `check_result`; `JobError` too where it cannot be written. What was there stays as it was.
    """
    check_result(path, kind)
    with _storage(path):
        place = _place(path)
        begun = place.with_name(f".tumble-{secrets.token_hex(8)}.tmp")
        place.parent.mkdir(parents=True, exist_ok=True)
    try:
        with _storage(path):
            begun.touch(exist_ok=False)
        with _storage(path, of=begun):
            yield begun
        with _storage(path):
            _put_in_place(begun, place)
    finally:
        with suppress(OSError):
            begun.unlink(missing_ok=True)


def write_text(path: Path, text: str) -> None:
    """Write a text file with its folder, UTF-8. Raises as `replacing`."""
    with replacing(path, kind_of(text[:BEGINNING_BYTES].encode())) as begun:
        begun.write_text(text, encoding="utf-8", newline="\n")


def write_new(path: Path, text: str) -> None:
    """The same for a file that must not be there yet.

    Raises
    ------
    InputError
        It is there.
    JobError
        It cannot be written; then there is none.
    """
    check_result(path, None)
    with _storage(path):
        path.parent.mkdir(parents=True, exist_ok=True)
        try:
            path.touch(exist_ok=False)
        except FileExistsError as error:
            raise InputError(
                Message("{path}: is there already, and is not written over; choose another name", path=path)
            ) from error
    try:
        write_text(path, text)
    except BaseException:
        path.unlink(missing_ok=True)
        raise


def _check_earlier(path: Path, place: Path, there: os.stat_result, kind: Kind | None) -> None:
    """Refuse to write over what is there, but for an earlier result of the same kind, or nothing at all in a file."""
    if not stat.S_ISREG(there.st_mode):
        raise InputError(Message("{path}: is no file but a folder or a device; name a file to be written", path=path))
    if there.st_size and (kind is None or kind_of_file(place) is not kind):
        written = Message("a {kind}", kind=kind.words) if kind else Message("this")
        raise InputError(
            Message(
                "{path}: is there already and is no earlier result of the same kind, and {written} is written "
                "over nothing else; choose another name, or move the file away",
                path=path,
                written=written,
            )
        )
    if not there.st_mode & 0o222 or not os.access(place, os.W_OK):
        raise JobError(Message("{path}: is write-protected; choose another name", path=path), Exit.STORAGE)


def _refuse_names_of_raw_data(path: Path) -> None:
    if is_recording(path):
        raise InputError(
            Message(
                "{path}: has the name of a recording, and those are never overwritten; choose another name", path=path
            )
        )
    if path.suffix.lower().startswith(_STORE_SUFFIX):  # SQLite's own files beside it too: .sqlite-wal
        raise InputError(
            Message("{path}: has the name of a store, and those are never overwritten; choose another name", path=path)
        )


def _place(path: Path) -> Path:
    """Where a file lies, links followed: what is written takes the place of the file, not of the link."""
    try:
        return path.resolve()
    except RuntimeError as error:
        raise OSError(0, Message("links that lead in a circle")) from error


def _check_folder(path: Path, folder: Path) -> None:
    """See whether a file can be made in a folder, or in the nearest above it that is there."""
    while not folder.exists() and folder != folder.parent:
        folder = folder.parent
    if not folder.is_dir():
        raise NotADirectoryError(0, Message("{folder} is no folder", folder=folder))
    if not os.access(folder, os.W_OK):
        raise JobError(
            Message(
                "{path}: cannot be written ({folder} is write-protected); choose another place",
                path=path,
                folder=folder,
            ),
            Exit.STORAGE,
        )


def _put_in_place(begun: Path, place: Path) -> None:
    with begun.open("r+b") as file:
        os.fsync(file.fileno())
    if place.exists():
        begun.chmod(stat.S_IMODE(place.stat().st_mode))
    os.replace(begun, place)  # noqa: PTH105  # the same; named as the systems' manuals do
    synchronise_folder(place.parent)


@contextmanager
def _storage(path: Path, of: Path | None = None) -> Iterator[None]:
    """Say in a sentence what the disk refuses; with `of`, only what it refuses of that file or for want of room."""
    try:
        yield
    except OSError as error:
        if of is not None and error.filename != str(of) and (error.filename or status_of(error) is not Exit.STORAGE):
            raise
        first = (
            Message("close whatever has it open, see to its rights")
            if isinstance(error, PermissionError)
            else Message("make room")
        )
        sentence = Message(
            "{path}: cannot be written ({reason}); {remedy} or choose another place",
            path=path,
            reason=error.strerror or error,
            remedy=first,
        )
        raise JobError(sentence, Exit.STORAGE) from error
