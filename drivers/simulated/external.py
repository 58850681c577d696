"""Physics of somebody else's making: functions in a Python file that a stand file names."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeAlias

from drivers.own_file import load_from_file

Response: TypeAlias = Callable[[float, float, float, float, float], float]
"""`response(ax_g, ay_g, az_g, temperature_degC, time_s) -> volts`, noise-free."""
HeadError: TypeAlias = Callable[[float, int, float], float]
"""`head_error(angle_deg, direction, time_s) -> degrees`; true angle = reported + error."""


def load_function(reference: str, base_path: Path) -> Callable[..., Any]:
    """Load the function that `FILE.py:FUNCTION` names. Raises `ValueError`, as `load_from_file` does."""
    function = load_from_file(reference, base_path)
    if not callable(function):
        raise ValueError(f"{reference} is no function; name one, or correct the stand file")
    return function
