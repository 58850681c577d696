"""What somebody else wrote in a Python file that a stand file names."""

import importlib.util
import sys
from pathlib import Path
from types import ModuleType


def load_from_file(reference: str, base_path: Path) -> object:
    """Load what `FILE.py:NAME` names, the file being relative to `base_path`.

    Raises
    ------
    ValueError
        Where the reference is malformed, the file cannot be loaded, or holds no such name.
    """
    file_name, _, name = reference.rpartition(":")
    if not file_name or not name.isidentifier():
        raise ValueError(f"{reference!r} names nothing in a file; write FILE.py:NAME")
    path = base_path / file_name
    module = _load_module(path)
    if not hasattr(module, name):
        raise ValueError(f"{path} has no {name!r}; define it there or correct the stand file")
    return getattr(module, name)


def _load_module(path: Path) -> ModuleType:
    spec = importlib.util.spec_from_file_location(f"own_file_{path.stem}", path)
    if spec is None or spec.loader is None:
        raise ValueError(f"{path} is no Python file; name one that ends in .py")
    module = sys.modules[spec.name] = importlib.util.module_from_spec(spec)  # dataclasses look themselves up there
    try:
        spec.loader.exec_module(module)
    except Exception as error:  # whatever another's file raises, the operator needs to know which file it was
        raise ValueError(f"{path} could not be loaded ({type(error).__name__}: {error}); correct it") from error
    return module
