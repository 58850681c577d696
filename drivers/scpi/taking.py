"""Taking a block of readings: set up, begin, read back, fetch; a block that goes wrong is taken anew, as a whole."""

import math
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager, suppress
from typing import Final, TypeVar

import numpy as np
from numpy.typing import NDArray

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.scpi.codec import CorruptReplyError, parse_readings
from tumble.drivers.scpi.exchange import ATTEMPTS, Exchange
from tumble.drivers.scpi.measurement import TOLERANCE, Measurement
from tumble.drivers.scpi.plain import PlainExchange
from tumble.messages import Message

REMEDY: Final = Message("check the settings of the stand file")

Taken = TypeVar("Taken")


def perform(exchange: Exchange, clock: Clock, measurement: Measurement, transfer_s: float) -> NDArray[np.float64]:
    """Take a block; one that goes wrong is taken anew, as a whole.

    Parameters
    ----------
    transfer_s
        How long the readings may be on their way, in real seconds.

    Raises
    ------
    DeviceError
        It went wrong `ATTEMPTS` times.
    NoReplyError, LinkLostError
        The meter or the way to it is gone.

    And whatever breaks the wait for it off: the meter is told to take no more of the block then.
    """
    return _insisted(exchange, measurement, lambda: _taken(exchange, clock, measurement, transfer_s))


def perform_singly(
    exchange: Exchange, clock: Clock, measurement: Measurement, count: int, rate_hz: float
) -> tuple[NDArray[np.float64], float]:
    """Take readings one by one, each when its time has come.

    Returns the readings, and the rate in Hz at which they were taken, which is less than `rate_hz` where meter and wire
    need longer. Raises as `perform`.
    """
    return _insisted(exchange, measurement, lambda: _taken_singly(exchange, clock, measurement, count, rate_hz))


def _insisted(exchange: Exchange, measurement: Measurement, take: Callable[[], Taken]) -> Taken:
    happened = ""
    for _ in range(ATTEMPTS):
        try:
            with _abandoning(exchange):
                return take()
        except LinkLostError:
            raise
        except NoReplyError as error:
            if not (isinstance(exchange, PlainExchange) and exchange.answers()):
                raise
            happened = Message(
                "it answers, though not to {fetch} ({happened})", fetch=measurement.fetch, happened=error.happened
            )
        except DeviceError as error:
            happened = error.happened
    raise DeviceError(
        Message("multimeter"),
        Message.counted(
            "failed to measure {count} time: {happened}",
            "failed to measure {count} times: {happened}",
            count=ATTEMPTS,
            happened=happened,
        ),
        Message("look at its display, then resume the run"),
    )


@contextmanager
def _abandoning(exchange: Exchange) -> Iterator[None]:
    """End a block for which nobody waits any more: some meters hear nothing else until its last reading."""
    try:
        yield
    except DeviceError:
        raise
    except BaseException:
        with suppress(DeviceError):
            exchange.say("ABOR")
        raise


def same(value: float | str, answer: str) -> bool:
    """Whether a setting that is read back is what was set."""
    if isinstance(value, str):
        return answer.strip('"').casefold() == value.casefold()
    try:
        read_back = parse_readings(answer).tolist()  # of a scanner one number for each channel
    except CorruptReplyError:
        return False
    return all(math.isclose(number, value, rel_tol=TOLERANCE, abs_tol=1e-6) for number in read_back)


def _taken(exchange: Exchange, clock: Clock, measurement: Measurement, transfer_s: float) -> NDArray[np.float64]:
    if exchange.asks_all_at_once:
        _set_up(exchange, measurement, (*measurement.preparation, *measurement.begin))
        clock.sleep(measurement.duration_s)
        return _readings(_fetched(exchange, measurement, transfer_s), measurement.count)
    _set_up(exchange, measurement, measurement.preparation)
    exchange.say(*measurement.begin)  # some listen to nothing else until the last reading is there
    if measurement.begin:
        clock.sleep(measurement.duration_s)
    readings = _readings(_fetched(exchange, measurement, transfer_s), measurement.count)
    _complain(map(str, exchange.errors()))
    return readings


def _taken_singly(
    exchange: Exchange, clock: Clock, measurement: Measurement, count: int, rate_hz: float
) -> tuple[NDArray[np.float64], float]:
    _set_up(exchange, measurement, measurement.preparation)
    began_s = clock.monotonic_s()
    readings = np.empty(count)
    integrating_s = measurement.duration_s if measurement.begin else 0.0  # else it is awaited where it is asked for
    for taken in range(count):
        clock.sleep(began_s + taken / rate_hz - clock.monotonic_s())
        exchange.say(*measurement.begin)
        readings[taken] = _readings(_fetched(exchange, measurement, integrating_s), 1)[0]
    lasted_s = clock.monotonic_s() - began_s
    _complain(map(str, exchange.errors()))
    return readings, min(rate_hz, count / lasted_s) if lasted_s > 0.0 else rate_hz


def _set_up(exchange: Exchange, measurement: Measurement, commands: Sequence[str]) -> None:
    """Configure, read everything back. Raises `DeviceError` where the meter is not set as it was told."""
    answers = list(exchange.ask(*measurement.questions, commands=commands))
    complaints = [str(entry) for entry in exchange.errors()]
    if measurement.function and not set((function := answers.pop(0)).replace('"', "").split(",")) <= set(
        measurement.functions
    ):
        complaints.append(Message("it measures {function}", function=function))
    for (header, value), answer in zip(measurement.settings, answers, strict=True):
        if not same(value, answer):
            complaints.append(
                Message("{header} is {answer} instead of {value}", header=header, answer=answer, value=value)
            )
    _complain(complaints)


def _complain(complaints: Iterable[str]) -> None:
    if said := ", ".join(complaints):
        raise DeviceError(Message("multimeter"), said, REMEDY)


def _fetched(exchange: Exchange, measurement: Measurement, transfer_s: float) -> str:
    if measurement.begin or not isinstance(exchange, PlainExchange):
        return exchange.ask(measurement.fetch, extra_s=measurement.extra_s + transfer_s)[0]
    extra_s = measurement.duration_s + measurement.extra_s + transfer_s
    try:
        return exchange.ask_once(measurement.fetch, extra_s)
    except CorruptReplyError as error:
        raise DeviceError(
            Message("multimeter"),
            Message("gave readings that came to harm ({error})", error=error),
            Message("check the cable"),
        ) from error


def _readings(field: str, count: int) -> NDArray[np.float64]:
    try:
        readings = parse_readings(field)
    except CorruptReplyError as error:
        raise DeviceError(
            Message("multimeter"),
            Message("gave readings that are none ({error})", error=error),
            Message("check its language"),
        ) from error
    if len(readings) != count:
        happened = Message.counted(
            "gave {given} of {count} reading", "gave {given} of {count} readings", given=len(readings), count=count
        )
        raise DeviceError(Message("multimeter"), happened, Message("check that nobody else talks to it"))
    return readings
