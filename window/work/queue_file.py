"""The queue of a store as a file: it outlives the window, and every window of the store has a part in it.

A change is made to the file as it is at that moment, under a lock, so that no window undoes what another did. A window
that carries entries out has a lock of its own for as long as it is open: what belongs to one that is gone was stopped.
Qt's lock files hold on Linux and on Windows, and one whose process has died is taken over.
"""

import json
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from typing import Any, Final, TypeAlias
from uuid import uuid4

from PySide6.QtCore import QLockFile

from tumble.app.exits import JobError
from tumble.app.files import write_text
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.system_errors import reason
from tumble.window.work.run_queue import Entry, RunQueue, Stage

NAME: Final = "queue.json"
_SCHEMA: Final = "tumble.queue/1"
_PATIENCE_MS: Final = 2000
"""How long another window is waited for, which has the file for some milliseconds."""

Stamp: TypeAlias = tuple[int, int, int] | None
"""By which a file is known to be the same; None where there is none."""


class QueueFile:
    """The queue of a store, as this window knows it."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / NAME
        self.owner = uuid4().hex
        """Of the entries that this window carries out."""
        self.queue = RunQueue()
        self._seen: Stamp = None
        self._trouble: InputError | None = None
        """What is still to be told."""
        self._presence = _lock_file(self._presence_of(self.owner))

    def look(self) -> bool:
        """Take over what other windows have changed; returns whether anything is other than it was.

        Raises `InputError` where the file cannot be read; one that is damaged is kept under another name, and what is
        known here is left as it is.
        """
        before = list(self.queue.entries)
        self._take_over()
        trouble, self._trouble = self._trouble, None
        if trouble is not None:
            raise trouble
        return self.queue.entries != before

    def update(self, change: Callable[[RunQueue], object]) -> None:
        """Change the queue as it is now, here and for every window, all or nothing.

        Raises `InputError` or `JobError` where the change cannot be kept; then it holds in this window alone. What was
        wrong with the file before is raised by the next `look`.
        """
        with suppress(OSError):  # whoever writes the file says what is wrong
            self.path.parent.mkdir(parents=True, exist_ok=True)
        lock = QLockFile(str(self.path.with_name(f"{NAME}.lock")))
        if not lock.tryLock(_PATIENCE_MS) and _is_held(lock):
            change(self.queue)
            raise self._in_use(lock)
        try:
            self._take_over()
            change(self.queue)
            self._write()
        finally:
            lock.unlock()

    def claim(self, stand: str) -> Entry | None:
        """Have the entry that waits longest for a stand carried out by this window alone; None where none waits.

        Raises as `update`; another window may begin the entry then, and this one does not.
        """
        claimed: list[Entry | None] = []
        self.be_present()
        try:
            self.update(lambda queue: claimed.append(queue.claim(self.owner, stand)))
        except (InputError, JobError):
            for entry in filter(None, claimed):
                self.queue.change(entry.number, lambda each: each.at(Stage.WAITING))
            raise
        return claimed[-1]

    def be_present(self) -> None:
        """Show other windows that this one is open: what it carries out is left to it."""
        if not self._presence.isLocked():
            self._presence.tryLock(0)

    def leave(self) -> None:
        """Carry nothing out any more."""
        self._presence.unlock()

    def _take_over(self) -> None:
        """Read what is kept, where that is other than it was."""
        stamp = self._stamp()
        if stamp != self._seen:
            self._seen = stamp
            try:
                self.queue.entries = self._read()
            except InputError as error:
                self._trouble = error
        self.queue.settle(self._is_present)

    def _in_use(self, lock: QLockFile) -> InputError:
        return InputError(
            Message(
                "{path}: another window has it in use all the time ({lock}), and it was not changed; close what hangs",
                path=self.path,
                lock=Path(lock.fileName()).name,
            )
        )

    def _read(self) -> list[Entry]:
        """The entries that are kept; none where there is no file. Raises `InputError`."""
        try:
            return _entries(json.loads(self.path.read_text(encoding="utf-8")))
        except FileNotFoundError:
            return []
        except OSError as error:
            raise InputError(
                Message("{path}: cannot be read ({reason})", path=self.path, reason=reason(error))
            ) from error
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
            self._seen = None  # it is moved away, and is not to be taken for an empty queue
            raise _set_aside(self.path) from error

    def _write(self) -> None:
        document = {"schema": _SCHEMA, "entries": [entry.as_json() for entry in self.queue.entries]}
        write_text(self.path, json.dumps(document, indent=1, ensure_ascii=False) + "\n")
        self._seen = self._stamp()

    def _stamp(self) -> Stamp:
        try:
            found = self.path.stat()
        except OSError:
            return None
        return found.st_mtime_ns, found.st_size, found.st_ino

    def _is_present(self, owner: str) -> bool:
        if owner == self.owner:
            return True
        if not owner.isalnum():
            return False
        lock = _lock_file(self._presence_of(owner))
        held = not lock.tryLock(0) and _is_held(lock)
        lock.unlock()
        return held

    def _presence_of(self, owner: str) -> Path:
        return self.path.with_name(f"queue-{owner}.lock")


def _is_held(lock: QLockFile) -> bool:
    """Whether it is another's, where it could not be had; it may be that the folder takes none."""
    return lock.error() is QLockFile.LockError.LockFailedError


def _lock_file(path: Path) -> QLockFile:
    """A lock that is given up by the death of its process alone."""
    lock = QLockFile(str(path))
    lock.setStaleLockTime(0)
    return lock


def _entries(document: dict[str, Any]) -> list[Entry]:
    if document["schema"] != _SCHEMA:
        raise ValueError(document["schema"])
    entries = [Entry.from_json(kept) for kept in document["entries"]]
    if len({entry.number for entry in entries}) < len(entries):
        raise ValueError("two entries have one number")
    return entries


def _set_aside(path: Path) -> InputError:
    numbered = (path.with_name(f"{path.stem}.damaged-{number}{path.suffix}") for number in range(1, 1_000_000))
    aside = next(place for place in numbered if not place.exists())
    try:
        path.rename(aside)
    except OSError as error:
        return InputError(
            Message("{path}: is damaged, and cannot be renamed ({reason})", path=path, reason=reason(error))
        )
    return InputError(
        Message("{path}: is no queue that can be read; it is kept as {aside}", path=path, aside=aside.name)
    )
