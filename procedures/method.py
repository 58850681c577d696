"""What a calibration method brings along for the stand: programmes, columns, and the table that its analysis reads."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from importlib.resources.abc import Traversable
from typing import TYPE_CHECKING, Any, Final, Generic, Protocol, TypeAlias, TypeVar

from tumble.calibrations.core.rows import Rows
from tumble.procedures.layout import Layout
from tumble.procedures.second_look import Contradicted, nothing_contradicts

if TYPE_CHECKING:
    from tumble.procedures.programme import Programme
    from tumble.procedures.recording.recorded import Recording

_OFTEN_LACKING: Final = frozenset({"temperature_degc", "take"})
"""Columns that a table has where there was a thermometer, and where a point was taken again."""
Demand: TypeAlias = Callable[[Mapping[str, Any]], None]
"""Looks at a stand file as data, without `simulated`. Raises `ValueError`: what it lacks, and what to do."""


def demand_nothing(stand: Mapping[str, Any]) -> None:
    """Take any stand."""


Table = TypeVar("Table", covariant=True)


@dataclass(frozen=True, kw_only=True)
class ProcedurePart(Generic[Table]):
    """The part of a method that the engine, the recording and the programmes need."""

    programme: type["Programme"]
    """The schema of its programmes, which make its procedures."""
    shipped: Traversable
    """Folder of the programmes that come along, `NAME.toml` each."""
    table: Callable[["Recording"], Table]
    """The table of a recording: a row for every complete point."""
    rows: type[Rows] = Rows
    """The kind of that table."""
    contradicted: Contradicted = nothing_contradicts
    """What speaks against a position that a person read."""
    listed: Callable[[str, str], str] | None = None
    """Makes the text of a programme of its name and of a table of settings (CSV); empty where the table is of another
    method. Raises `ValueError` where it cannot be read."""
    derived: frozenset[str] = frozenset()
    """Columns of the table that are worked out from those of a recording."""
    lacking: frozenset[str] = frozenset()
    """Columns of the table that some recordings have and others lack, besides temperature and `take`."""
    demand: Demand = demand_nothing
    """What its table needs of the stand file; asked before anything moves."""
    stand: Traversable | None = None
    """The simulated stand that is built in for its programmes; None for that of a head and a DAQ."""

    @property
    def layout(self) -> Layout:
        """The columns of its points."""
        return self.programme.layout

    def exports(self, columns: Sequence[str]) -> bool:
        """Whether the table of a recording has these columns, as tables spell them, in this order."""
        recorded, lacking = self.layout.described().keys() | self.derived, self.lacking | _OFTEN_LACKING
        spelt = {name: field for name, field in self.rows.spelt().items() if field in recorded | self.lacking}
        return list(columns) == [name for name, field in spelt.items() if name in columns or field not in lacking]


class Method(Protocol):
    """A calibration method as far as a stand is concerned; what the entry point group `tumble.procedures` names."""

    @property
    def name(self) -> str:
        """Its name in programmes and recordings."""
        ...

    @property
    def version(self) -> int:
        """Grows where its points or steps come to mean something else."""
        ...

    @property
    def procedure_part(self) -> ProcedurePart[object]:
        """Programmes, columns and table."""
        ...
