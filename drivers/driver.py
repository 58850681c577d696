"""How a driver declares itself, so that a stand file can name it: one value, wherever the driver lives.

    class Keys(OnSerialLine, HeadTable):
        axis: int = 1

    def connect(keys: Keys, bench: Bench) -> MyHead:
        return MyHead(bench.links.serial(keys, "dividing head"), keys, bench.clock)

    MY_HEAD = Driver(table=Keys, connect=connect)

In a file of a laboratory's own the stand file says `driver = "my_head.py:MY_HEAD"`. A package that is installed gives
the value a name in the entry point group `tumble.heads`, `tumble.daqs`, `tumble.chambers` or `tumble.exciters`; the
drivers that come along do the same.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final, Generic, TypeVar

from tumble import plugins
from tumble.drivers.attention import AttentiveClock
from tumble.drivers.clock import Clock
from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.links.opened import Links
from tumble.drivers.manual.head import Eyepiece
from tumble.drivers.own_file import is_own_file, load_from_file
from tumble.drivers.protocols import Environment, Exciter, Positioner, Sampler
from tumble.drivers.tables import ChamberTable, DaqTable, HeadTable, Instrument
from tumble.messages import Message

SIMULATED: Final = "simulated"
"""Names no driver, but the world that exists in this process only, with head and DAQ in one."""

Table = TypeVar("Table", bound=Instrument)
Made = TypeVar("Made", bound=Positioner | Sampler | Environment | Exciter, covariant=True)


@dataclass(frozen=True, kw_only=True)
class Bench:
    """What a driver is given besides its table."""

    clock: Clock
    """The stand's clock: a driver reads and waits by no other, except for what a link takes."""
    links: Links
    """Opens serial lines and CAN buses, and closes them at the end."""
    folder: Path
    """Where relative paths of the stand file begin."""
    eyepiece: Callable[[float], Eyepiece]
    """The person at a head without a motor; a reading farther from its setting than so many degrees is questioned."""
    check: Callable[[], object] = lambda: None
    """Breaks off the wait for an instrument, by what it raises, where it is called many times a second."""

    @property
    def attentive(self) -> "Bench":
        """The same with a clock and links that call `check` while they wait: what every sampler is given.

        A driver of what moves may take its line from it where its messages are numbered, so that an answer that comes
        late is none to the next request.
        """
        return replace(self, clock=AttentiveClock(self.clock, self.check), links=self.links.checking(self.check))


@dataclass(frozen=True, kw_only=True)
class Driver(Generic[Table, Made]):
    """What a stand file names by `driver`."""

    table: type[Table]
    """The keys of the driver's table in a stand file, with types, bounds and defaults."""
    connect: Callable[[Table, Bench], Made]
    """Reach the instrument; it is identified and referenced later, and nothing moves.

    Raises `DeviceError` where it cannot be reached, `ValueError` where a file that the table names cannot be used.
    """


HeadDriver = Driver[Any, Positioner]
DaqDriver = Driver[Any, Sampler]
ChamberDriver = Driver[Any, Environment]
ExciterDriver = Driver[Any, Exciter]


def find_head(name: str, folder: Path) -> HeadDriver | None:
    """The driver of a head by its name in a stand file in `folder`; None for the simulated one. Raises `ValueError`."""
    return _find(name, folder, "tumble.heads", HeadTable)


def find_daq(name: str, folder: Path) -> DaqDriver | None:
    """The driver of a DAQ, likewise. Raises `ValueError`."""
    return _find(name, folder, "tumble.daqs", DaqTable)


def find_chamber(name: str, folder: Path) -> ChamberDriver | None:
    """The driver of a temperature chamber, likewise. Raises `ValueError`."""
    return _find(name, folder, "tumble.chambers", ChamberTable)


def find_exciter(name: str, folder: Path) -> ExciterDriver | None:
    """The driver of an exciter, likewise. Raises `ValueError`."""
    return _find(name, folder, "tumble.exciters", ExciterTable)


def _find(name: str, folder: Path, group: str, kind: type[Instrument]) -> Driver[Any, Any] | None:
    if name == SIMULATED:
        return None
    found = load_from_file(name, folder) if is_own_file(name) else _installed(name, group)
    if not (isinstance(found, Driver) and issubclass(found.table, kind)):
        raise ValueError(
            Message(
                "{name} is no driver whose table is a {kind}; name the value made with Driver(...)",
                name=name,
                kind=kind.__name__,
            )
        )
    return found


def _installed(name: str, group: str) -> object:
    try:
        found: object = plugins.load(group, name)
    except LookupError:
        names = ", ".join(sorted({*plugins.names(group), SIMULATED}))
        raise ValueError(
            Message("no driver is called {name!r}; known are {names}, or write FILE.py:NAME", name=name, names=names)
        ) from None
    return found
