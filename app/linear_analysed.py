"""Raw files of one unit analysed by a method whose closed loop is linear.

A method derives from both classes and adds its own words: `in_short`, `details` and `sections`.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Self

from tumble.app.method_analysed import MethodAnalysed, MethodTraced
from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.verdict import Model
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
class LinearAnalysed(MethodAnalysed):
    """Raw files, and what the declared model says of them."""

    units: ClassVar[Mapping[str, str]]
    """Of the parameters, by name."""

    explained: LinearExplained[Any]

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return as_stated(self.explained.before)

    def fit_document(self) -> dict[str, Any]:
        """The declared model as `tumble.fit/1`."""
        return {"schema": "tumble.fit/1", "method": self.method.name, **self._declared}

    @property
    def _declared(self) -> dict[str, Any]:
        fit = ModelFit(
            parameters=as_stated(self.explained.before),
            residual_rms=rms(self.explained.before.residual),
            held_out_rms=None,
        )
        return model_json(fit, self.output_unit)


@dataclass(frozen=True, kw_only=True)
class LinearTraced(LinearAnalysed, MethodTraced):
    """The same with the loop closed."""

    next_experiment: tuple[Experiment, ...] = ()

    @cached_property
    def loop(self) -> LinearLoop:
        """What was found."""
        return LinearLoop(effects=self.explained.effects(self.explained.best), unit=self.output_unit)

    @property
    def model(self) -> Model:
        """Whose values are to be used."""
        return Model.AUGMENTED if self.loop.effects or self.explained.unexplained else Model.DECLARED

    @cached_property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, with what was found taken into account."""
        return stated(self.explained, self.explained.best, self.units)

    @property
    def rows(self) -> Rows:
        """The rows that the loop was closed on."""
        return self.measurement.observations

    def loop_document(self) -> dict[str, Any]:
        """The closed loop as `tumble.loop/1`."""
        residual_rms = rms(self.explained.best.residual)
        fit = ModelFit(parameters=self.parameters, residual_rms=residual_rms, held_out_rms=None)
        return {
            "schema": SCHEMA,
            "method": self.method.name,
            "rows": rows_json(self.rows),
            "effects": [effect_json(each) for each in self.loop.effects],
            "declared": self._declared,
            "augmented": model_json(fit, self.output_unit),
            "next_experiment": [experiment_json(each) for each in self.next_experiment],
        }

    def planned(self, experiments: tuple[Experiment, ...]) -> Self:
        """The same with what to measure next."""
        return replace(self, next_experiment=experiments)
