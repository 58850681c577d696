"""The queue of a store as a file: it outlives the window, and every window of the store has a part in it.

A change is made to the file as it is at that moment, under a lock, so that no window undoes what another did. What
cannot be written at once, because the file is in use or cannot be read, holds here meanwhile and is written as soon as
that can be. A window that carries entries out shows that it is there; what belongs to one that is gone was stopped.
"""

import json
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from time import monotonic, sleep
from typing import Any, Final, TypeAlias
from uuid import uuid4

from PySide6.QtCore import QLockFile

from tumble.app.exits import JobError
from tumble.app.files import write_text
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.system_errors import reason
from tumble.window.work.presence import Presence, is_held
from tumble.window.work.run_queue import Entry, RunQueue

NAME: Final = "queue.json"
_SCHEMA: Final = "tumble.queue/2"
_READ: Final = ("tumble.queue/1", _SCHEMA)
_CHANGE_S: Final = 0.1
"""How long a change waits for another window, which has the file for some milliseconds; the person waits as long."""
_CLAIM_S: Final = 0.5
"""The same where nothing is under way here."""
_PAUSE_S: Final = 0.005
_PATIENCE_S: Final = 2.0
"""What is in the way for so long is told."""

Stamp: TypeAlias = tuple[int, int, int] | None
"""By which a file is known to be the same; None where there is none."""
Change: TypeAlias = Callable[[RunQueue], object]


class _NotNow(InputError):  # noqa: N818  # no error unless it lasts
    """The file is in use, or cannot be read; it may be otherwise in a moment."""


class _Damaged(Exception):  # noqa: N818  # never leaves this module
    """What is in the file is no queue."""


