"""A further method, which exists in these tests alone: how late a clock is, a constant by declaration."""

from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.rows import Rows, column
from tumble.calibrations.core.screening import without_missing
from tumble.calibrations.core.table import read_rows
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.document import SCHEMA, effect_json
from tumble.calibrations.tracing.effect import Effect, plain, single
from tumble.calibrations.tracing.linear_loop import explain_linear, model_json, rms, stated
from tumble.calibrations.tracing.noise import Memory
from tumble.calibrations.tracing.sentences import findings
from tumble.calibrations.tracing.table import Table

UNITS = {"offset": "s"}


@dataclass(frozen=True, kw_only=True)
class ClockRows(Rows):
    settings: ClassVar = ("clock_h",)
    outputs: ClassVar = ("late_s",)

    clock_h: np.ndarray = column("clock_h", needed=True, required=True)
    late_s: np.ndarray | None = column("late_s", needed=True)


@dataclass(frozen=True, kw_only=True)
class ClockScene:
    elapsed_h: np.ndarray
    hours: None = None

    @property
    def rows(self):
        return len(self.elapsed_h)


RATE = Effect(
    name="rate",
    belongs_to="unit",
    symbol="r t",
    source="a clock that goes too fast or too slow",
    forms=lambda scene: single(scene.elapsed_h),
    report=plain("rate_s_per_h", "s/h"),
    depends_on="order",
)


@dataclass(frozen=True, kw_only=True)
class ClockResult:
    rows: ClockRows
    explained: object
    warnings: tuple = ()

    @property
    def parameters(self):
        return stated(self.explained, self.explained.best, UNITS)

    def document(self):
        best = self.explained.best
        fit = ModelFit(parameters=self.parameters, residual_rms=rms(best.residual), held_out_rms=None)
        return {
            "schema": SCHEMA,
            "method": "clock",
            "rows": {"used": len(self.rows)},
            "effects": [effect_json(effect) for effect in self.explained.effects(best)],
            "augmented": model_json(fit, "s"),
        }

    def sections(self):
        found = findings(self.explained.effects(self.explained.best))
        rows = [(each.name, each.coefficients) for each in found]
        yield Section(title="What makes it late", headings=("effect", "coefficient"), rows=rows, brief=True)

    def entry(self):
        document = self.document()
        parameters = document["augmented"]["parameters"]
        verdict = Verdict(judged=Model.DECLARED, parameters=())
        return Entry(method="clock", method_version=1, result=document, parameters=parameters, verdict=verdict)


@dataclass(frozen=True)
class Clock:
    name: str = "clock"
    version: int = 1
    title: str = "A clock against a better one"
    columns: str = "a clock (clock_h, late_s)"
    headline: str = ""

    def reads(self, header, numbers):
        return {"clock_h", "late_s"} <= set(header)

    def hint(self, header, numbers):
        return ""

    def close_loop(self, paths: list[Path]):
        rows = without_missing(read_rows(paths[0], ClockRows))
        count = len(rows)
        table = Table(
            model=Linear(functions=np.ones((count, 1))),
            output=rows.late_s,
            unit="s",
            weights=np.ones(count),
            scene=ClockScene(elapsed_h=rows.clock_h),
            effects=(RATE,),
            structures=(),
            memory=Memory(modes=np.empty((count, 0))),
        )
        return ClockResult(rows=rows, explained=explain_linear(table, UNITS))


METHOD = Clock()
