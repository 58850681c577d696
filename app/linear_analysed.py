"""Raw files of one unit analysed by a method whose closed loop is linear: what is the same for every such method.

A method derives from both classes and adds its own words: `in_short`, `details` and `sections`.
"""

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

from tumble.app.measurement import Measurement
from tumble.app.section_report import section_report
from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.method import Method
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.core.provenance import LimitCheck, Provenance
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.core.view import Drawn, Section
from tumble.calibrations.records.entry import NOT_JUDGED, Entry
from tumble.calibrations.report.document import Report
from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.document import SCHEMA, effect_json, experiment_json
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.linear_loop import LinearExplained, as_stated, model_json, rms, stated


@dataclass(frozen=True, kw_only=True)
class LinearLoop:
    """What was found. Fits `tumble.calibrations.tracing.chain.ClosedLoop`."""

    effects: tuple[EffectFound, ...]
    unit: str
    """Of the output."""
    held_out_rms: float | None = None


@dataclass(frozen=True, kw_only=True)
class LinearAnalysed(ABC):
    """Raw files, and what the declared model says of them. Fits `tumble.app.analysed.Analysed`."""

    method: ClassVar[Method]
    units: ClassVar[Mapping[str, str]]
    """Of the parameters, by name."""
    output_unit: ClassVar[str]
    """Of what is measured, and so of the residual."""

    measurement: Measurement
    provenance: Provenance
    explained: LinearExplained[Any]
    limits: tuple[LimitCheck, ...] = ()
    model: Model = Model.DECLARED
    warnings: tuple[str, ...] = ()
    verdict: Verdict = NOT_JUDGED

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return as_stated(self.explained.before)

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        return self._entry(self.as_json())

    @abstractmethod
    def in_short(self) -> Sequence[str]:
        """How well the values describe the rows, in a line or two."""

    @abstractmethod
    def details(self) -> Sequence[str]:
        """The same one by one."""

    def figure(self) -> Drawn | None:
        """Nothing is drawn unless the method does it."""
        return None

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`."""
        fit = ModelFit(parameters=self.parameters, residual_rms=None, held_out_rms=None)
        return {"schema": "tumble.fit/1", "method": self.method.name, **model_json(fit, self.output_unit)}

    def _entry(self, document: dict[str, Any]) -> Entry:
        fit = document.get("augmented", document)
        return Entry(
            method=self.method.name,
            method_version=self.method.version,
            result=document,
            parameters=fit["parameters"],
            verdict=self.verdict,
        )


@dataclass(frozen=True, kw_only=True)
class LinearTraced(LinearAnalysed):
    """The same with the loop closed. Fits `tumble.app.analysed.Traced`."""

    next_experiment: tuple[Experiment, ...] = ()
    loop_warnings: tuple[str, ...] = ()
    shows_values: bool = False

    @abstractmethod
    def sections(self) -> Sequence[Section]:
        """What is shown of the closed loop, the answer first."""

    @cached_property
    def loop(self) -> LinearLoop:
        """What was found."""
        return LinearLoop(effects=self.explained.effects(self.explained.best), unit=self.output_unit)

    @cached_property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, with what was found taken into account."""
        return stated(self.explained, self.explained.best, self.units)

    @property
    def rows(self) -> Rows:
        """The rows that the loop was closed on."""
        return self.measurement.observations

    @property
    def entry(self) -> Entry:
        """The result as the store takes it."""
        return self._entry(self.loop_json())

    def as_json(self) -> dict[str, Any]:
        """The result as `tumble.fit/1`, with the closed loop under `loop`."""
        return {**super().as_json(), "loop": self.loop_json()}

    def loop_json(self) -> dict[str, Any]:
        """The result as `tumble.loop/1`."""
        residual_rms = rms(self.explained.best.residual)
        fit = ModelFit(parameters=self.parameters, residual_rms=residual_rms, held_out_rms=None)
        return {
            "schema": SCHEMA,
            "method": self.method.name,
            "rows": rows_json(self.rows),
            "effects": [effect_json(each) for each in self.loop.effects],
            "augmented": model_json(fit, self.output_unit),
            "next_experiment": [experiment_json(each) for each in self.next_experiment],
        }

    def planned(self, experiments: tuple[Experiment, ...]) -> Self:
        """The same with what to measure next."""
        return replace(self, next_experiment=experiments)

    def refitted(self, analysed: LinearAnalysed) -> Self:  # noqa: ARG002  # nothing of the fit is drawn at random
        """The same: another fit of the same rows gives the same."""
        return self

    def report(self, record_id: str, revision: int, chain: Chain[Any] | None, contradictions: Sequence[str]) -> Report:
        """What is reported of it."""
        return section_report(self.method, self, record_id, revision, chain, contradictions)
