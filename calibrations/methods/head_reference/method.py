"""The method `head_reference`: a dividing head measured against a reference."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.view import Quantity, Section
from tumble.calibrations.methods.head_reference.changes import Comparison, compare
from tumble.calibrations.methods.head_reference.comparison_document import comparison_json
from tumble.calibrations.methods.head_reference.document import document
from tumble.calibrations.methods.head_reference.entry import VERSION, entry
from tumble.calibrations.methods.head_reference.loop import ReferenceLoop, close_reference_loop
from tumble.calibrations.methods.head_reference.observations import HeadObservations, read_head_table
from tumble.calibrations.methods.head_reference.sections import difference, sections
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.sentences import set_aside_section
from tumble.messages import Message

_MOST_COMPARED = 2
_QUANTITIES = {"offset": Quantity(symbol="o", words=Message("offset of the reference against the head"))}


@dataclass(frozen=True, kw_only=True)
class HeadResult:
    """One table of a head, or two that are compared."""

    names: tuple[str, ...]
    loops: tuple[ReferenceLoop, ...]

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences to be read first."""
        return tuple(dict.fromkeys(warning for loop in self.loops for warning in loop.warnings))

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The offset of the last table, with what was found."""
        return self.loops[-1].augmented.parameters

    @cached_property
    def comparison(self) -> Comparison | None:
        """How two tables differ; None of one."""
        return compare(*self.loops) if len(self.loops) > 1 else None

    def document(self) -> dict[str, Any]:
        """One table as `tumble.loop/1`; of two both, with their comparison."""
        documents = [document(loop) for loop in self.loops]
        if self.comparison is None:
            return documents[0]
        common = {key: documents[0][key] for key in ("schema", "method")}
        return common | {"tables": documents} | comparison_json(self.comparison, *self.names)

    def entry(self) -> Entry:
        """The result as the store takes it. Raises `ValueError` for two tables, each of which is a record."""
        if len(self.loops) > 1:
            raise ValueError(Message("{name}: record one table of a head at a time", name=self.names[1]))
        return entry(self.loops[0])

    def sections(self) -> Sequence[Section]:
        """What is shown: how two tables differ, then each of them."""
        shown = [] if self.comparison is None else list(difference(self.comparison, *self.names))
        for name, loop in zip(self.names, self.loops, strict=True):
            shown += [Section(title=name, lines=(f"{name}:",), brief=True)] if self.comparison else []
            shown += [set_aside_section(name, loop.observations.set_aside), *sections(loop)]
        return shown


@dataclass(frozen=True)
class HeadReference:
    """A dividing head measured against a reference."""

    name: str = "head_reference"
    version: int = VERSION
    title: str = Message("A dividing head measured against a reference")
    columns: str = Message("a head against a reference (angle_deg, reference_deg)")
    headline: str = ""
    quantities: Mapping[str, Quantity] = field(default_factory=lambda: _QUANTITIES)

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:  # noqa: ARG002  # by names alone
        """Whether a table holds angles of a head and of a reference, and no output of a unit."""
        return {"angle_deg", "reference_deg"} <= set(header) and "voltage_V" not in header

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # by names alone
        """Whether its columns are misspelt."""
        return (
            misspelt(header, [*HeadObservations.spelt()], ("angle_deg", "reference_deg"))
            if "voltage" not in " ".join(header).lower()
            else ""
        )

    def close_loop(self, paths: Sequence[Path]) -> HeadResult:
        """Trace one table, or two of one head, which are then compared. Raises `TableError`, `ValueError`."""
        if len(paths) > _MOST_COMPARED:
            raise ValueError(Message("{path}: give one table of a head, or two to be compared", path=paths[2]))
        loops = tuple(close_reference_loop(read_head_table(path)) for path in paths)
        return HeadResult(names=tuple(path.name for path in paths), loops=loops)


METHOD = HeadReference()
