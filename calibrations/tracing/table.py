"""Any table that may be traced: outputs, a declared model of them, and what may be seen besides."""

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol, Self

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_number
from tumble.calibrations.core.resolution import as_written, last_digit
from tumble.calibrations.core.solutions import SINGULAR
from tumble.calibrations.tracing.components import Axis, Component
from tumble.calibrations.tracing.declared import Declared
from tumble.calibrations.tracing.effect import Effect, Form, Structure, Variable
from tumble.calibrations.tracing.noise import WALK, WHITE, Memory, NoiseModel, scaled_levels, slow_modes
from tumble.calibrations.tracing.sample import Sample, sample
from tumble.calibrations.tracing.variables import counted_blocks
from tumble.calibrations.tracing.whitened import Fitted
from tumble.messages import Message


class View(Protocol):
    """What every kind of scene has; its effects know the rest of it."""

    @property
    def rows(self) -> int:
        """How many there are."""
        ...

    @property
    def hours(self) -> FloatArray | None:
        """Time since the first row, in hours; None where the table has none."""
        ...


@dataclass(frozen=True, kw_only=True)
class Table:
    """Rows with a declared model, ready to be traced. What the output is, and in which unit, is its own affair."""

    model: Declared
    """The declared model of the rows as they stand."""
    output: FloatArray
    """Shape (rows,)."""
    unit: str
    """Of the output."""
    weights: FloatArray
    """Relative weight of each row, shape (rows,)."""
    scene: View
    """The rows as the effects see them."""
    effects: tuple[Effect[Any], ...]
    """The catalogue."""
    structures: tuple[Structure[Any], ...]
    """Shapes without a name that compete with it."""
    memory: Memory
    axes: tuple[Axis, ...] = ()
    """Along what there may be components without a name."""
    walk: str = WALK
    """What a random walk of the output is called in a result."""
    most_effects: int = 8
    """How many are looked for at most."""

    @property
    def rows(self) -> int:
        """Number of rows in use."""
        return len(self.output)

    @property
    def declared(self) -> FloatArray:
        """Functions of the declared model, shape (rows, functions)."""
        return self.model.functions

    @property
    def fewest_rows(self) -> int:
        """With fewer rows, three for each declared parameter and never less than six, nothing is traced."""
        return max(3 * self.model.parameters, 6)

    @cached_property
    def not_traced(self) -> str:
        """Why nothing is looked for; empty where it is."""
        if self.rows < self.fewest_rows:
            return Message.counted(
                "{count} row is too few; at least {fewest} are needed",
                "{count} rows are too few; at least {fewest} are needed",
                count=self.rows,
                fewest=self.fewest_rows,
            )
        if as_written(self.declared, self.output):
            return Message(
                "the declared model gives every output to the last digit written ({digit}); "
                "outputs with more digits would show more",
                digit=format_number(last_digit(self.output), self.unit, 1),
            )
        return ""

    def counted_blocks(self, variable: Variable, count: int) -> Message:
        """So many blocks of a variable, by what these are called: `7 settings`."""
        return counted_blocks(variable, count)

    def blocks(self, variable: Variable) -> NDArray[np.int64]:  # noqa: ARG002
        """Number of the block of each row: rows that share a value of the variable say nothing new of a shape.

        Settings for `angle`, `acceleration` and `direction`; of `time`, the order of the rows. Where a table has no
        repeats, every row is a block of its own.
        """
        return np.arange(self.rows)

    @cached_property
    def whole(self) -> Sample:
        """All rows, ready for comparison."""
        return self.sample_of(np.ones(self.rows, dtype=bool))

    def sample_of(self, kept: NDArray[np.bool_]) -> Sample:
        """Some of the rows, ready for comparison."""
        return self._sample(kept, self.memory if kept.all() else self.memory.rows(kept))

    def sample_in(self, noise: NoiseModel, kept: NDArray[np.bool_]) -> Sample:
        """The same where it is only asked about in one noise."""
        return self._sample(kept, self.memory.within(noise).rows(kept))

    def _sample(self, kept: NDArray[np.bool_], memory: Memory) -> Sample:
        model = self.model.with_functions(self.declared[kept])
        return sample(model, self.output[kept], self.weights[kept], memory)

    def deviance(self, forms: Sequence[Form], noise: NoiseModel) -> float:
        """-2 ln L of the declared model with these forms in this noise, up to a constant of the table."""
        return self.whole.whitened_fit(noise).deviance(self.fit(forms, noise))

    def deviance_beside(self, forms: Sequence[Form], noise: NoiseModel) -> Callable[[Form], float]:
        """The same as a function of one form more, where many are to be tried."""
        whitened_fit = self.whole.whitened_fit(noise)
        known = whitened_fit.split(self.whole.turned(self._columns(forms)))

        def deviance(form: Form) -> float:
            further = known.with_further(whitened_fit.split(self.whole.turned(form.columns)))
            return whitened_fit.deviance(whitened_fit.fit(further))

        return deviance

    def deviance_by_noise(self, forms: Sequence[Form]) -> Callable[[NoiseModel], float]:
        """The same as a function of the noise, where many are to be tried."""
        return self.whole.deviance_by_noise(self._columns(forms))

    def fit(self, forms: Sequence[Form], noise: NoiseModel) -> Fitted:
        """The declared model with these forms in this noise."""
        whitened_fit = self.whole.whitened_fit(noise)
        return whitened_fit.fit(whitened_fit.split(self.whole.turned(self._columns(forms))))

    def with_components(self, components: Sequence[Component]) -> Self:
        """The same where components may be noise too, with all that the declared model could as well be in them."""
        return self._with_levels(
            {each.name: scaled_levels(each.whole, self.weights, by=each.columns) for each in components}
        )

    def with_seen(self, components: Sequence[Component]) -> Self:
        """The same where what is seen of components beside the declared model may be noise: by that they are judged."""
        span = self._seen_directions
        whole = {each.name: scaled_levels(each.columns, self.weights) for each in components}
        return self._with_levels({name: level - span @ (span.T @ level) for name, level in whole.items()})

    def _with_levels(self, levels: Mapping[str, FloatArray]) -> Self:
        return replace(self, memory=self.memory.with_levels(levels))

    @cached_property
    def _seen_directions(self) -> FloatArray:
        """Orthonormal directions of the declared model, linearised at its fit, in weighted rows."""
        theta = self.fit((), WHITE).declared
        columns = (self.declared @ self.model.slopes(theta)) * np.sqrt(self.weights)[:, None]
        left, values, _ = np.linalg.svd(columns / np.linalg.norm(columns, axis=0).clip(1e-300), full_matrices=False)
        return np.asarray(left[:, values > SINGULAR * values[0]])  # of columns that depend on others there is none

    def _columns(self, forms: Sequence[Form]) -> FloatArray:
        return np.column_stack([np.empty((self.rows, 0)), *(form.columns for form in forms)])


