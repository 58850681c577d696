"""One adopted effect, as it is kept: it never changes."""

from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from typing import TypeAlias

from tumble.calibrations.adopted.curve import Curve
from tumble.calibrations.adopted.shared import expected
from tumble.calibrations.core.provenance import Source
from tumble.calibrations.stand_records.record import StandIdentity
from tumble.calibrations.tracing.effect import Expected, Owner, Variable
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class UnitType:
    """With every unit of a type."""

    name: str

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return Message("unit type {name}", name=self.name)


@dataclass(frozen=True, kw_only=True)
class OfStand:
    """With one stand, its head and its DAQ."""

    identity: StandIdentity

    @property
    def words(self) -> Message:
        """The same for a reader."""
        return Message("stand {stand}", stand=self.identity.stand)


KeptWith: TypeAlias = UnitType | OfStand
"""With what an effect comes again."""


@dataclass(frozen=True, kw_only=True)
class UnitSeen:
    """A unit on which it was found."""

    serial_number: str
    size: float
    """In those of the mean of all units."""
    standard_uncertainty: float
    measured_at: str
    """Start of the run, ISO 8601; empty where the file does not say."""
    sources: tuple[Source, ...]
    """Its files."""


@dataclass(frozen=True, kw_only=True, eq=False)
class AdoptedEffect:
    """Structure along one axis of a method's tables, with a name."""

    name: str
    method: str
    kept_with: KeptWith
    channel: str
    variable: str
    detail: str
    """Which of several variables of the same word."""
    depends_on: Variable
    """Whose blocks carry its evidence."""
    also_possible: tuple[tuple[str, str], ...] = ()
    """Other channels and variables from which the units did not part it."""
    channel_unit: str
    variable_unit: str
    curve: Curve
    kernel: str
    gain: float
    """By how much -2 ln L of all units falls with it."""
    spread: float | None
    """Standard deviation of its size between units, in those of the mean; None where one unit was seen."""
    units: tuple[UnitSeen, ...]
    operator: str
    adopted_at: datetime
    program_version: str
    content_sha256: str = ""

    @property
    def key(self) -> tuple[str, str, str]:
        """Of the axis in the tables of its method, see `tracing.components.Axis.key`."""
        return self.channel, self.variable, self.detail

    @property
    def belongs_to(self) -> Owner:
        """Unit or stand."""
        return "unit" if isinstance(self.kept_with, UnitType) else "stand"

    @property
    def expected(self) -> Expected | None:
        """How large it is in the next unit; a stand has one size, which is that of every run."""
        return expected(self.spread, len(self.units))

    @property
    def reference(self) -> Mapping[str, str]:
        """What a result says of an effect that was offered to it."""
        return {"name": self.name, "content_sha256": self.content_sha256}
