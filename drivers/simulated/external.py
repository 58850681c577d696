"""Physics of somebody else's making: functions in a Python file that a stand file names."""

from collections.abc import Callable
from pathlib import Path
from typing import TypeAlias

from tumble.drivers.errors import DeviceError, is_of_the_user
from tumble.drivers.own_file import load_from_file
from tumble.drivers.text import reason_of
from tumble.messages import Message

Response: TypeAlias = Callable[[float, float, float, float, float], float]
"""`response(ax_g, ay_g, az_g, temperature_degC, time_s) -> volts`, noise-free."""
HeadError: TypeAlias = Callable[[float, int, float], float]
"""`head_error(angle_deg, direction, time_s) -> degrees`; true angle = reported + error."""


def load_function(reference: str, base_path: Path) -> Callable[..., float]:
    """Load the function that `FILE.py:FUNCTION` names. Raises `ValueError`, as `load_from_file` does.

    Whatever the function raises is a `DeviceError`: it is the instrument that fails.
    """
    function = load_from_file(reference, base_path)
    if not callable(function):
        raise ValueError(
            Message("{reference} is no function; name one, or correct the stand file", reference=reference)
        )

    def call(*given: float) -> float:
        try:
            return float(function(*given))
        except DeviceError:
            raise
        except BaseException as error:
            if is_of_the_user(error):
                raise
            failed = Message("{reference} failed ({reason})", reference=reference, reason=reason_of(error))
            raise DeviceError(Message("simulated stand"), failed, Message("correct it, then resume")) from error

    return call
