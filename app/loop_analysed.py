"""Raw files analysed by a method that has a loop of its own.

A method derives from both classes and adds its documents and its sections.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Self

from tumble.app.method_analysed import MethodAnalysed, MethodTraced
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.rows import Rows
from tumble.calibrations.core.sentences import series
from tumble.calibrations.core.verdict import Model
from tumble.calibrations.tracing.closed import ClosedLoop, DeclaredFit
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.explained import Explained
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class LoopAnalysed(MethodAnalysed):
    """A raw file and what the declared model says of it."""

    declared: DeclaredFit

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return self.declared.model.parameters

    @property
    def warnings(self) -> tuple[str, ...]:
        """What is to be asked of the run, and what was odd in it."""
        return (*self.declared.doubts, *self.declared.observations.warnings)

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


@dataclass(frozen=True, kw_only=True)
class LoopTraced(LoopAnalysed, MethodTraced):
    """The same with the loop closed."""

    loop: ClosedLoop[Any, Any, Any]

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
        return Model.AUGMENTED if self.loop.effects or self.loop.unexplained else Model.DECLARED

    @property
    def parameters(self) -> Mapping[str, Parameter]:
        """The values to use, by name."""
        return self.loop.augmented.parameters

    @property
    def rows(self) -> Rows:
        """The rows without gross errors."""
        fitted: DeclaredFit = self.loop.declared_fit
        return fitted.observations

    def planned(self, experiments: tuple[Experiment, ...]) -> Self:
        """The same with what to measure next."""
        return replace(self, loop=replace(self.loop, experiments=experiments))
