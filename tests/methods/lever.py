"""The analysis of the lever, see `lever_at_stand`, and its job: all that a method brings to commands."""

from dataclasses import dataclass, field, replace
from functools import cached_property

from lever_at_stand import NAME, UNITS, VERSION, ThereAndBack, reads, traceable, usable

from tumble.app.available import Available, Offer
from tumble.app.measurements import check_limits
from tumble.calibrations.core.documents import rows_json
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.table import read_rows
from tumble.calibrations.core.verdict import Model, Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.records.entry import Entry
from tumble.calibrations.tracing.document import SCHEMA, effect_json, experiment_json
from tumble.calibrations.tracing.experiments import next_experiments
from tumble.calibrations.tracing.linear_loop import LinearExplained, as_stated, explain_linear, model_json, rms, stated
from tumble.procedures.programme import load_programme


@dataclass(frozen=True)
class Lever:
    name: str = NAME
    version: int = VERSION
    title: str = "A lever under its own weight"
    columns: str = "a lever (lever_deg, load_V)"
    headline: str = ""

    def reads(self, header, numbers):
        return reads(header)

    def hint(self, header, numbers):
        return ""

    def close_loop(self, paths):
        raise AssertionError("the job does it")


@dataclass(frozen=True)
class LeverLoop:
    effects: tuple
    held_out_rms: float | None = None
    unit: str = "V"


@dataclass(frozen=True, kw_only=True)
class LeverAnalysed:
    measurement: object
    provenance: object
    explained: LinearExplained
    limits: tuple = ()
    model: Model = Model.DECLARED
    warnings: tuple = ()
    verdict: Verdict = Verdict(judged=Model.DECLARED, parameters=())  # noqa: RUF009  # frozen

    @property
    def parameters(self):
        return as_stated(self.explained.before)

    def in_short(self):
        return [f"{len(self.measurement.observations)} rows"]

    def details(self):
        return [f"residual {rms(self.explained.before.residual):.2e} V rms"]

    def as_json(self):
        fit = ModelFit(parameters=self.parameters, residual_rms=None, held_out_rms=None)
        return {"schema": "tumble.fit/1", "method": NAME, **model_json(fit, "V")}


@dataclass(frozen=True, kw_only=True)
class LeverTraced(LeverAnalysed):
    next_experiment: tuple = ()
    loop_warnings: tuple = ()
    shows_values: bool = False
    asked: dict = field(default_factory=dict)

    @cached_property
    def loop(self):
        return LeverLoop(effects=self.explained.effects(self.explained.best))

    @cached_property
    def parameters(self):
        return stated(self.explained, self.explained.best, UNITS)

    @property
    def rows(self):
        return self.measurement.observations

    @property
    def entry(self):
        document = self.loop_json()
        parameters = document["augmented"]["parameters"]
        return Entry(method=NAME, method_version=VERSION, result=document, parameters=parameters, verdict=self.verdict)

    def sections(self):
        found = [(each.name, " or ".join(each.also_possible)) for each in self.loop.effects]
        yield Section(title="What bends the lever", headings=("effect", "or"), rows=found, brief=True)
        yield Section(title="What next", lines=[each.why for each in self.next_experiment], brief=True)

    def as_json(self):
        return {**super().as_json(), "loop": self.loop_json()}

    def loop_json(self):
        fit = ModelFit(parameters=self.parameters, residual_rms=rms(self.explained.best.residual), held_out_rms=None)
        return {
            "schema": SCHEMA,
            "method": NAME,
            "rows": rows_json(self.rows),
            "effects": [effect_json(each) for each in self.loop.effects],
            "augmented": model_json(fit, "V"),
            "next_experiment": [experiment_json(each) for each in self.next_experiment],
        }

    def planned(self, experiments):
        return replace(self, next_experiment=experiments)

    def refitted(self, analysed):
        return self

    def report(self, record_id, revision, chain, contradictions):
        from tumble.calibrations.report.sections import page

        return page(METHOD.title, self.provenance.serial_number, list(self.sections()), [record_id])


@dataclass(frozen=True)
class LeverJob:
    experiments: frozenset = frozenset({"lever-back"})
    stand: None = None

    def read_table(self, path):
        from lever_at_stand import LeverRows

        return usable(read_rows(path, LeverRows))

    def answered(self, rows):
        return rows

    def fit(self, measurement, origin, trials):
        explained = explain_linear(traceable(measurement.observations), UNITS)
        limits = check_limits(as_stated(explained.before), measurement.programme)
        return LeverAnalysed(measurement=measurement, provenance=origin, explained=explained, limits=limits)

    def trace(self, analysed):
        return LeverTraced(**vars(analysed))

    def suggested(self, traced):
        explained = traced.explained
        return next_experiments(explained.table, explained.trace, explained.close, [ThereAndBack()])

    def available(self, stand, rows, attended):
        return Available(offers=(Offer(probe=ThereAndBack(), programme=load_programme("lever-back")),))


METHOD, JOB = Lever(), LeverJob()
