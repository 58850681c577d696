"""The method `dividing_head`: an accelerometer on a dividing head in the gravity field."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from tumble.calibrations.core.joining import joined
from tumble.calibrations.core.known_tables import misspelt
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.view import Quantity, Section
from tumble.calibrations.methods.dividing_head.document import document
from tumble.calibrations.methods.dividing_head.entry import VERSION, entry
from tumble.calibrations.methods.dividing_head.loop.loop import Loop, close_loop
from tumble.calibrations.methods.dividing_head.loop.sections import sections
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.quantities import QUANTITIES
from tumble.calibrations.methods.dividing_head.table import read_table
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.sentences import set_aside_section
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class DividingHeadResult:
    """Tables of one accelerometer, taken together."""

    observations: Observations
    loop: Loop

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences to be read first."""
        return self.loop.augmented.warnings

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """With what was found."""
        return self.loop.augmented.parameters

    def document(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`."""
        return document(self.loop)

    def entry(self) -> Entry:
        """The result as the store takes it, without a budget or limits."""
        return entry(self.loop.declared, (), self.loop, None)

    def sections(self) -> Sequence[Section]:
        """What is shown."""
        rows = self.loop.augmented.observations
        return [*sections(self.loop), set_aside_section(rows.source, rows.set_aside)]


@dataclass(frozen=True)
class DividingHead:
    """An accelerometer on a dividing head in the gravity field."""

    name: str = "dividing_head"
    version: int = VERSION
    title: str = Message("An accelerometer on a dividing head")
    columns: str = Message("an accelerometer on a head (angle_deg, voltage_V)")
    headline: str = "kx"
    quantities: Mapping[str, Quantity] = field(default_factory=lambda: QUANTITIES)

    def reads(self, header: Sequence[str], numbers: Sequence[str] | None) -> bool:  # noqa: ARG002  # by names alone
        """Whether a table holds angles of a head and the output of a unit."""
        return {"angle_deg", "voltage_V"} <= set(header)

    def hint(self, header: Sequence[str], numbers: Sequence[str]) -> str:  # noqa: ARG002  # by names alone
        """Whether its columns are misspelt."""
        return misspelt(header, [*Observations.spelt()], ("angle_deg", "voltage_V"))

    def close_loop(self, paths: Sequence[Path]) -> DividingHeadResult:
        """Trace tables of one unit, taken together. Raises `TableError`, `ValueError`."""
        observations = joined([read_table(path) for path in paths], [None] * len(paths))
        return DividingHeadResult(observations=observations, loop=close_loop(observations))


METHOD = DividingHead()
