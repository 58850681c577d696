"""The kinds of simulated worlds: a stand file says by `world` in its table `[simulated]` which of them it has.

A kind is registered by an entry point of the group `tumble.worlds`. Its instruments are `SimulatedHead`s by name, and
voltmeters that see some or all of its outputs; the emulators serve the same ones through the protocols of real devices.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Final, Generic, Protocol, TypeVar

from tumble import plugins
from tumble.drivers.clock import Clock
from tumble.drivers.exciter_table import ExciterTable
from tumble.drivers.protocols import Block, Sampler
from tumble.drivers.simulated.chamber import SimulatedChamber
from tumble.drivers.simulated.exciter import SimulatedExciter
from tumble.drivers.simulated.head import HeadOptions, SimulatedHead
from tumble.drivers.simulated.table import SimulatedTable
from tumble.drivers.tables import ChamberTable
from tumble.messages import Message

_GROUP: Final = "tumble.worlds"

Settings = TypeVar("Settings", bound=SimulatedTable)


class Meter(Sampler, Protocol):
    """A voltmeter of a world, which a caller that does the waiting may read at once."""

    def take(self, samples: int, rate_hz: float) -> Block:
        """What `acquire` returns when the samples are there. Raises `DeviceError`."""
        ...

    def temperatures_degc(self) -> Mapping[str, float]:
        """What the thermometers of its channels say now; it is no look at the outputs."""
        ...


class Counted(Protocol):
    """How often things have happened in a world, by which random draws are keyed; a dataclass."""

    dwells: int


class World(Protocol):
    """Everything that is true at a simulated stand, and the instruments through which it is seen."""

    @property
    def positioners(self) -> Mapping[str, SimulatedHead]:
        """Its axes, by name."""
        ...

    def meter(self, channels: Sequence[str]) -> Meter:
        """A voltmeter at these outputs, at all where none is named. Raises `ValueError` for one that it has not."""
        ...

    @property
    def chamber(self) -> SimulatedChamber | None:
        """What gives the unit its temperature; None where nothing does but the room."""
        ...

    @property
    def setters(self) -> Mapping[str, Callable[[str], None]]:
        """What a person may set here between dwells, by condition."""
        ...

    @property
    def counts(self) -> Counted:
        """What has happened so far."""
        ...

    def switch_on(self) -> None:
        """Switch the unit off and on for a moment."""
        ...

    def put_back(self, counts: Any, outage_s: float) -> None:  # noqa: ANN401  # the counts of its own kind
        """Count the draws on from `counts`, and have everything that drifts and wanders stand as `outage_s` ago."""
        ...


@dataclass(frozen=True, kw_only=True)
class Surroundings:
    """What a world is made from, besides its table."""

    clock: Clock
    """By which it lives; it begins at the present time."""
    heads: Mapping[str, HeadOptions] = field(default_factory=dict)
    """Limits, counts and speed of the axes that the stand file has, by name."""
    folder: Path = Path()
    """Folder of the stand file, to which the files of external functions are relative."""


@dataclass(frozen=True, kw_only=True)
class WorldKind(Generic[Settings]):
    """A kind of world."""

    table: type[Settings]
    """The keys of its table `[simulated]`."""
    build: Callable[[Settings, Surroundings], World]
    """Make it. Raises `ValueError` where a file that the table names cannot be used, or an axis is none of its own."""


def find_world(name: str) -> WorldKind[Any]:
    """A kind of world by its name in a stand file. Raises `ValueError` where there is none."""
    try:
        kind: object = plugins.load(_GROUP, name)
    except LookupError:
        known = ", ".join(sorted(plugins.names(_GROUP)))
        raise ValueError(
            Message("no simulated world is called {name!r}; known are {known}", name=name, known=known)
        ) from None
    if not isinstance(kind, WorldKind):
        raise ValueError(Message("{name} is no simulated world; register a WorldKind", name=name))
    return kind


def chamber_of(world: World, table: ChamberTable) -> "SimulatedChamber":
    """The chamber of a world with what the stand file says of it. Raises `ValueError` where it has none."""
    if world.chamber is None:
        raise ValueError(Message("this simulated world has no temperature chamber; leave [chamber] out"))
    world.chamber.options = table
    return world.chamber


def exciter_of(world: World, table: ExciterTable) -> SimulatedExciter:
    """The exciter of a world with what the stand file says of it. Raises `ValueError` where it has none."""
    exciter: SimulatedExciter | None = getattr(world, "exciter", None)
    if exciter is None:
        raise ValueError(Message("this simulated world has nothing that shakes the unit; leave [exciter] out"))
    exciter.options = table
    return exciter


def axis_of(positioners: Mapping[str, SimulatedHead], name: str) -> SimulatedHead:
    """An axis of a world by its name. Raises `ValueError` where it has none of that name."""
    if name not in positioners:
        raise ValueError(
            Message(
                "the simulated world has no positioner {name}; it has {there}", name=name, there=", ".join(positioners)
            )
        )
    return positioners[name]
