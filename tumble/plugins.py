"""What installed packages bring along by entry points: methods, jobs, parts of the window, drivers.

A package that cannot be used is refused in one sentence where it is named, and left out where all are looked through.
"""

import logging
import sys
from collections.abc import Iterator, Mapping
from functools import lru_cache
from importlib.metadata import Distribution, EntryPoint, EntryPoints, distribution, distributions
from typing import Any, Final

from tumble.messages import Message

_OURS: Final = "tumble."
"""How the name of each of our groups begins."""


class PluginError(ValueError):
    """An entry point that cannot be used; says in one sentence which and why."""


def names(group: str) -> list[str]:
    """What installed packages name in a group, sorted."""
    return sorted(_named(group, tuple(sys.path)))


def load(group: str, name: str, kind: type | None = None) -> Any:  # noqa: ANN401  # what the caller declares it to be
    """What an entry point names.

    Parameters
    ----------
    kind
        A class or protocol whose public attributes it must have; None where the caller looks at it.

    Raises
    ------
    LookupError
        No installed package has this name in the group.
    PluginError
        It cannot be imported or is not of this kind, or two packages give the name to different things.
    """
    point = _one(group, name, _named(group, tuple(sys.path))[name])
    try:
        found = point.load()
        missing = [] if kind is None else [each for each in _members(kind) if not hasattr(found, each)]
        called = found.name if kind is not None and "name" in _members(kind) and not missing else name
    except (Exception, SystemExit) as error:  # whatever a stranger's module does
        raise _refused(
            point, Message("{kind}: {error}", kind=type(error).__name__, error=_first_line(error))
        ) from error
    if missing:
        raise _refused(point, Message("it lacks {attributes}", attributes=", ".join(missing)))
    if called != name:
        raise _refused(point, Message("it calls itself {called!r}", called=called))
    return found


def usable(group: str, kind: type) -> dict[str, Any]:
    """Everything in a group that can be used, by name; what cannot is logged as a warning and left out."""
    found = {}
    for name in names(group):
        try:
            found[name] = load(group, name, kind)
        except PluginError as error:
            warn_once(str(error))
    return found


@lru_cache(maxsize=64)
def warn_once(sentence: str) -> None:
    """Log a warning the first time that it is given; it goes to standard error unless a program handles it."""
    logging.getLogger("tumble").warning("%s", sentence)


def _one(group: str, name: str, points: tuple[EntryPoint, ...]) -> EntryPoint:
    first, *others = points
    if any(other.value != first.value for other in others):
        packages = ", ".join(sorted(_package(point) for point in points))
        raise PluginError(
            Message(
                "{name} of {group} is named by more than one package ({packages}); uninstall all but one",
                name=name,
                group=group,
                packages=packages,
            )
        )
    return first


def _refused(point: EntryPoint, why: str) -> PluginError:
    return PluginError(
        Message(
            "{name} of {group} in the package {package} cannot be used ({why}); update or uninstall the package",
            name=point.name,
            group=point.group,
            package=_package(point),
            why=why,
        )
    )


def _package(point: EntryPoint) -> str:
    return str(point.dist.name) if point.dist else point.value


def _first_line(error: BaseException) -> str:
    return next(iter(str(error).splitlines()), "")


def _members(kind: type) -> list[str]:
    return [name for name in dir(kind) if not name.startswith("_")]


@lru_cache(maxsize=32)
def _named(group: str, path: tuple[str, ...]) -> Mapping[str, tuple[EntryPoint, ...]]:
    """What installed packages name, looked up once for each place where packages lie: it takes 20 ms."""
    found: dict[str, tuple[EntryPoint, ...]] = {}
    for point in _entry_points(path).select(group=group):
        found[point.name] = (*found.get(point.name, ()), point)
    return found


@lru_cache(maxsize=8)
def _entry_points(_: tuple[str, ...]) -> EntryPoints:
    """What all packages name in our groups; of no other package is the name read, which takes 5 ms for each."""
    found: dict[str, list[EntryPoint]] = {}
    for package in distributions():
        points = [point for point in _points_of(package) if point.group.startswith(_OURS)]
        if points and _is_imported(package):
            found.setdefault(package.name, points)
    return EntryPoints(point for points in found.values() for point in points)


def _is_imported(package: Distribution) -> bool:
    """Whether no other version of the package lies before it on the path."""
    return distribution(package.name).locate_file("") == package.locate_file("")


def _points_of(package: Distribution) -> Iterator[EntryPoint]:
    try:
        yield from package.entry_points
    except Exception as error:  # a file that is written wrongly stops no other package
        warn_once(
            Message(
                "the entry points of the package {package} cannot be read ({error}); update or uninstall it",
                package=package.name,
                error=_first_line(error),
            )
        )
