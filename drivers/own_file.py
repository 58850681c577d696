"""What somebody else wrote in a Python file that a stand file names, and the hash of that file.

What is run is the text of the file, as it was hashed: no compiled copy that lies beside it.
"""

import re
import sys
from hashlib import sha256
from pathlib import Path
from types import ModuleType
from typing import Final

from tumble.drivers.errors import is_of_the_user
from tumble.drivers.text import reason_of
from tumble.messages import Message

_FORMER: Final = frozenset({"app", "calibrations", "drivers", "emulators", "procedures", "window"})
"""Packages that had no `tumble.` before their names until version 0.2."""
_REMOTE: Final = re.compile(r"[\\/]{2}|[A-Za-z][A-Za-z0-9+.-]+:[\\/]{1,2}")


def load_from_file(reference: str, base_path: Path) -> object:
    """Load what `FILE.py:NAME` names, the file being relative to `base_path`.

    Raises
    ------
    ValueError
        Where the reference is malformed, the file cannot be loaded, or holds no such name.
    """
    file_name, name = _parts(reference)
    path = base_path / file_name
    module = _load_module(path)
    if not hasattr(module, name):
        raise ValueError(
            Message("{path} has no {name!r}; define it there or correct the stand file", path=path, name=name)
        )
    return getattr(module, name)


def is_own_file(reference: str) -> bool:
    """Whether a driver is named by a file, and not by the name under which it is installed."""
    return ":" in reference


def hash_of_file(reference: str, base_path: Path) -> str:
    """SHA-256 of the file in `FILE.py:NAME`, hexadecimal; empty where there is none that can be read."""
    try:
        return sha256((base_path / _parts(reference)[0]).read_bytes()).hexdigest()
    except (OSError, ValueError):
        return ""


def is_remote(path: str) -> bool:
    r"""Whether a path leads to another computer, as written: `\\SERVER\SHARE`, `//SERVER/SHARE`, or a URL."""
    return _REMOTE.match(path) is not None


def _parts(reference: str) -> tuple[str, str]:
    file_name, _, name = reference.rpartition(":")
    if not file_name or not name.isidentifier():
        raise ValueError(Message("{reference!r} names nothing in a file; write FILE.py:NAME", reference=reference))
    if is_remote(file_name):
        raise ValueError(
            Message(
                "{reference!r} leads to another computer, whose code is not run; copy the file to this one",
                reference=reference,
            )
        )
    return file_name, name


def _load_module(path: Path) -> ModuleType:
    if path.suffix != ".py":
        raise ValueError(Message("{path} is no Python file; name one that ends in .py", path=path))
    module = ModuleType(f"own_file_{path.stem}")
    module.__file__ = str(path)
    sys.modules[module.__name__] = module  # dataclasses look themselves up there
    try:
        exec(compile(path.read_bytes(), str(path), "exec"), module.__dict__)
    except BaseException as error:  # whatever another's file raises, the operator needs to know which file it was
        if is_of_the_user(error):
            raise
        raise ValueError(_not_loaded(path, error)) from error
    return module


def _not_loaded(path: Path, error: BaseException) -> str:
    former = error.name or "" if isinstance(error, ModuleNotFoundError) else ""
    if former.partition(".")[0] in _FORMER:
        return Message(
            "{path} imports {former}, which is tumble.{former} since version 0.2; write that in the file",
            path=path,
            former=former,
        )
    return Message("{path} could not be loaded ({reason})", path=path, reason=reason_of(error))