class QueueFile:
    """The queue of a store, as this window knows it."""

    def __init__(self, folder: Path) -> None:
        self.path = folder / NAME
        self.owner = uuid4().hex
        """Of the entries that this window carries out."""
        self.queue = RunQueue()
        """What is kept, with what is still to be written."""
        self._presence = Presence(folder, self.owner)
        self._kept: list[Entry] = []
        self._unsaved: list[Change] = []
        self._seen: Stamp = None
        self._set_aside: InputError | None = None
        """What is still to be told of a damaged file."""
        self._hindered: float | None = None
        """Since when something is in the way; None where nothing is."""
        self._told = ""

    def look(self) -> bool:
        """Take over what other windows have changed, and write what could not be; whether anything is new.

        Raises `InputError` or `JobError`, once, where the file cannot be had for a while or not be written; one that is
        damaged is kept under another name, and what is known here is left as it is.
        """
        self._presence.refresh()
        before = list(self.queue.entries)
        trouble = self._trouble()
        told, self._told = self._told, str(trouble or "")
        if trouble is not None and self._told != told:
            raise trouble
        return self.queue.entries != before

    def update(self, change: Change) -> None:
        """Change the queue as it is now, here at once and for every window as soon as the file can be had.

        Raises `InputError` or `JobError` where the change cannot be written; the next `look` tries again.
        """
        patience_s = 0.0 if self._unsaved else _CHANGE_S
        self._unsaved.append(change)
        self._rebuild()
        with suppress(_NotNow):
            self._save(patience_s)

    def claim(self, stand: str) -> Entry | None:
        """Have the entry that waits longest for a stand carried out by this window alone; None where none waits.

        Raises `InputError` or `JobError` where that cannot be written now; this window does not begin the entry then.
        """
        claimed: list[Entry | None] = []
        self.be_present()
        self._unsaved.append(lambda queue: claimed.append(queue.claim(self.owner, stand)))
        try:
            self._save(_CLAIM_S)
        except (InputError, JobError):
            self._unsaved.pop()
            self._rebuild()
            raise
        return claimed[-1]

    def be_present(self) -> None:
        """Show other windows that this one is open: what it carries out is left to it."""
        self._presence.show()

    def sweep(self) -> None:
        """Remove what windows left that died."""
        self._presence.sweep()

    def leave(self) -> None:
        """Write what could not be, and carry nothing out any more."""
        if self._unsaved:
            with suppress(InputError, JobError):
                self._save(_CLAIM_S)
        self._presence.leave()

    def _trouble(self) -> Exception | None:
        """Look, and say what is to be told of it."""
        try:
            self._refresh()
        except _NotNow as error:
            self._hindered = monotonic() if self._hindered is None else self._hindered
            return error if monotonic() - self._hindered >= _PATIENCE_S else None
        except (InputError, JobError) as error:
            return error
        self._hindered = None
        aside, self._set_aside = self._set_aside, None
        return aside

    def _refresh(self) -> None:
        if self._unsaved:
            self._save(0.0)
            return
        try:
            self._take_over()
        except _Damaged:
            with self._locked():  # another window may be replacing it
                self._take_over_what_is_sound()

    def _save(self, patience_s: float) -> None:
        """Write what is to be written. Raises `InputError`, `JobError`; after a while where the file is in use."""
        until = monotonic() + patience_s
        while True:
            try:
                with self._locked():
                    self._take_over_what_is_sound()
                    self._write()
                return
            except _NotNow:
                if monotonic() >= until:
                    raise
            sleep(_PAUSE_S)

    def _take_over(self) -> None:
        """Read what is kept, where that is other than it was. Raises `_NotNow`, `_Damaged`."""
        stamp = self._stamp()
        if stamp != self._seen:
            self._kept = self._read()
            self._seen = stamp
        self._rebuild()

    def _take_over_what_is_sound(self) -> None:
        """The same under the lock, where a damaged file is moved away. Raises `InputError`."""
        try:
            self._take_over()
        except _Damaged:
            self._set_aside = _set_aside(self.path)
            self._seen = None  # it is moved away, and is not to be taken for an empty queue
            self._rebuild()

    def _rebuild(self) -> None:
        self.queue.entries = list(self._kept)
        for change in self._unsaved:
            change(self.queue)
        self.queue.settle(self._presence.is_open)

    @contextmanager
    def _locked(self) -> Iterator[None]:
        """Keep other windows off the file. Raises `_NotNow`."""
        with suppress(OSError):  # whoever writes the file says what is wrong
            self.path.parent.mkdir(parents=True, exist_ok=True)
        lock = QLockFile(str(self.path.with_name(f"{NAME}.lock")))
        if not lock.tryLock(0) and is_held(lock):
            raise self._in_use(lock)
        try:
            yield
        finally:
            lock.unlock()

    def _in_use(self, lock: QLockFile) -> _NotNow:
        return _NotNow(
            Message(
                "{path}: another window has it in use all the time ({lock}), and it was not changed; close what hangs",
                path=self.path,
                lock=Path(lock.fileName()).name,
            )
        )

    def _read(self) -> list[Entry]:
        """The entries that are kept; none where there is no file. Raises `_NotNow`, `_Damaged`."""
        try:
            return _entries(json.loads(self.path.read_text(encoding="utf-8")))
        except FileNotFoundError:
            return []
        except OSError as error:
            raise _NotNow(Message("{path}: cannot be read ({reason})", path=self.path, reason=reason(error))) from error
        except (ValueError, TypeError, KeyError, AttributeError, RecursionError) as error:
            raise _Damaged from error

    def _write(self) -> None:
        document = {"schema": _SCHEMA, "entries": [entry.as_json() for entry in self.queue.entries]}
        write_text(self.path, json.dumps(document, indent=1, ensure_ascii=False) + "\n")
        self._kept, self._seen = list(self.queue.entries), self._stamp()
        self._unsaved.clear()

    def _stamp(self) -> Stamp:
        try:
            found = self.path.stat()
        except OSError:
            return None
        return found.st_mtime_ns, found.st_size, found.st_ino


def _entries(document: dict[str, Any]) -> list[Entry]:
    if document["schema"] not in _READ:
        raise ValueError(document["schema"])
    entries = [Entry.from_json(kept) for kept in document["entries"]]
    ids = [entry.id for entry in entries]
    if len(set(ids)) < len(ids):
        raise ValueError(ids)
    return entries


def _set_aside(path: Path) -> InputError:
    """Keep a damaged file under another name; returns what to tell of it. Raises `InputError` where that fails."""
    numbered = (path.with_name(f"{path.stem}.damaged-{number}{path.suffix}") for number in range(1, 1_000_000))
    aside = next(place for place in numbered if not place.exists())
    try:
        path.rename(aside)
    except OSError as error:
        raise InputError(
            Message("{path}: is damaged, and cannot be renamed ({reason})", path=path, reason=reason(error))
        ) from error
    return InputError(
        Message("{path}: is no queue that can be read; it is kept as {aside}", path=path, aside=aside.name)
    )
