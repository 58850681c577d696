"""Vibrated dwells as a table that may be traced."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import labels
from tumble.calibrations.core.solutions import smallest_solution
from tumble.calibrations.methods.vibration.effects import VIBRATION_EFFECTS
from tumble.calibrations.methods.vibration.effects.curved import CURVED, Curved
from tumble.calibrations.methods.vibration.effects.unnamed import unnamed
from tumble.calibrations.methods.vibration.model import COEFFICIENTS, functions
from tumble.calibrations.methods.vibration.observations import VibrationObservations
from tumble.calibrations.methods.vibration.scene import Point, VibrationScene
from tumble.calibrations.methods.vibration.weights import row_weights
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.effect import Variable
from tumble.calibrations.tracing.noise import Memory
from tumble.calibrations.tracing.table import Extensible, View, memory_of

_GRAIN: Final = 2
"""Decimals of products and levels by which settings are told apart, in g² and g."""

_MODES: Final = 0.6
"""Cosines over the run for each row: the rest outputs of the mountings take the slowest ones of a wandering."""
_REFINED: Final = 3
_BETWEEN: Final = 9
"""Values of an effect that is not linear, between the neighbours of the best one so far."""


@dataclass(frozen=True, kw_only=True)
class VibrationTable(Extensible):
    """Dwells at rest and under vibration, with what may be seen in them besides."""

    scene: VibrationScene

    @property
    def observations(self) -> VibrationObservations:
        """The dwells in use."""
        return self.scene.observations

    def view(self, rows: VibrationObservations, theta: FloatArray) -> VibrationScene:  # noqa: ARG002  # it is linear
        """Dwells as effects see them."""
        return replace(self.scene, observations=rows, history=rows)

    def functions(self, view: View) -> FloatArray:
        """Mean products, and the rest outputs; mountings beyond those that this table has room for have none."""
        assert isinstance(view, VibrationScene), "it is a view of this table"
        return functions(view.observations, self.declared.shape[1] - COEFFICIENTS)

    def axes_in(self, view: View) -> tuple[Axis, ...]:
        """Drive, time and temperature, as far as they vary in the view."""
        assert isinstance(view, VibrationScene), "it is a view of this table"
        return unnamed(view)

    def blocks(self, variable: Variable) -> NDArray[np.int64]:
        """Settings; dwells for time; realisations."""
        if variable in ("time", "order", "temperature"):
            return np.arange(self.rows)
        if variable == "realisation":
            return self.scene.realisation
        return settings(self.scene)

    def at(self, points: Mapping[str, Point]) -> "VibrationTable":
        """The same with effects that are not linear linearised elsewhere."""
        return replace(traceable(replace(self.scene, points=points)), effects=self.effects)

    def without(self, *names: str) -> "VibrationTable":
        """The same in which some effects are not looked for."""
        return replace(self, effects=tuple(effect for effect in self.effects if str(effect.name) not in names))

    def with_room(self, mountings: int) -> "VibrationTable":
        """The same with room for so many mountings more, of which it has no row."""
        room = np.zeros((self.rows, mountings))
        return replace(self, model=Linear(functions=np.column_stack([self.declared, room])))


def settings(scene: VibrationScene) -> NDArray[np.int64]:
    """Number of the setting of each row: mounting, level, products and frequency."""
    products = np.round(scene.products_g2, _GRAIN).T
    octaves = np.round(np.log2(np.maximum(scene.frequency_hz, 1e-3)), 1)
    rates = np.round(scene.observations.filled("sub_rad_s"), 1)
    return labels(scene.observations.mountings, np.round(scene.level_g, _GRAIN), octaves, rates, *products)


def traceable(scene: VibrationScene) -> VibrationTable:
    """Dwells as a table, effects that are not linear as they are linearised in the scene."""
    rows = scene.observations
    weights = row_weights(rows)
    return VibrationTable(
        model=Linear(functions=functions(rows)),
        output=rows.output_ug,
        unit="µg",
        weights=weights,
        scene=scene,
        effects=VIBRATION_EFFECTS,
        structures=(),
        axes=unnamed(scene),
        memory=_memory(scene, weights),
    )


def _memory(scene: VibrationScene, weights: FloatArray) -> Memory:
    """Along what noise may be correlated, without what the rest outputs of the mountings follow of a slow wandering.

    Of that no row shows anything; left in, its determinant would count against a walk as if it had been seen.
    """
    memory = memory_of(VIBRATION_EFFECTS, scene, weights, _MODES)
    at_rest = functions(scene.observations)[:, COEFFICIENTS:] * np.sqrt(weights)[:, None]
    span = np.linalg.qr(at_rest)[0]
    return replace(memory, modes=memory.modes - span @ (span.T @ memory.modes))


def vibration_table(
    rows: VibrationObservations, history: VibrationObservations, reference_temperature_degc: float = 23.0
) -> VibrationTable:
    """Prepare rows; `history` holds those too that are not used, in the order in which they were taken."""
    scene = VibrationScene(observations=rows, history=history, reference_temperature_degc=reference_temperature_degc)
    plain = traceable(scene)
    return plain.at(points_beside(plain, ()))


def points_beside(table: VibrationTable, columns: Sequence[FloatArray]) -> dict[str, Point]:
    """Where each effect that is not linear fits best as the only one beside columns, if the rows can show it."""
    return {
        curved.name: point for curved in CURVED.values() if (point := best_point(table, curved, columns)) is not None
    }


def best_point(table: VibrationTable, curved: Curved, columns: Sequence[FloatArray]) -> Point | None:
    """Of the values that are tried, and what is between the neighbours of the best one, the one that fits best."""
    values = sorted(curved.tried(table.scene))
    for _ in range(_REFINED):
        tried = list(_tried(table, curved, values, columns))
        if not tried:
            return None
        best = min(range(len(tried)), key=lambda place: tried[place][0])
        around = values[max(best - 1, 0) : best + 2]
        values = np.linspace(around[0], around[-1], _BETWEEN).tolist()
        values = [value for value in values if value != 0.0]
    return tried[best][1]


def _tried(
    table: VibrationTable, curved: Curved, values: Sequence[float], columns: Sequence[FloatArray]
) -> Iterator[tuple[float, Point]]:
    """Every value with the coefficients beside it, and what that leaves."""
    root = np.sqrt(table.weights)
    for value in values:
        shares = curved.shares(table.scene, value)
        model = table.declared.copy()
        model[:, :COEFFICIENTS] += shares.matrix
        whole = np.column_stack([model, *columns]) * root[:, None]
        output = (table.output - shares.own) * root
        theta = smallest_solution(whole, output)
        left = float(np.sum((output - whole @ theta) ** 2))
        yield left, Point(value=value, coefficients=theta[:COEFFICIENTS])
