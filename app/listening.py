"""Who is listened to while a run of the command line goes on: its terminal, where it has one, and its control file."""

import io
import signal
import sys
import threading
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Final

from tumble.app.control_file import ControlFile, deaf
from tumble.app.terminal import say
from tumble.app.wishes import Wishes
from tumble.procedures.announcer import Listener
from tumble.procedures.control import Control
from tumble.procedures.typed import Typed

LOOK_S: Final = 0.2
"""From one look at the file to the next, in real time."""


def typed_here() -> Typed:
    """What is typed at the terminal, or comes through the standard input; nothing where that is closed.

    What is typed in another encoding is nothing clear, and the next line is heard; from a file or a pipe it is trouble.
    """
    if sys.stdin is None or sys.stdin.closed:
        return nothing_typed()
    if sys.stdin.isatty() and isinstance(sys.stdin, io.TextIOWrapper):
        sys.stdin.reconfigure(errors="replace")
    return Typed(sys.stdin)


def nothing_typed() -> Typed:
    """Leaves whatever is typed to whoever reads it next."""
    return Typed(io.StringIO())


@contextmanager
def listening(typed: Typed, control: Control, recording: Path) -> Iterator[Listener]:
    """Have a run heed what is typed, and what its control file says; yields what must hear of its events.

    A run whose control file cannot be made is not told anything by it, and that is said.
    """
    wishes, file = Wishes(control, _complain), ControlFile(recording)
    with ExitStack() as stack:
        stack.callback(control.resume)  # a pause that nobody has heeded is none of the next run
        if typed.is_terminal:
            _overhear(typed, wishes, stack)
        try:
            file.open()
        except OSError as error:
            _complain(deaf(file, error))
        else:
            _read(file, wishes, stack)
        yield wishes


def _read(file: ControlFile, wishes: Wishes, stack: ExitStack) -> None:
    """Have what is written into the file heeded until the end of the run."""
    stack.callback(file.close)
    over = threading.Event()
    ear = threading.Thread(target=_listen, args=(file, wishes, over), name="control file", daemon=True)
    ear.start()
    stack.callback(ear.join)
    stack.callback(over.set)


def _overhear(typed: Typed, wishes: Wishes, stack: ExitStack) -> None:
    """Have lines of the terminal heeded until the end of the run."""
    before, typed.overhear = typed.overhear, wishes.typed
    stack.callback(setattr, typed, "overhear", before)
    if hasattr(signal, "SIGTTIN"):
        with suppress(ValueError):  # not the main thread
            # a run that is put into the background would else be halted, with whatever moves, as soon as it reads
            signal.signal(signal.SIGTTIN, signal.SIG_IGN)
    typed.begin()


def _listen(file: ControlFile, wishes: Wishes, over: threading.Event) -> None:
    while not over.wait(LOOK_S):
        for line in filter(str.strip, _taken(file)):
            wishes.told(line)
        wishes.watch()


def _taken(file: ControlFile) -> list[str]:
    """What is told by a file; one that somebody took away is there again."""
    try:
        return file.taken()
    except FileNotFoundError:
        with suppress(OSError):
            file.open()
    except OSError:  # something else has its name for now
        pass
    return []


def _complain(sentence: str) -> None:
    """Say something to whoever looks; what cannot be said keeps nothing from being heeded."""
    with suppress(OSError, ValueError):
        say(sentence, err=True)
