"""Runs of one parameter by the temperatures that they were made at: repeats carry no numbers of their own."""

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.clusters import as_they_come
from tumble.calibrations.core.repeats import PureError, labels, pure_error
from tumble.calibrations.methods.temperature.effects import DRIFT, run_effects
from tumble.calibrations.methods.temperature.scene import RunScene
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.effect import Variable
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.linear_loop import LinearExplained, rms
from tumble.calibrations.tracing.noise import Memory
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.within import Within, lies_within, too_few, trace_within
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class RunTable(Table):
    """One parameter, a row for each temperature reached from one side."""

    visits: int = 0
    """How many runs the rows are means of, where they are; else 0."""

    @property
    def runs(self) -> RunScene:
        """The rows as effects see them."""
        assert isinstance(self.scene, RunScene), "run_table makes it"
        return self.scene

    def counted_blocks(self, variable: Variable, count: int) -> Message:
        """So many blocks of a variable; what are settings elsewhere are temperatures here."""
        if variable in ("angle", "acceleration", "direction"):
            return Message.counted("{count} temperature", "{count} temperatures", count=count)
        return super().counted_blocks(variable, count)

    def blocks(self, variable: Variable) -> NDArray[np.int64]:
        """Distinct temperatures, whichever way they were reached; of the order, the runs."""
        if variable in ("time", "order"):
            return np.argsort(np.argsort(self.runs.order))
        return self.runs.at

    @property
    def fewest_rows(self) -> int:
        """As of any table; all the more where temperatures are too few, as rows from two sides are no more of them."""
        fewest = super().fewest_rows
        return fewest if len(self.runs.known_degc) >= fewest else max(fewest, self.rows + 1)

    @property
    def not_traced(self) -> str:
        """Why nothing is looked for; empty where it is."""
        known, fewest = len(self.runs.known_degc), super().fewest_rows
        if known == self.rows and not self.visits:
            return too_few(self.rows, fewest, Message.counted("{count} row", "{count} rows", count=self.rows))
        return too_few(known, fewest, self.counted_blocks("angle", known), self.visits or self.rows)


@dataclass(frozen=True, kw_only=True)
class Settled:
    """One parameter, its repeats taken together."""

    table: RunTable
    values: FloatArray
    """Of every run, free of what drifted between repeats, shape (runs,)."""
    number: NDArray[np.int64]
    """Row of the table of each run."""
    within: Within | None

    @property
    def drift(self) -> tuple[EffectFound, ...]:
        """What was found between repeats."""
        return () if self.within is None else self.within.effects

    @property
    def scatter(self) -> FloatArray:
        """What every run differs by from the mean of its row, shape (runs,)."""
        return np.asarray(self.values - _means(self.values, self.number)[self.number])

    @property
    def pure_error(self) -> PureError | None:
        """From the repeats; None where there are none."""
        if not self.table.visits:
            return None
        return pure_error(self.values, self.number, np.ones(len(self.values)))

    def residual(self, explained: LinearExplained[RunTable]) -> FloatArray:
        """What is left of every run, shape (runs,)."""
        return np.asarray(explained.best.residual[self.number] + self.scatter)

    def with_repeats(self, missed: float) -> float:
        """Error of a run, from that of its temperature and the scatter of repeats."""
        return float(np.hypot(missed, rms(self.scatter)))


def settled_runs(scene: RunScene, values: FloatArray, unit: str) -> Settled:
    """Take runs at one temperature, reached from one side, together."""
    number = as_they_come(labels(scene.at, scene.direction))
    if number.max() + 1 == len(number):
        return Settled(table=run_table(scene, values, unit), values=values, number=np.arange(len(values)), within=None)
    within = None
    if lies_within(scene.order, number):
        drifts = [effect for effect in run_effects(unit) if effect.name == DRIFT]
        within = trace_within(scene, number, values, unit, drifts)
        values = np.asarray(values - within.shift)
    first = np.unique(number, return_index=True)[1]
    means = RunScene(
        temperature_degc=_means(scene.temperature_degc, number),
        order=_means(scene.order, number),
        direction=scene.direction[first],
    )
    table = replace(run_table(means, _means(values, number), unit), visits=len(values))
    if within is not None:
        table = replace(table, effects=tuple(effect for effect in table.effects if effect.name != DRIFT))
    return Settled(table=table, values=values, number=number, within=within)


def _means(values: FloatArray, number: NDArray[np.int64]) -> FloatArray:
    return np.asarray(np.bincount(number, weights=values) / np.bincount(number))


def run_table(scene: RunScene, values: FloatArray, unit: str) -> RunTable:
    """The runs of one parameter as a table that may be traced."""
    rows = len(values)
    return RunTable(
        model=Linear(functions=np.ones((rows, 1))),
        output=values,
        unit=unit,
        weights=np.ones(rows),
        scene=scene,
        effects=run_effects(unit),
        structures=(),
        memory=Memory(modes=np.empty((rows, 0))),
    )
