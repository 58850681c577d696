"""Raw files analysed: what is the same for every method that is shown by its sections.

`tumble.app.loop_analysed` and `tumble.app.linear_analysed` derive from both classes what a method takes from them.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

from tumble.app.measurement import Measurement
from tumble.app.measurements import check_limits
from tumble.app.section_report import section_report
from tumble.calibrations.core.method import Method
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.calibrations.core.view import Drawn, Section, drawn_first
from tumble.calibrations.records.entry import Entry, loop_entry
from tumble.calibrations.report.document import Report
from tumble.calibrations.tracing.chain import Chain
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class MethodAnalysed(ABC):
    """Raw files, and what the declared model says of them. Fits `tumble.app.analysed.Analysed`.

    Raises `InputError` where the programme limits what is no parameter.
    """

    method: ClassVar[Method]
    output_unit: ClassVar[str]
    """Of what is measured, and so of the residual."""

    measurement: Measurement
    provenance: Provenance

    def __post_init__(self) -> None:
        check_limits(self.parameters, self.measurement.programme)

    @property
    @abstractmethod
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""

    @abstractmethod
    def fit_document(self) -> dict[str, Any]:
        """The declared model as `tumble.fit/1`."""

    @abstractmethod
    def in_short(self) -> Sequence[str]:
        """How well the values describe the rows, in a line or two."""

    @abstractmethod
    def details(self) -> Sequence[str]:
        """The same one by one."""

    @property
    def model(self) -> Model:
        """Whose values are to be used."""
        return Model.DECLARED

    @property
    def limits(self) -> tuple[LimitCheck, ...]:
        """The values to use, held against the limits of the programme."""
        return check_limits(self.parameters, self.measurement.programme)

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        return Verdict(judged=self.model, parameters=tuple(map(self._judged, self.limits)))

    @property
    def warnings(self) -> tuple[str, ...]:
        """What was odd in the rows."""
        return self.measurement.observations.warnings

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        result = self.as_json()
        return Entry(
            method=self.method.name,
            method_version=self.method.version,
            result=result,
            parameters=result["parameters"],
            limits=self.limits,
            verdict=self.verdict,
        )

    def figure(self) -> Drawn | None:
        """Nothing is drawn of the declared model alone."""
        return None

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the verdict."""
        return self.fit_document() | self._beside()

    def _beside(self) -> dict[str, Any]:
        """What every document of it has: the verdict, and the stand record that was applied, where one was."""
        record = self.measurement.stand_record
        applied = {"stand_record": record.reference} if record else {}
        return {"verdict": self.verdict.as_json()} | applied

    def _judged(self, limit: LimitCheck) -> Judgement:
        parameter = self.parameters[limit.name]
        if parameter.value is None:
            return Judgement(name=limit.name, outcome=Outcome.NOT_DECIDED, reason=parameter.reason)
        reason = Message("{value:g} {unit}", value=parameter.value, unit=parameter.unit)
        return Judgement(name=limit.name, outcome=Outcome.PASS if limit.inside else Outcome.FAIL, reason=reason)


@dataclass(frozen=True, kw_only=True)
class MethodTraced(MethodAnalysed):
    """The same with the loop closed. Fits `tumble.app.analysed.Traced`."""

    loop_warnings: tuple[str, ...] = ()
    shows_values: bool = False

    @abstractmethod
    def loop_document(self) -> dict[str, Any]:
        """The closed loop as `tumble.loop/1`."""

    @abstractmethod
    def sections(self) -> Sequence[Section]:
        """What is shown of the closed loop, the answer first."""

    def figure(self) -> Drawn | None:
        """The figure of the first page of its report."""
        first = drawn_first(self.sections())
        return first.figure() if first and first.figure else None

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        found = loop_entry(self.method.name, self.method.version, self.loop_json())
        return replace(found, limits=self.limits, verdict=self.verdict)

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the closed loop under `loop`."""
        return super().as_json() | {"loop": self.loop_json()}

    def loop_json(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`, with the verdict."""
        return self.loop_document() | self._beside()

    def refitted(self, analysed: MethodAnalysed) -> Self:  # noqa: ARG002  # nothing of the fit is drawn at random
        """The same: another fit of the same rows gives the same."""
        return self

    def report(self, record_id: str, revision: int, chain: Chain[Any] | None, contradictions: Sequence[str]) -> Report:
        """What is reported of it."""
        return section_report(self.method, self, record_id, revision, chain, contradictions)
