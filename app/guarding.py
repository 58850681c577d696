"""Instruments whose driver is a file of somebody's own: whatever it raises is a fault of that instrument."""

import inspect
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any, Final, TypeVar

from tumble.drivers.errors import DeviceError, is_of_the_user
from tumble.drivers.own_file import is_own_file
from tumble.drivers.text import reason_of
from tumble.messages import Message
from tumble.procedures.errors import InputError, ProcedureError, StopRequestedError, StorageError, UnansweredError

Made = TypeVar("Made")

_MEANT: Final = (
    DeviceError,
    InputError,
    ProcedureError,
    StopRequestedError,
    StorageError,
    UnansweredError,
)
"""What a driver may raise, or lets through from a person whom it asks."""
HEAD_NEEDS: Final = frozenset({"home", "identify", "limits_deg", "speed_deg_s", "start_move", "status", "stop"})
"""Members of `Positioner`."""
DAQ_NEEDS: Final = frozenset({"acquire", "identify"})
"""Members of `Sampler`."""
CHAMBER_NEEDS: Final = frozenset(
    {"begin", "identify", "limits_degc", "lock_door", "make_safe", "ramp_k_per_min", "status"}
)
"""Members of `Environment`."""
EXCITER_NEEDS: Final = frozenset({"drive", "identify", "make_safe", "ramp_s", "status"})
"""Members of `Exciter`."""
_ABSENT: Final = object()


def connected(connect: Callable[[], Made], driver: str, device: str, needed: frozenset[str]) -> Made:
    """Connect to an instrument; one whose `driver` is a file of somebody's own is guarded from then on.

    Raises
    ------
    DeviceError
        The instrument cannot be reached, or the driver failed.
    ValueError
        A file that its table names cannot be used, or the driver lacks what it `needed`.
    """
    if not is_own_file(driver):
        return connect()
    with _blamed(device, driver, (*_MEANT, ValueError)):
        instrument = connect()
        missing = [name for name in sorted(needed) if not hasattr(instrument, name)]
    if missing:
        raise ValueError(
            Message(
                "the driver {driver} of the {device} has no {missing}; see drivers/protocols.py",
                driver=driver,
                device=device,
                missing=", ".join(missing),
            )
        )
    return _guarded(instrument, device, driver)


def _guarded(instrument: Made, device: str, driver: str) -> Made:
    """The same instrument, whose methods and properties raise nothing but what they may."""

    def method(name: str) -> Callable[..., Any]:
        @wraps(getattr(instrument, name))
        def call(_self: object, *given: Any, **named: Any) -> Any:  # noqa: ANN401  # whatever the method takes
            with _blamed(device, driver):
                return getattr(instrument, name)(*given, **named)

        return call

    def attribute(_self: object, name: str) -> Any:  # noqa: ANN401  # whatever the driver has
        absent = inspect.getattr_static(instrument, name, _ABSENT) is _ABSENT
        with _blamed(device, driver, (*_MEANT, AttributeError) if absent else _MEANT):
            return getattr(instrument, name)

    names = [name for name in dir(instrument) if not name.startswith("_") and _is_method(instrument, name)]
    made: Made = type("Guarded", (), {name: method(name) for name in names} | {"__getattr__": attribute})()
    return made


def _is_method(instrument: object, name: str) -> bool:
    found = inspect.getattr_static(instrument, name)
    return callable(found) or isinstance(found, staticmethod | classmethod)


@contextmanager
def _blamed(device: str, driver: str, meant: tuple[type[BaseException], ...] = _MEANT) -> Iterator[None]:
    try:
        yield
    except meant:
        raise
    except BaseException as error:
        if is_of_the_user(error):
            raise
        failed = Message("its driver {driver} failed ({reason})", driver=driver, reason=reason_of(error))
        raise DeviceError(device, failed, Message("correct it, then resume the run")) from error
