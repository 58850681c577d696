"""The moments of a run at which something can go wrong: one for every kind of step."""

from collections.abc import Callable
from threading import Timer
from typing import Any, Final, Literal

from benchmarks.endurance.emulated import SAMPLES
from tumble.app.wiring import Connected

Moment = Literal["identification", "homing", "mount prompt", "move", "settling", "dwell"]
MOMENTS: Final[tuple[Moment, ...]] = ("identification", "homing", "mount prompt", "move", "settling", "dwell")

PROMPT_S: Final = 3.0
"""How long the operator takes to answer, by the stand's clock."""
_SOON_S: Final = 0.02
"""From the request for samples to the midst of them, in real time."""
_WHICH: Final = 3
"""Which move, settling and dwell of the run."""


def strike_at(moment: Moment, connected: Connected, device: str, early: bool, strike: Callable[[], None]) -> None:
    """Have `strike` called once, at a moment of the run to come.

    Parameters
    ----------
    moment
        The second request to seat the unit; the third move, settling or dwell; the only homing and identification.
    connected
        The stand, whose instruments are watched from now on.
    device
        Whose identification, `head` or `daq`.
    early
        Before the head is told to move or samples are asked for, and not in the midst of it.
    """
    head: Any = connected.stand.positioners["head"]
    daq: Any = connected.stand.samplers["daq"]
    if moment == "identification":
        _before(daq if device == "daq" else head, "identify", strike)
    elif moment == "mount prompt":
        _before(connected.operator, "ask", strike, number=2)
    elif moment in ("homing", "move"):
        command, number = ("home", 1) if moment == "homing" else ("start_move", _WHICH)
        _before(head, command, strike if early else lambda: _when_moving(head, strike), number)
    elif moment == "settling":
        _before(daq, "acquire", strike, 2 * _WHICH, lambda samples, _: samples != SAMPLES)
    else:
        _before(
            daq, "acquire", strike if early else lambda: _soon(strike), _WHICH, lambda samples, _: samples == SAMPLES
        )


def take_time_to_answer(connected: Connected) -> None:
    """Have the operator answer a request only after a while."""
    operator: Any = connected.operator
    clock, poll, asked_s = connected.stand.clock, operator.poll, [0.0]

    def note(*_: object) -> bool:
        asked_s[0] = clock.monotonic_s()
        return False

    _before(operator, "ask", lambda: None, counts=note)
    operator.poll = lambda: poll() if clock.monotonic_s() - asked_s[0] > PROMPT_S else None


def _before(
    owner: object,
    name: str,
    call: Callable[[], None],
    number: int = 1,
    counts: Callable[..., bool] = lambda *_: True,
) -> None:
    """Call something before the `number`-th call of a method whose arguments count."""
    method, seen = getattr(owner, name), [0]

    def heard(*arguments: object) -> object:
        if counts(*arguments):
            seen[0] += 1
            if seen[0] == number:
                call()
        return method(*arguments)

    setattr(owner, name, heard)


def _when_moving(head: Any, strike: Callable[[], None]) -> None:
    """Strike when the head is first seen to move."""
    status, struck = head.status, []

    def watched() -> Any:
        seen = status()
        if seen.moving and not struck:
            struck.append(True)
            strike()
        return seen

    head.status = watched


def _soon(strike: Callable[[], None]) -> None:
    timer = Timer(_SOON_S, strike)
    timer.daemon = True
    timer.start()
