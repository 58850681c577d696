"""Raw files analysed by a method that has a loop of its own: what is the same for every such method.

A method derives from both classes and adds its documents and its sections.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Self

from tumble.app.measurement import Measurement
from tumble.app.section_report import section_report
from tumble.calibrations.core.method import Method
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.calibrations.core.view import Drawn, Section
from tumble.calibrations.records.entry import Entry, loop_entry
from tumble.calibrations.report.document import Report
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.closed import ClosedLoop, DeclaredFit
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.explained import Explained
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class LoopAnalysed(ABC):
    """A raw file and what the declared model says of it. Fits `tumble.app.analysed.Analysed`."""

    method: ClassVar[Method]
    output_unit: ClassVar[str]
    """Of the residual."""

    measurement: Measurement
    provenance: Provenance
    declared: DeclaredFit
    limits: tuple[LimitCheck, ...] = ()
    """Of the values to use."""

    @abstractmethod
    def fit_document(self) -> dict[str, Any]:
        """The declared model as `tumble.fit/1`."""

    @property
    def model(self) -> Model:
        """Whose values are to be used."""
        return Model.DECLARED

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return self.declared.model.parameters

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be asked of the run, and what was odd in it."""
        return (*self.declared.doubts, *self.declared.observations.warnings)

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        return Verdict(judged=self.model, parameters=tuple(map(self._judged, self.limits)))

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

    def in_short(self) -> Sequence[str]:
        """Dwells and residual, in a line."""
        residual, rows = self.declared.model.residual_rms, len(self.declared.observations)
        if residual is None:
            return (Message.counted("{count} dwell", "{count} dwells", count=rows),)
        shown = format_number(residual, self.output_unit)
        return (
            Message.counted(
                "{count} dwell, residual {residual} r.m.s.",
                "{count} dwells, residual {residual} r.m.s.",
                count=rows,
                residual=shown,
            ),
        )

    def details(self) -> Sequence[str]:
        """The same with the parameters that the dwells do not tell."""
        unseen = [name for name, each in self.parameters.items() if each.value is None]
        told = Message("not told by these dwells: {names}", names=series(unseen)) if unseen else ""
        return tuple(filter(None, [*self.in_short(), told]))

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
class LoopTraced(LoopAnalysed):
    """The same with the loop closed. Fits `tumble.app.analysed.Traced`."""

    loop: ClosedLoop[Any, Any, Any]
    loop_warnings: tuple[str, ...] = ()
    shows_values: bool = False

    @abstractmethod
    def loop_document(self) -> dict[str, Any]:
        """The closed loop as `tumble.loop/1`."""

    @abstractmethod
    def sections(self) -> Sequence[Section]:
        """What is shown of the closed loop, the answer first."""

    @property
    def explained(self) -> Explained[Any, Any] | None:
        """What the loop rests on; None of a table in doubt."""
        return None if self.loop.doubts else self.loop.explained

    @property
    def next_experiment(self) -> tuple[Experiment, ...]:
        """What to measure next."""
        return self.loop.experiments

    @property
    def model(self) -> Model:
        """Whose values are to be used."""
        return Model.AUGMENTED if self.loop.effects else Model.DECLARED

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return self.loop.augmented.parameters

    @property
    def rows(self) -> Rows:
        """The rows without gross errors."""
        fitted: DeclaredFit = self.loop.declared_fit
        return fitted.observations

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

    def planned(self, experiments: tuple[Experiment, ...]) -> Self:
        """The same with what to measure next."""
        return replace(self, loop=replace(self.loop, experiments=experiments))

    def refitted(self, analysed: LoopAnalysed) -> Self:  # noqa: ARG002  # nothing of the fit is drawn at random
        """The same: another fit of the same rows gives the same."""
        return self

    def report(self, record_id: str, revision: int, chain: Chain[Any] | None, contradictions: Sequence[str]) -> Report:
        """What is reported of it."""
        return section_report(self.method, self, record_id, revision, chain, contradictions)
