"""Conditions that no positioner sets: asked of the operator, or set by an environment or an exciter in his place."""

from collections.abc import Callable
from functools import partial

from tumble.drivers.clock import Clock
from tumble.messages import Message
from tumble.procedures.environments import Environments
from tumble.procedures.errors import ProcedureError, UnansweredError
from tumble.procedures.events import ConditionAnswered, ConditionRequested, Event, State
from tumble.procedures.exciters import Exciters
from tumble.procedures.journeys import POLL_S
from tumble.procedures.operator import Answer, Operator
from tumble.procedures.recovery import Recovery
from tumble.procedures.steps import Ask, Confirmed, Dwell


class Requests:
    """Has conditions set, and knows which stand.

    Parameters
    ----------
    operator
        Who sets what the stand cannot.
    clock
        By which an answer is awaited.
    environments, exciters
        What sets conditions by itself.
    recovery
        Gets back whatever link is lost meanwhile.
    announce
        Takes events.
    change
        Has the run go over into another state.
    check
        Called while an answer is awaited; raises where the run should not go on waiting.
    """

    def __init__(
        self,
        operator: Operator,
        clock: Clock,
        environments: Environments,
        exciters: Exciters,
        recovery: Recovery,
        announce: Callable[[Event], None],
        change: Callable[[State], None],
        check: Callable[[], object],
    ) -> None:
        self._operator, self._clock = operator, clock
        self._environments, self._exciters, self._recovery = environments, exciters, recovery
        self._announce, self._change, self._check = announce, change, check
        self._standing: dict[str, str] = {}

    def fulfil(self, ask: Ask) -> Confirmed:
        """Have a condition set. Raises `UnansweredError` where nobody does; until it is set, it is unknown."""
        self._standing.pop(ask.condition, None)
        self._change(State.AWAITING_OPERATOR)
        self._announce(ConditionRequested(condition=ask.condition, value=ask.value, prompt=ask.prompt))
        answer = self._set_by_itself(ask) or self._asked(ask)
        self._announce(
            ConditionAnswered(condition=ask.condition, value=ask.value, answer=answer.text, confirmed=answer.confirmed)
        )
        if not answer.confirmed:
            raise _unanswered(ask, answer)
        self._standing[ask.condition] = ask.value
        self._change(State.RUNNING)
        return Confirmed(condition=ask.condition, value=ask.value)

    def stands(self, ask: Ask) -> bool:
        """Whether a condition is as it would be asked for."""
        return self._standing.get(ask.condition) == ask.value

    def check(self, dwell: Dwell) -> None:
        """Make sure that everything was set that a dwell needs. Raises `ProcedureError`."""
        for condition, value in dwell.conditions.items():
            if (standing := self._standing.get(condition)) != value:
                raise ProcedureError(f"a dwell was asked for with the {condition} {value} while it is {standing}")

    def _set_by_itself(self, ask: Ask) -> Answer | None:
        """Have an environment or an exciter set a condition, in place of the operator; None where there is neither."""
        if ask.condition in self._environments.names:
            self._change(State.RUNNING)
            return Answer(text=self._environments.soak(ask.condition, float(ask.value)), confirmed=True)
        if ask.condition in self._exciters.names:
            self._change(State.RUNNING)
            excite = partial(self._exciters.excite, ask.condition, ask.value)
            return Answer(text=self._recovery.persist(excite), confirmed=True)
        return None

    def _asked(self, ask: Ask) -> Answer:
        """What the operator answers; nothing shakes what he may have to touch."""
        self._recovery.persist(self._exciters.clear)
        self._operator.ask(ask)
        while (answer := self._operator.poll()) is None:
            self._check()
            self._clock.sleep(POLL_S)
        return answer


def _unanswered(ask: Ask, answer: Answer) -> UnansweredError:
    said = Message("was answered {answer!r}", answer=answer.text) if answer.text else Message("was not answered")
    return UnansweredError(
        Message(
            "the request to {task} {said}; {remedy} and resume the run", task=ask.task, said=said, remedy=ask.remedy
        )
    )
