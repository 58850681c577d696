"""Lines that somebody types, or that come from a file or a pipe."""

import errno
import os
import time
from collections.abc import Callable
from contextlib import suppress
from queue import Empty, Queue
from threading import Thread
from typing import Final, TextIO

from tumble.messages import Message

_MOST: Final = 100
"""Lines that wait to be taken."""
_AWAY_S: Final = 0.2
"""From one attempt to the next at a terminal that gave no line, in real time."""


class Typed:
    """Reads lines in a thread of their own, the only way to watch a terminal that works on Windows too.

    The thread begins with `begin` and ends with the input, of a terminal once that hangs up: nothing else can end its
    wait for a line.
    """

    def __init__(self, lines: TextIO) -> None:
        self.is_terminal = lines.isatty()
        self.overhear: Callable[[str], bool] = lambda _: False
        """Is shown every line of a terminal first, in the thread that reads; true where it was meant for that."""
        self.at_end = False
        """Whether no more lines will come, or whoever was asked at a terminal has said so."""
        self.trouble = ""
        """Why lines cannot be read."""
        self._lines = lines
        self._waiting: Queue[str | None] = Queue(maxsize=_MOST)
        self._thread: Thread | None = None
        self._ended = False

    def begin(self) -> None:
        """Read from now on; a second call does nothing."""
        if self._thread is None:
            self._thread = Thread(target=self._read, name="console", daemon=True)
            self._thread.start()

    def next(self) -> str | None:
        """The next line, if there is one by now."""
        try:
            line = self._waiting.get_nowait()
        except Empty:
            return None
        self.at_end = line is None
        return line

    def forget(self) -> None:
        """Throw away what was typed on a terminal so far; lines from a file or a pipe are all taken, in order."""
        if self.is_terminal:
            while not self._waiting.empty():
                self.next()
            self.at_end = self._ended

    def _read(self) -> None:
        try:
            while self._read_on():
                time.sleep(_AWAY_S)
        except Exception as error:  # nobody would see it in this thread
            self.trouble = Message("{kind}: {error}", kind=type(error).__name__, error=error)
        finally:
            self._ended = True
            self._waiting.put(None)

    def _read_on(self) -> bool:
        """Read to the end of the lines; true where there may be more, since only Ctrl+D or another program ends them.

        A terminal refuses to be read while its foreground is another's.
        """
        try:
            for line in self._lines:
                if not (self.is_terminal and self.overhear(line)):
                    self._keep(line)
        except OSError as error:
            if error.errno == errno.EIO and self._stands():
                return True
            raise
        if self._stands():
            self._keep(None)
            return True
        return False

    def _stands(self) -> bool:
        """Whether there is a terminal that has not hung up."""
        with suppress(OSError, ValueError):  # it is no file
            return self.is_terminal and os.isatty(self._lines.fileno())
        return False

    def _keep(self, line: str | None) -> None:
        """Have a line wait, or its end; of a terminal that nobody asks the oldest gives way, so that it is heard on."""
        if self.is_terminal and self._waiting.full():
            self.next()
        self._waiting.put(line)
