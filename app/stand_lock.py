"""One stand, one process, and one recording: a second one is refused with the name of the first.

For every address of an instrument, for the stand file and for the recording there is a small file in a folder that all
users of the computer share, see `tumble.app.shared_lock_files`. It is locked by the operating system for as long as the
run lasts, so that a process that dies leaves nothing locked; what is written in it only says who has it.
"""

import json
import os
import socket
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from datetime import UTC, datetime
from hashlib import sha256
from pathlib import Path
from typing import IO, Any

from tumble.app.exits import Exit, JobError
from tumble.app.plain_files import is_still, lock
from tumble.app.shared_lock_files import lock_folder, open_shared
from tumble.app.stand import LoadedStand
from tumble.drivers.links.places import one_name
from tumble.messages import Message

_ATTEMPTS = 100
_LONGEST_WORDS = 2_000


@contextmanager
def holding(loaded: LoadedStand, serial_number: str, check: Callable[[], object] = lambda: None) -> Iterator[None]:
    """Have the stand for oneself. The stand that is built in is everybody's: each process has its own.

    `check` is called while hosts are looked up, and may raise.

    Raises
    ------
    JobError
        Another process has it: which one, on which computer, with which unit, since when.
    """
    with ExitStack() as stack:
        for name, address in sorted(_addresses(loaded, check).items()):
            stack.enter_context(_holding(name, Message("the stand at {address}", address=address), serial_number))
        yield


@contextmanager
def holding_recording(path: Path, serial_number: str) -> Iterator[None]:
    """Have a recording for oneself, on whatever stand it is made. Raises `JobError` as `holding`."""
    with _holding(str(path.resolve()), Message("the recording {path}", path=path), serial_number):
        yield


def _addresses(loaded: LoadedStand, check: Callable[[], object]) -> dict[str, str]:
    """What is held, as it is written, by the one name that it has."""
    file = str(loaded.path.resolve()) if loaded.path else ""
    addresses = [table.address for table in loaded.file.instruments.values()]
    instruments = {one_name(address, check): address for address in addresses}
    return {name: address for name, address in ({file: file} | instruments).items() if address}


@contextmanager
def _holding(place: str, what: str, serial_number: str) -> Iterator[None]:
    path = _folder(what) / f"tumble-{sha256(place.encode('utf-8', 'surrogatepass')).hexdigest()[:32]}.lock"
    with _locked(path, what) as stream:
        with suppress(OSError):  # of another user, on Windows: it says who had it before
            stream.seek(0)
            stream.truncate()
            stream.write(json.dumps(_ourselves(serial_number)).encode())
            stream.flush()
        try:
            yield
        finally:
            with suppress(OSError):  # another user's, or open on Windows; it is then taken over as it is
                path.unlink()


def _folder(what: str) -> Path:
    """Where all users lock. Raises `JobError` where the system refuses it."""
    try:
        return lock_folder()
    except OSError as error:
        where = error.filename or Message("the folder of the locks")
        raise JobError(_taken(where, what, error.strerror or str(error)), Exit.DEVICE_FAULT) from error


@contextmanager
def _locked(path: Path, what: str) -> Iterator[IO[bytes]]:
    for _ in range(_ATTEMPTS):
        try:
            opened = open_shared(path)
        except FileExistsError:
            continue  # somebody was quicker
        except OSError as error:
            raise JobError(_taken(path, what, error.strerror or str(error)), Exit.DEVICE_FAULT) from error
        with opened as stream:
            if not lock(stream):
                raise JobError(_sentence(stream, what), Exit.DEVICE_FAULT)
            if is_still(path, stream):
                yield stream
                return
    raise JobError(
        Message("{path}: others take this lock and give it back all the time; try again", path=path), Exit.DEVICE_FAULT
    )


def _taken(path: Path | str, what: str, reason: str) -> str:
    return Message(
        "{what} cannot be had to oneself: {path}, where all users lock it, cannot be used ({reason}); "
        "make sure that nobody measures there, and have its owner or an administrator take it away",
        what=what,
        path=path,
        reason=reason,
    )


def _ourselves(serial_number: str) -> dict[str, Any]:
    since = datetime.now(tz=UTC).isoformat(timespec="seconds")
    return {"pid": os.getpid(), "host": socket.gethostname(), "serial_number": serial_number, "since": since}


def _sentence(stream: IO[bytes], what: str) -> str:
    try:
        stream.seek(0)
        other = json.loads(stream.read(_LONGEST_WORDS))
        who = Message("process {pid} on {host}, which measures {serial_number} since {since}", **other)
    except (OSError, ValueError, KeyError, TypeError, RecursionError):  # it has only just begun, or is no word of ours
        who = Message("another process")
    return Message("{what} is in use by {who}; wait until it is done, or stop it", what=what, who=who)
