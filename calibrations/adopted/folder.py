"""Names of adopted effects, and the files in which they are kept: one for each, another where it was retired."""

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from datetime import datetime
from pathlib import Path
from typing import Any, Final, TypeVar

from tumble.calibrations.adopted.document import check, effect_from, hashed
from tumble.calibrations.adopted.effect import AdoptedEffect
from tumble.calibrations.core.bounded import read_bounded
from tumble.calibrations.records.times import read_time, utc_text
from tumble.messages import Message

SUFFIX: Final = ".json"
RETIRED_SUFFIX: Final = ".retired.json"
RETIRED: Final = "tumble.retired-effect/1"
_LARGEST: Final = 16 * 2**20
"""Bytes; an effect has some 200,000."""
_NAME: Final = re.compile(r"[A-Za-z][A-Za-z0-9_-]{0,63}")
_DEVICES: Final = re.compile(r"con|prn|aux|nul|com\d|lpt\d", re.IGNORECASE)
"""Names that Windows keeps to itself."""
_T = TypeVar("_T")


@dataclass(frozen=True, kw_only=True)
class Retired:
    """Why an effect is sought no more."""

    name: str
    effect_sha256: str
    reason: str
    operator: str
    retired_at: datetime

    def document(self) -> dict[str, Any]:
        """As JSON, with its hash."""
        return hashed(
            {
                "schema": RETIRED,
                "name": self.name,
                "effect_sha256": self.effect_sha256,
                "reason": self.reason,
                "operator": self.operator,
                "retired_at": utc_text(self.retired_at),
            }
        )


@dataclass(frozen=True, kw_only=True)
class Kept:
    """An effect with what became of it."""

    effect: AdoptedEffect
    path: Path
    retired: Retired | None

    @property
    def in_force(self) -> bool:
        """Whether it is sought on later runs."""
        return self.retired is None


def check_effect_name(name: str) -> str:
    """Give a name back that can be that of an effect and of its file. Raises `ValueError`: a sentence."""
    if not _NAME.fullmatch(name) or _DEVICES.fullmatch(name):
        raise ValueError(
            Message(
                "{name!r} cannot be the name of an effect; give a letter, then letters, digits, - and _, at most 64",
                name=name,
            )
        )
    return name


def kept_in(folder: Path) -> tuple[Kept, ...]:
    """Effects of a folder by name; none where there is no such folder. Raises as `kept`."""
    return tuple(map(kept, _files(folder)))


def kept(path: Path) -> Kept:
    """An effect in a file, with what became of it.

    Raises
    ------
    ValueError
        It is broken, or was altered: a sentence with the file and what to do.
    OSError
        It cannot be read.
    """
    effect = _read(path, effect_from)
    beside = path.with_name(path.name.removesuffix(SUFFIX) + RETIRED_SUFFIX)
    retired = _read(beside, lambda content: _retired_from(content, effect)) if beside.is_file() else None
    return Kept(effect=effect, path=path, retired=retired)


def taken(folder: Path) -> frozenset[str]:
    """Names that effects of a folder have, in small letters: not every system tells them from capital ones."""
    return frozenset(path.name.removesuffix(SUFFIX).lower() for path in _files(folder))


def _files(folder: Path) -> Iterator[Path]:
    if folder.is_dir():
        yield from sorted(path for path in folder.glob(f"*{SUFFIX}") if not path.name.endswith(RETIRED_SUFFIX))


def _read(path: Path, understood: Callable[[Any], _T]) -> _T:
    try:
        content = json.loads(read_bounded(path, _LARGEST))
    except (ValueError, RecursionError) as error:
        raise _unusable(path, Message("it is no JSON")) from error
    try:
        return understood(content)
    except ValueError as error:
        raise _unusable(path, error) from error


def _unusable(path: Path, what: object) -> ValueError:
    return ValueError(
        Message(
            "{path}: cannot be used: {what}; put a copy back, or move the file away and adopt anew",
            path=path,
            what=what,
        )
    )


def _retired_from(content: Any, effect: AdoptedEffect) -> Retired:  # noqa: ANN401
    check(content, RETIRED)
    if content["effect_sha256"] != effect.content_sha256:
        raise ValueError(Message("it retires another effect than the one beside it"))
    return Retired(
        name=content["name"],
        effect_sha256=content["effect_sha256"],
        reason=content["reason"],
        operator=content["operator"],
        retired_at=read_time(content["retired_at"]),
    )
