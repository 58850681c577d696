"""A raw file of vibrated dwells analysed: fitted, and what is left traced."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

from markupsafe import Markup

from tumble.app.measurement import Measurement
from tumble.app.section_report import section_report
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.verdict import Judgement, Model, Outcome, Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.vibration.document import document, fit_document
from tumble.calibrations.methods.vibration.entry import VERSION, entry
from tumble.calibrations.methods.vibration.fit import VibrationFit
from tumble.calibrations.methods.vibration.loop import VibrationDeclared, VibrationLoop
from tumble.calibrations.methods.vibration.method import METHOD
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.sections import sections_beside_values
from tumble.calibrations.methods.vibration.table import VibrationTable
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.explained import Explained
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class VibrationAnalysed:
    """A raw file and what the declared model says of it. Fits `tumble.app.analysed.Analysed`."""

    measurement: Measurement
    provenance: Provenance
    declared: VibrationDeclared
    limits: tuple[LimitCheck, ...] = ()
    """Of the values to use."""

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
        """What was odd in the run."""
        return self.declared.observations.warnings

    @property
    def verdict(self) -> Verdict:
        """How the unit stands against the limits of its programme."""
        return Verdict(judged=self.model, parameters=tuple(map(self._judged, self.limits)))

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        result = self.as_json()
        return Entry(
            method=METHOD.name,
            method_version=VERSION,
            result=result,
            parameters=result["parameters"],
            limits=self.limits,
            verdict=self.verdict,
        )

    def in_short(self) -> Sequence[str]:
        """Dwells and residual, in a line."""
        residual_ug = self.declared.model.residual_rms
        rows = len(self.declared.observations)
        if residual_ug is None:
            return (Message("{rows} dwells", rows=rows),)
        residual = format_number(residual_ug, "µg")
        return (Message("{rows} dwells, residual {residual} r.m.s.", rows=rows, residual=residual),)

    def details(self) -> Sequence[str]:
        """The same with the coefficients that the dwells do not tell."""
        unseen = [name for name, each in self.parameters.items() if each.value is None]
        told = Message("not told by these dwells: {names}", names=series(unseen)) if unseen else ""
        return tuple(filter(None, [*self.in_short(), told]))

    def figure(self) -> Markup:
        """Nothing is drawn of the declared model alone."""
        return Markup("")

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the verdict."""
        return fit_document(self.declared) | self._beside()

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
class VibrationTraced(VibrationAnalysed):
    """The same with the loop closed. Fits `tumble.app.analysed.Traced`."""

    loop: VibrationLoop
    loop_warnings: tuple[str, ...] = ()
    shows_values: bool = False

    @property
    def explained(self) -> Explained[VibrationTable, VibrationFit]:
        """What the loop rests on."""
        return self.loop.explained

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
    def rows(self) -> VibrationObservations:
        """The rows without gross errors."""
        return self.loop.observations

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        found = entry(self.loop)
        return replace(found, result={**found.result, **self._beside()}, limits=self.limits, verdict=self.verdict)

    def sections(self) -> Sequence[Section]:
        """What was found, before and after, and what to measure next."""
        return tuple(sections_beside_values(self.loop))

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the closed loop under `loop`."""
        return super().as_json() | {"loop": self.loop_json()}

    def loop_json(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`, with the verdict."""
        return document(self.loop) | self._beside()

    def planned(self, experiments: tuple[Experiment, ...]) -> Self:
        """The same with what to measure next."""
        return replace(self, loop=replace(self.loop, experiments=experiments))

    def refitted(self, analysed: VibrationAnalysed) -> Self:  # noqa: ARG002  # nothing of the fit is drawn at random
        """The same: another fit of the same rows gives the same."""
        return self

    def report(
        self,
        record_id: str,
        revision: int,  # noqa: ARG002  # the page says which record it is of
        chain: Chain[Any] | None,
        contradictions: Sequence[str],
    ) -> str:
        """The report, one HTML page."""
        return section_report(METHOD.title, self, record_id, chain, contradictions)
