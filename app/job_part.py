"""What a method brings to the job at a stand: all that the application needs to measure and calibrate its units.

`JobPart` is to the application what `ProcedurePart` is to the engine. It is registered by an entry point of the group
`tumble.jobs` under the name of the method; `tumble.app.jobs` finds it.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol, Self

from markupsafe import Markup

from tumble.app.available import Available
from tumble.app.measurements import Measurement
from tumble.app.stand import LoadedStand
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.stand_records.agreement import Run
from tumble.calibrations.stand_records.record import StandRecord, Validity
from tumble.calibrations.tracing.chain import Chain, ClosedLoop
from tumble.calibrations.tracing.experiments import Experiment

if TYPE_CHECKING:
    from tumble.calibrations.tracing.explained import Explained


class Analysed(Protocol):
    """Raw files of one unit, and what the declared model says of them."""

    @property
    def measurement(self) -> Measurement:
        """The raw files."""
        ...

    @property
    def provenance(self) -> Provenance:
        """Where the result comes from."""
        ...

    @property
    def limits(self) -> tuple[LimitCheck, ...]:
        """The values to use, held against the limits of the programme."""
        ...

    @property
    def model(self) -> Model:
        """Whose values are to be used."""
        ...

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        ...

    @property
    def warnings(self) -> tuple[str, ...]:
        """Sentences to be read first."""
        ...

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        ...

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        ...

    def in_short(self) -> Sequence[str]:
        """How well the values describe the rows, in a line or two."""
        ...

    def details(self) -> Sequence[str]:
        """The same one by one: rows, noise, adequacy, what the experiment supports."""
        ...

    def figure(self) -> Markup:
        """What the model leaves, as SVG."""
        ...

    def as_json(self) -> dict[str, Any]:
        """The result as JSON, with the verdict."""
        ...


class Traced(Analysed, Protocol):
    """The same with the loop closed: what the residual was traced to, and what that does to the parameters."""

    @property
    def loop(self) -> ClosedLoop:
        """What was found."""
        ...

    @property
    def explained(self) -> "Explained[Any, Any] | None":
        """What the loop rests on; None where nothing was traced."""
        ...

    @property
    def next_experiment(self) -> tuple[Experiment, ...]:
        """What to measure next."""
        ...

    @property
    def rows(self) -> Rows:
        """The rows that the loop was closed on; those that it sets aside are listed in it."""
        ...

    @property
    def loop_warnings(self) -> tuple[str, ...]:
        """Sentences to be read before what was found."""
        ...

    @property
    def shows_values(self) -> bool:
        """Whether `sections` hold the values to use, too."""
        ...

    def sections(self) -> Sequence[Section]:
        """What is shown of the closed loop, the answer first."""
        ...

    def loop_json(self) -> dict[str, Any]:
        """The closed loop as JSON, with the verdict."""
        ...

    def planned(self, experiments: tuple[Experiment, ...]) -> Self:
        """The same with what to measure next."""
        ...

    def refitted(self, analysed: Any) -> Self:  # noqa: ANN401  # what its own method makes
        """The same with another fit of the same rows."""
        ...

    def report(self, record_id: str, revision: int, chain: Chain[Any] | None, contradictions: Sequence[str]) -> str:
        """The report, one HTML page; with the experiments that closed the loop, where there were any."""
        ...


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

    def fit(self, measurement: Measurement, origin: Provenance, trials: int | None) -> Analysed:
        """Fit the declared model; `trials` of the Monte Carlo check, None for as many as the method takes.

        Raises
        ------
        ValueError
            The rows cannot be analysed.
        InputError
            The stand file does not fit.
        """
        ...

    def trace(self, analysed: Any) -> Traced:  # noqa: ANN401  # what `fit` made
        """Close the loop; what to measure next is not asked."""
        ...

    def suggested(self, traced: Any) -> tuple[Experiment, ...]:  # noqa: ANN401  # what `trace` made
        """What to measure next, of everything that the method knows of."""
        ...

    def available(self, stand: LoadedStand, rows: Any, attended: bool) -> Available:  # noqa: ANN401
        """Ask a stand which experiments it can run after these rows; `attended` where a person is there."""
        ...
