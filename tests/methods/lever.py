"""The analysis of the lever, see `lever_at_stand`, and its job: all that a method brings to commands."""

from dataclasses import dataclass

from lever_at_stand import NAME, UNITS, VERSION, ThereAndBack, reads, traceable, usable

from tumble.app.available import Available, Offer
from tumble.app.linear_analysed import LinearAnalysed, LinearTraced
from tumble.calibrations.core.table import read_rows
from tumble.calibrations.core.view import Section
from tumble.calibrations.tracing.experiments import next_experiments
from tumble.calibrations.tracing.linear_loop import explain_linear, rms
from tumble.procedures.programmes import load_programme


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


METHOD = Lever()


class LeverAnalysed(LinearAnalysed):
    method, units, output_unit = METHOD, UNITS, "V"

    def in_short(self):
        return [f"{len(self.measurement.observations)} rows"]

    def details(self):
        return [f"residual {rms(self.explained.before.residual):.2e} V rms"]


class LeverTraced(LeverAnalysed, LinearTraced):
    def sections(self):
        found = [(each.name, " or ".join(each.also_possible)) for each in self.loop.effects]
        yield Section(title="What bends the lever", headings=("effect", "or"), rows=found, brief=True)
        yield Section(title="What next", lines=[each.why for each in self.next_experiment], brief=True)


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
        return LeverAnalysed(measurement=measurement, provenance=origin, explained=explained)

    def trace(self, analysed):
        return LeverTraced(**vars(analysed))

    def suggested(self, traced):
        explained = traced.explained
        return next_experiments(explained.table, explained.trace, explained.close, [ThereAndBack()])

    def available(self, stand, rows, attended):
        return Available(offers=(Offer(probe=ThereAndBack(), programme=load_programme("lever-back")),))


JOB = LeverJob()
