"""What somebody wants of a run that no window watches, in words: to pause, to go on, the last point again, to stop."""

import math
import threading
import time
from collections.abc import Callable
from enum import StrEnum
from typing import Final

from tumble.messages import Message
from tumble.procedures.control import Control
from tumble.procedures.events import (
    ConditionAnswered,
    ConditionRequested,
    Event,
    PointCompleted,
    ReadingAnswered,
    ReadingRequested,
    RunResumed,
    State,
    StateChanged,
)

MOST_PAUSED_MIN: Final = 60.0
"""How long a pause lasts at most where nobody sits at the terminal; the run is then stopped, and can be resumed."""


class Wish(StrEnum):
    """The word for it in English."""

    PAUSE = "pause"
    CONTINUE = "continue"
    AGAIN = "again"
    STOP = "stop"


_WORDS: Final = {
    **{wish.value: wish for wish in Wish},
    "пауза": Wish.PAUSE,
    "далі": Wish.CONTINUE,
    "повтор": Wish.AGAIN,
    "стоп": Wish.STOP,
    "weiter": Wish.CONTINUE,
    "nochmal": Wish.AGAIN,
    "stopp": Wish.STOP,
}


def is_wish(line: str) -> bool:
    """Whether a line of a control file is a wish."""
    return _understood(line) is not None


class Wishes:
    """Has wishes heeded by a run, from any thread; is a `Listener` of its events.

    Parameters
    ----------
    control
        Of the run.
    tell
        Takes a sentence on a wish that cannot be heeded.
    now_s
        Real time, of a clock that never goes back.
    """

    def __init__(
        self, control: Control, tell: Callable[[str], object], now_s: Callable[[], float] = time.monotonic
    ) -> None:
        self._control, self._tell, self._now_s = control, tell, now_s
        self._last: int | None = None
        self._paused = self._asked = False
        self._at_most_min: float | None = None
        self._until_s = math.inf
        self._one_by_one = threading.Lock()

    def __call__(self, event: Event) -> None:
        """Know which point is the last, since when everything stands, and whether a question is open."""
        with self._one_by_one:
            if isinstance(event, PointCompleted):
                self._last = event.point.index
            elif isinstance(event, RunResumed) and event.points:
                self._last = event.points - 1
            elif isinstance(event, StateChanged):
                self._paused = event.state is State.PAUSED
                self._count()
            elif isinstance(event, ConditionRequested | ReadingRequested):
                self._asked = True
            elif isinstance(event, ConditionAnswered | ReadingAnswered):
                self._asked = False

    def typed(self, line: str) -> bool:
        """Heed a line that was typed at the terminal; false where it is no wish. A pause lasts until it is ended."""
        word = line.strip()
        wish = _WORDS.get(word.casefold())
        if wish is not None:
            self._heed(wish, None)
        elif word and not self._asked:
            self._tell(_unknown(word))
        return wish is not None

    def told(self, line: str) -> None:
        """Heed a line of a control file: a wish, and how many minutes a pause may last at most."""
        understood = _understood(line)
        if understood is None:
            self._tell(_unknown(line))
        else:
            self._heed(*understood)

    def watch(self) -> None:
        """End a pause that has lasted its time, and the run with it; to be called now and then."""
        with self._one_by_one:
            if self._now_s() >= self._until_s:
                self._until_s = math.inf
                self._control.stop(Message("the run was paused for {minutes:g} min", minutes=self._at_most_min))

    def _heed(self, wish: Wish, at_most_min: float | None) -> None:
        match wish:
            case Wish.PAUSE:
                self._pause(at_most_min)
            case Wish.CONTINUE:
                self._go_on()
            case Wish.AGAIN:
                self._take_again()
            case Wish.STOP:
                self._control.stop()

    def _pause(self, at_most_min: float | None) -> None:
        with self._one_by_one:
            self._at_most_min = at_most_min
            self._count()
            self._control.pause()

    def _go_on(self) -> None:
        with self._one_by_one:
            self._until_s = math.inf
            self._control.resume()

    def _take_again(self) -> None:
        if (last := self._last) is None:
            self._tell(Message("there is no point yet that could be taken again"))
        else:
            self._control.take_again(last)

    def _count(self) -> None:
        """Have a pause last as long as it may, from now on; one that is not there yet has not begun."""
        lasts_min = math.inf if self._at_most_min is None or not self._paused else self._at_most_min
        self._until_s = self._now_s() + 60.0 * lasts_min


def _unknown(line: str) -> str:
    known = ", ".join(Wish)
    return Message("{wish!r} is nothing that a run can do; known are {known}", wish=line[:40], known=known)


def _understood(line: str) -> tuple[Wish, float] | None:
    """A wish, and how many minutes a pause may last at most; None where a line says nothing clear."""
    word, _, rest = line.strip().partition(" ")
    wish, at_most_min = _WORDS.get(word.casefold()), _minutes(rest)
    return None if wish is None or at_most_min is None else (wish, at_most_min)


def _minutes(text: str) -> float | None:
    """Minutes from text; the usual ones where there is none, None where it is no positive number."""
    try:
        minutes = float(text) if text.strip() else MOST_PAUSED_MIN
    except ValueError:
        return None
    return minutes if 0.0 < minutes < float("inf") else None