@dataclass(frozen=True, kw_only=True)
class Extensible(Table, ABC):
    """A table to which an experiment may add rows."""

    @property
    @abstractmethod
    def observations(self) -> Any:  # noqa: ANN401  # the kind of rows of its method
        """The rows in use, of a kind of `core.rows.Rows`."""

    @abstractmethod
    def view(self, rows: Any, theta: FloatArray) -> View:  # noqa: ANN401
        """Rows as effects see them with these declared parameters."""

    @abstractmethod
    def functions(self, view: View) -> FloatArray:
        """Functions of the declared model in a view of this table, shape (rows, functions)."""

    @property
    def further_weights(self) -> FloatArray:
        """Relative weights of what further rows of observations add to the table, one for each output of a row."""
        return np.ones(1)

    def axes_in(self, view: View) -> tuple[Axis, ...]:  # noqa: ARG002
        """Along what there may be components without a name in a view of this table; unless it says so, nothing."""
        return ()


def memory_of(effects: Sequence[Effect[Any]], scene: View, weights: FloatArray, part: float = 0.25) -> Memory:
    """Along what noise can be correlated over in a table: its time, and the levels of the effects that draw some.

    In time by `part` as many cosines as rows, see `noise.slow_modes`.
    """
    drawn = {effect.name: forms[0].columns for effect in effects if effect.random and (forms := effect.forms(scene))}
    levels = {name: scaled_levels(columns, weights) for name, columns in drawn.items()}
    return Memory(modes=slow_modes(scene.hours, weights, part), levels=levels)
