"""The person who turns the head by hand: asked for a setting, and asked again where something does not fit.

Enter alone says that the head stands as asked. Whatever else is typed is the reading: one that is not an angle is
asked for again, and so is one that differs from the setting, or that what was measured contradicts afterwards.
"""

import math
from collections.abc import Callable
from typing import Final

from tumble.drivers.clock import Clock
from tumble.drivers.manual.reading import on_the_circle, parse_reading
from tumble.messages import Message
from tumble.procedures.errors import UnansweredError
from tumble.procedures.events import Event, ReadingAnswered, ReadingRequested
from tumble.procedures.journeys import POLL_S
from tumble.procedures.operator import Answer, Operator

_MOST_REFUSED: Final = 10
"""Answers in a row that are no angles; more is nobody who reads the head."""


class OperatorEyepiece:
    """Has an operator set and read the head. Fits `tumble.drivers.manual.Eyepiece` and `second_look.Reader`.

    Parameters
    ----------
    operator
        Who is asked.
    clock
        By which an answer is awaited.
    tolerance_deg
        A reading that differs from the setting by more is asked for again.
    name
        What the positioner is called, where the stand has others besides the head.
    forget
        Called where the question need not be answered any more.
    """

    def __init__(
        self,
        operator: Operator,
        clock: Clock,
        tolerance_deg: float,
        name: str = "",
        forget: Callable[[], None] = lambda: None,
    ) -> None:
        self._operator = operator
        self._called = name or Message("the head")
        self._forget = forget
        self._clock = clock
        self._tolerance_deg = tolerance_deg
        self._announce: Callable[[Event], None] = _unheard
        self._setting_deg = 0.0
        self._doubted_deg = math.nan
        self._refused = 0

    def attach(self, announce: Callable[[Event], None]) -> None:
        """Have everything that is asked and answered passed to `announce`."""
        self._announce = announce

    def show(self, setting_deg: float) -> None:
        """Ask for a setting and its reading."""
        self._setting_deg, self._doubted_deg = setting_deg, math.nan
        self._ask(
            Message(
                "Set {positioner} to {setting}; Enter when it reads so, or type the reading.",
                positioner=self._called,
                setting=on_the_circle(setting_deg),
            )
        )

    def reading_deg(self) -> float | None:
        """The reading, in the revolution of the setting; None as long as there is none that stands.

        Raises
        ------
        UnansweredError
            Where nobody will answer, or somebody declines.
        """
        answer = self._operator.poll()
        return None if answer is None else self._understood(answer)

    def withdraw(self) -> None:
        """Have it asked no more; an answer that comes late is passed over with the next request."""
        self._forget()

    def read_again(self, angle_deg: float, prompt: str, check: Callable[[], object]) -> float:
        """What the person reads when told what speaks against `angle_deg`, in degrees.

        Raises
        ------
        UnansweredError
            Where nobody answers.
        """
        self._setting_deg = self._doubted_deg = angle_deg
        self._ask(prompt)
        while (answer := self._operator.poll()) is None or (again_deg := self._read(answer)) is None:
            check()
            self._clock.sleep(POLL_S)
        return again_deg

    def _understood(self, answer: Answer) -> float | None:
        reading_deg = self._read(answer)
        if reading_deg is None:
            return None
        off_deg = abs(reading_deg - self._setting_deg)
        if off_deg <= self._tolerance_deg or math.isclose(reading_deg, self._doubted_deg, abs_tol=1e-6):
            return reading_deg
        self._doubted_deg = reading_deg
        self._ask(
            Message(
                "You read {reading}, the setting was {setting}: type it again to keep it, or set "
                "{positioner} right and press Enter.",
                positioner=self._called,
                reading=on_the_circle(reading_deg),
                setting=on_the_circle(self._setting_deg),
            )
        )
        return None

    def _read(self, answer: Answer) -> float | None:
        """The angle that was typed, the setting for Enter alone; None, and asked again, for what is no angle."""
        if not answer.confirmed:
            self._note(answer, math.nan)
            raise self._unanswered(
                Message("was answered {answer!r}", answer=answer.text) if answer.text else Message("was not answered")
            )
        try:
            reading_deg = self._unwrapped(parse_reading(answer.text)) if answer.text else self._setting_deg
        except ValueError as error:
            self._note(answer, math.nan)
            self._refused += 1
            if self._refused >= _MOST_REFUSED:
                raise self._unanswered(
                    Message.counted(
                        "was answered {count} time in a row with no angle: {error}",
                        "was answered {count} times in a row with no angle: {error}",
                        count=self._refused,
                        error=error,
                    )
                ) from error
            self._ask(Message("{error}.", error=error))
            return None
        self._refused = 0
        self._note(answer, reading_deg)
        return reading_deg

    def _unanswered(self, said: str) -> UnansweredError:
        return UnansweredError(
            Message(
                "the request to set {positioner} to {setting} {said}; set it and resume the run",
                positioner=self._called,
                setting=on_the_circle(self._setting_deg),
                said=said,
            )
        )

    def _unwrapped(self, reading_deg: float) -> float:
        """The circle begins anew with every turn; the setting says which turn is meant."""
        return reading_deg + 360.0 * round((self._setting_deg - reading_deg) / 360.0)

    def _ask(self, prompt: str) -> None:
        self._announce(ReadingRequested(setting_deg=self._setting_deg, prompt=prompt))
        self._operator.ask_reading(prompt)

    def _note(self, answer: Answer, reading_deg: float) -> None:
        self._announce(ReadingAnswered(setting_deg=self._setting_deg, answer=answer.text, reading_deg=reading_deg))


def _unheard(_event: Event) -> None:
    """Nobody is attached."""
