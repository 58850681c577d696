"""The programmes that come along, and those in files of one's own: read from TOML, each by the schema of its method."""

import re
import sys
from collections.abc import Mapping
from functools import lru_cache
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Final

from tumble.messages import Message
from tumble.procedures.about import about
from tumble.procedures.errors import InputError, ProgrammeError
from tumble.procedures.first_method import FIRST
from tumble.procedures.programme import Programme
from tumble.procedures.registry import find_method, usable_methods
from tumble.procedures.toml_lines import place_of, read_text
from tumble.procedures.toml_text import read_toml

_FIRST_TABLE: Final = re.compile(r"^([ \t]*\[)", re.MULTILINE)
_DWELL: Final = re.compile(r"^[ \t]*(?:dwell_s|samples)[ \t]*=.*\n?", re.MULTILINE)


def shipped_programmes() -> list[str]:
    """Names of the programmes that come along with all methods, those of the first method at the beginning."""
    return list(_shipped())


def load_programme(name_or_path: str | Path) -> Programme:
    """Read a programme that comes along, by its name, or one from a file: TOML, or a table of settings (CSV).

    Raises
    ------
    ProgrammeError
        Where there is no such programme, or it is not a valid one: file, line, what is wrong and what to do.
    """
    return programme_from_text(*_read(name_or_path))


def about_programme(name_or_path: str | Path) -> str:
    """What a programme says of itself, read without the schema of its method, which takes time to load.

    Raises `ProgrammeError` where there is no such programme, or its file cannot be read.
    """
    text, _ = _read(name_or_path)
    return about(text)


def _read(name_or_path: str | Path) -> tuple[str, str]:
    """Text of a programme (TOML), and what messages call it. Raises `ProgrammeError`."""
    if (entry := _shipped().get(str(name_or_path))) is not None:
        return entry.read_bytes().decode("utf-8"), entry.name
    path = Path(name_or_path)
    if not path.is_file():
        names = ", ".join(shipped_programmes())
        raise ProgrammeError(
            Message(
                "{name_or_path}: there is no such file; give a TOML file or one of {names}",
                name_or_path=name_or_path,
                names=names,
            )
        )
    try:
        text = read_text(path)
        return _listed(text, path) if path.suffix.lower() == ".csv" else text, path.name
    except InputError as error:
        raise ProgrammeError(str(error)) from error


def _listed(text: str, path: Path) -> str:
    """The programme of a table of settings. Raises `InputError` where no method knows such a one."""
    makers = [part.listed for method in usable_methods() if (part := method.procedure_part).listed]
    try:
        programmes = [programme for make in makers if (programme := make(text, path.stem))]
    except ValueError as error:
        raise InputError(Message("{path}: {error}; correct it", path=path, error=error)) from error
    if not programmes:
        raise InputError(
            Message("{path}: no method measures at settings of these columns; give a TOML file", path=path)
        )
    return programmes[0]


def programme_from_text(text: str, source: str) -> Programme:
    """Read a programme from TOML, for example from a recording; messages call it `source`. Raises `ProgrammeError`."""
    try:
        return _schema(text, source).from_text(text, source)
    except InputError as error:
        raise ProgrammeError(str(error)) from error


def with_dwell(text: str, dwell_s: float) -> str:
    """The text of a programme with another duration of its dwells, in place of `dwell_s` or `samples`."""
    return _with(text, f"dwell_s = {dwell_s:g}")


def with_samples(text: str, samples: int) -> str:
    """The same with so many samples in each of its dwells."""
    return _with(text, f"samples = {samples}")


def _with(text: str, line: str) -> str:
    head, table, rest = _FIRST_TABLE.split(text, maxsplit=1) if _FIRST_TABLE.search(text) else (text, "", "")
    return f"{_DWELL.sub('', head).rstrip()}\n{line}\n\n{table}{rest}"


def _schema(text: str, source: str) -> type[Programme]:
    """The schema of a programme's method. Raises `InputError`."""
    name = read_toml(text, source).get("method", FIRST)
    try:
        return find_method(str(name)).procedure_part.programme
    except ValueError as error:
        where = place_of(source, text, ("method",))
        raise InputError(Message("{where}: method: {error}; correct it", where=where, error=error)) from error


def _shipped() -> Mapping[str, Traversable]:
    """The programmes that come along, by name."""
    return _found_on(tuple(sys.path))


@lru_cache(maxsize=8)
def _found_on(_: tuple[str, ...]) -> Mapping[str, Traversable]:
    """The same, looked up once for each place where packages lie: a list of programmes asks for each of its lines."""
    programmes: dict[str, Traversable] = {}
    for method in usable_methods():
        entries = method.procedure_part.shipped.iterdir()
        found = {entry.name.removesuffix(".toml"): entry for entry in entries if entry.name.endswith(".toml")}
        programmes |= dict(sorted(found.items()))
    return programmes
