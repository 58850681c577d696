"""What a method brings to the job at a stand: all that the application needs to measure and calibrate its units.

`JobPart` is to the application what `ProcedurePart` is to the engine. It is registered by an entry point of the group
`tumble.jobs` under the name of the method; `tumble.app.jobs` finds it.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, runtime_checkable

from tumble.calibrations.core.provenance import Provenance
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.view import Section
from tumble.calibrations.stand_records.agreement import Run
from tumble.calibrations.stand_records.record import StandRecord, Validity
from tumble.calibrations.tracing.experiments import Experiment

if TYPE_CHECKING:  # `tumble.app.jobs`, which they import, holds parts against this
    from tumble.app.analysed import Analysed, Traced
    from tumble.app.available import Available
    from tumble.app.measurement import Measurement
    from tumble.app.stand import LoadedStand, WrittenStand
    from tumble.procedures.plan import Plan


class StandRun(Run, Protocol):
    """A run as far as its stand is concerned."""

    @property
    def objections(self) -> tuple[str, ...]:
        """Why nothing may be learned from the run, as parts of a sentence; empty for a good run."""
        ...

    @property
    def doubts(self) -> tuple[str, ...]:
        """Of what the run does not tell whether it is the stand's, in sentences."""
        ...

    def contradictions(self, record: StandRecord) -> Sequence[str]:
        """Where it contradicts the stand record that was applied to it, in sentences."""
        ...

    def validity(self, measured_at: str) -> Validity:
        """Over what it was measured."""
        ...


class StandPart(Protocol):
    """What runs of a method say of their stand, and how they are corrected by what is known of it."""

    def correctable(self, rows: Any) -> bool:  # noqa: ANN401  # the kind of rows of its method
        """Whether these rows are of a unit that a stand record corrects."""
        ...

    def corrected(self, rows: Any, record: StandRecord) -> Any:  # noqa: ANN401
        """Rows corrected by a stand record."""
        ...

    def validity(self, rows: Any) -> Validity:  # noqa: ANN401
        """Over what rows were measured."""
        ...

    def run(self, traced: Any) -> StandRun | None:  # noqa: ANN401  # what its own method makes
        """A run as far as its stand is concerned; None where nothing was traced."""
        ...


class JobPart(Protocol):
    """The part of a method that the application needs where a unit is measured at a stand."""

    @property
    def experiments(self) -> frozenset[str]:
        """Programmes of the experiments by which a loop can act; empty for a method that has none."""
        ...

    @property
    def stand(self) -> StandPart | None:
        """How it learns of a stand and corrects by what is known; None for a method that does neither."""
        ...

    def read_table(self, path: Path) -> Rows:
        """Read a table of this method. Raises `TableError`."""
        ...

    def answered(self, rows: Any) -> Rows:  # noqa: ANN401  # the kind of rows of its method
        """Rows as they may be joined with others. Raises `ValueError`: they contradict their own description."""
        ...

    def fit(self, measurement: "Measurement", origin: Provenance, trials: int | None) -> "Analysed":
        """Fit the declared model; `trials` of the Monte Carlo check, None for as many as the method takes.

        Raises
        ------
        ValueError
            The rows cannot be analysed.
        InputError
            The stand file does not fit.
        """
        ...

    def trace(self, analysed: Any) -> "Traced":  # noqa: ANN401  # what `fit` made
        """Close the loop; what to measure next is not asked."""
        ...

    def suggested(self, traced: Any) -> tuple[Experiment, ...]:  # noqa: ANN401  # what `trace` made
        """What to measure next, of everything that the method knows of."""
        ...

    def available(self, stand: "LoadedStand", rows: Any, attended: bool) -> "Available":  # noqa: ANN401
        """Ask a stand which experiments it can run after these rows; `attended` where a person is there."""
        ...


@runtime_checkable
class SomeTables(Protocol):
    """The job of a method that also reads tables which no run at a stand leaves; without it, it takes all of them."""

    def reads(self, header: Sequence[str]) -> bool:
        """Whether a table with these columns is one as a run leaves it."""
        ...


@runtime_checkable
class Pictured(Protocol):
    """The job of a method that draws the positions of a programme."""

    def pictures(self, targets_deg: Sequence[Mapping[str, float]]) -> Sequence[Section]:
        """Pictures of positions in their order, each by the angles of its axes."""
        ...


class Promise(Protocol):
    """What a plan promises of its result."""

    @property
    def sentences(self) -> Sequence[str]:
        """For the terminal."""
        ...

    def as_json(self) -> dict[str, Any]:
        """Further keys of `tumble.plan/1`."""
        ...


@runtime_checkable
class Promising(Protocol):
    """The job of a method that knows from a plan how uncertain its result will be."""

    def promise(self, planned: "Plan", stand: "WrittenStand") -> Promise | None:
        """What a plan promises at a stand; None where its programme does not say enough."""
        ...


@runtime_checkable
class OverTemperature(Protocol):
    """The job of a method whose runs at several temperatures become a table of parameters against temperature."""

    def parameter_runs(self, tables: Sequence[Any]) -> Mapping[str, Sequence[float]]:
        """Columns of that table. Raises `ValueError`."""
        ...
