"""The method `triad`: three accelerometers on a two-axis stand."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tumble.calibrations.core.joining import joined
from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.triad.document import document
from tumble.calibrations.methods.triad.entry import VERSION, entry
from tumble.calibrations.methods.triad.loop import TriadLoop, close_triad_loop
from tumble.calibrations.methods.triad.observations import TriadObservations, read_triad_table
from tumble.calibrations.methods.triad.sections import sections
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.sentences import set_aside_section

_NEEDED = ("outer_deg", "inner_deg", "u_x_V", "u_y_V", "u_z_V")


@dataclass(frozen=True, kw_only=True)
class TriadResult:
    """Tables of one triad, taken together."""

    loop: TriadLoop

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be asked of the table, and what was odd in it."""
        return (*self.loop.doubts, *self.loop.observations.warnings)

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """With what was found."""
        return self.loop.augmented.parameters

    def document(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`."""
        return document(self.loop)

    def entry(self) -> Entry:
        """The result as the store takes it."""
        return entry(self.loop)

    def sections(self) -> Sequence[Section]:
        """What is shown."""
        rows = self.loop.observations
        return [*sections(self.loop), set_aside_section(rows.source, rows.set_aside)]


@dataclass(frozen=True)
class TriadMethod:
    """Three accelerometers on a two-axis stand."""

    name: str = "triad"
    version: int = VERSION
    title: str = "A triad of accelerometers on a two-axis stand"
    columns: str = "a triad on a two-axis stand (outer_deg, inner_deg, u_x_V, u_y_V, u_z_V)"
    at_stand: bool = False

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:  # noqa: ARG002  # by names alone
        """Whether a table holds both angles and three outputs."""
        return set(_NEEDED) <= set(header)

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # by names alone
        """Whether its columns are misspelt."""
        return misspelt(header, [*TriadObservations.spelt()], _NEEDED)

    def close_loop(self, paths: Sequence[Path]) -> TriadResult:
        """Trace tables of one triad, taken together. Raises `TableError`, `ValueError`."""
        return TriadResult(
            loop=close_triad_loop(joined([read_triad_table(path) for path in paths], [None] * len(paths)))
        )


METHOD = TriadMethod()
