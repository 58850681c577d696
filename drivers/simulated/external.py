"""Physics of somebody else's making: functions in a Python file that a stand file names."""

import importlib.util
from collections.abc import Callable
from pathlib import Path
from types import ModuleType
from typing import Any, TypeAlias

Response: TypeAlias = Callable[[float, float, float, float, float], float]
"""`response(ax_g, ay_g, az_g, temperature_degC, time_s) -> volts`, noise-free."""
HeadError: TypeAlias = Callable[[float, int, float], float]
"""`head_error(angle_deg, direction, time_s) -> degrees`; true angle = reported + error."""


def load_function(reference: str, base_path: Path) -> Callable[..., Any]:
    """Load `file.py:function`, the file being relative to `base_path`.

    Raises
    ------
    ValueError
        Where the reference is malformed, the file cannot be loaded, or it has no such function.
    """
    file_name, separator, name = reference.rpartition(":")
    if not separator or not file_name or not name.isidentifier():
        raise ValueError(f"{reference!r} names no function; write 'file.py:function'")
    path = base_path / file_name
    function = getattr(_load_module(path), name, None)
    if not callable(function):
        raise ValueError(f"{path} has no function {name!r}; define it there or correct the stand file")
    return function  # type: ignore[no-any-return]


def _load_module(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"simulated_physics_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise ValueError(f"{path} is no Python file; name one that ends in .py")
    module = importlib.util.module_from_spec(spec)
    try:
        spec.loader.exec_module(module)
    except Exception as error:  # whatever another's file raises, the operator needs to know which file it was
        raise ValueError(f"{path} could not be loaded ({type(error).__name__}: {error}); correct it") from error
    return module
