"""What the analysis of any method says of raw files, as far as the application needs to know it."""

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, Protocol, Self

from tumble.app.measurement import Measurement
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.core.view import Drawn, Section
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.report.document import Report
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.stage import ClosedLoop

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

    def figure(self) -> Drawn | None:
        """What the model leaves; None of a method that draws nothing."""
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

    def report(self, record_id: str, revision: int, chain: Chain[Any] | None, contradictions: Sequence[str]) -> Report:
        """What is reported of it; with the experiments that closed the loop, where there were any."""
        ...
