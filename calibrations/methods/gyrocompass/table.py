"""A gyrocompass as a table that may be traced: the rate of each dwell and its tilt, each with its weight."""

from dataclasses import dataclass, replace
from typing import Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.compression import compress
from tumble.calibrations.core.repeats import labels, visits
from tumble.calibrations.methods.gyrocompass.effects import GYROCOMPASS_EFFECTS
from tumble.calibrations.methods.gyrocompass.effects.drift import WALK
from tumble.calibrations.methods.gyrocompass.effects.unnamed import unnamed
from tumble.calibrations.methods.gyrocompass.geometry import heading_functions
from tumble.calibrations.methods.gyrocompass.lean import Lean, leans
from tumble.calibrations.methods.gyrocompass.model import ALPHA0, HEADING, Gyrocompass, direction
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.methods.gyrocompass.weights import rate_variance, rate_variances, tilt_variance
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.effect import Variable
from tumble.calibrations.tracing.noise import Memory, scaled_levels, slow_modes
from tumble.calibrations.tracing.table import Extensible, View

_MANY_POSITIONS: Final = 8
"""From so many positions of a base on a shape must hold among positions; of fewer every dwell counts by itself."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassTable(Extensible):
    """Rows are the rate and, where that is used, the sine of the tilt of each dwell in turn."""

    scene: GyrocompassScene

    @property
    def observations(self) -> GyrocompassObservations:
        """The dwells in use."""
        return self.scene.observations

    @property
    def rates(self) -> NDArray[np.bool_]:
        """Which rows are rates, shape (rows,)."""
        return np.asarray(np.arange(self.rows) % self.scene.outputs == 0)

    def view(self, rows: GyrocompassObservations, theta: FloatArray) -> GyrocompassScene:
        """Dwells as effects see them with these parameters; a base that this table has leans as it does here."""
        return GyrocompassScene(
            observations=rows,
            theta=theta[: len(self.scene.theta)],
            lean=self._lean(rows),
            with_tilts=self.scene.with_tilts,
            reference_temperature_degc=self.scene.reference_temperature_degc,
        )

    def _lean(self, rows: GyrocompassObservations) -> Lean:
        return self.scene.lean if rows is self.observations else leans(rows)

    def functions(self, view: View) -> FloatArray:
        """The functions of the declared model, shape (rows, functions)."""
        assert isinstance(view, GyrocompassScene), "it is a view of this table"
        return functions(view)

    def axes_in(self, view: View) -> tuple[Axis, ...]:
        """Channels, each with every variable that varies in the view."""
        assert isinstance(view, GyrocompassScene), "it is a view of this table"
        return unnamed(view)

    @property
    def further_weights(self) -> FloatArray:
        """Those of a further dwell."""
        return np.array([np.median(self.weights[self.rates]), *self.weights[1 : self.scene.outputs]])

    def blocks(self, variable: Variable) -> NDArray[np.int64]:
        """Positions of rates and of tilts; dwells for time; realisations; visits of a temperature."""
        scene, outputs = self.scene, self.scene.outputs
        if variable == "realisation":
            return np.repeat(scene.realisation, outputs)
        if variable == "temperature" and scene.temperature_k is not None:
            return np.repeat(visits(scene.temperature_k, scene.realisation), outputs)
        positions = self.observations.positions
        if variable in ("time", "order") or len(np.unique(positions)) < _MANY_POSITIONS:
            return np.repeat(np.arange(scene.dwells), outputs)
        return labels(np.repeat(positions, outputs), np.tile(np.arange(outputs), scene.dwells))


def functions(scene: GyrocompassScene) -> FloatArray:
    """Of each row what sin α0, cos α0 and the drift are multiplied by, then A and B of each base, shape (rows, n)."""
    heading = heading_functions(scene.delta_rad, scene.observations.latitude_deg, scene.lean)
    rates = scene.in_rows(np.column_stack([heading, np.ones(scene.dwells)]))
    if not scene.with_tilts:
        return rates
    base = scene.observations.bases
    its = base[:, None] == np.arange(base.max() + 1)
    tilts = np.column_stack([its * np.cos(scene.delta_rad)[:, None], its * np.sin(scene.delta_rad)[:, None]])
    return np.column_stack([rates, scene.in_rows(np.zeros_like(tilts), tilts)])


def gyrocompass_table(
    observations: GyrocompassObservations, reference_temperature_degc: float = 23.0
) -> GyrocompassTable:
    """Prepare a table, with the earth rate by the declared model taken off."""
    rate, tilt = rate_variance(observations), tilt_variance(observations)
    blank = GyrocompassScene(
        observations=observations,
        theta=np.zeros(2),
        lean=leans(observations),
        with_tilts=rate is not None and tilt is not None,
        reference_temperature_degc=reference_temperature_degc,
    )
    ratio = rate / tilt if rate is not None and tilt is not None else 1.0
    weights = blank.in_rows(1.0 / rate_variances(observations), np.full(blank.dwells, ratio))
    model = Gyrocompass(functions=functions(blank))
    theta = model.fitted(compress(model.functions, measured(blank), weights))
    return seen_from(replace(blank, theta=theta), weights)


def measured(scene: GyrocompassScene) -> FloatArray:
    """The rates and the sines of the tilts, shape (rows,)."""
    rows = scene.observations
    if rows.tilt_gamma_deg is None:
        return scene.in_rows(rows.rate_deg_h)
    return scene.in_rows(rows.rate_deg_h, np.sin(np.deg2rad(rows.tilt_gamma_deg)))


def seen_from(scene: GyrocompassScene, weights: FloatArray) -> GyrocompassTable:
    """Dwells as a table that is anchored at the α0 of a scene."""
    anchor_rad = float(scene.theta[ALPHA0])
    model = Gyrocompass(functions=functions(scene), anchor_rad=anchor_rad)
    drawn = {
        each.name: forms[0].columns for each in GYROCOMPASS_EFFECTS if each.random and (forms := each.forms(scene))
    }
    return GyrocompassTable(
        model=model,
        output=measured(scene) - model.functions[:, :HEADING] @ direction(anchor_rad),
        unit="°/h",
        weights=weights,
        scene=scene,
        effects=GYROCOMPASS_EFFECTS,
        structures=(),
        axes=unnamed(scene),
        walk=WALK,
        memory=Memory(
            modes=_modes(scene, weights),
            levels={name: scaled_levels(columns, weights) for name, columns in drawn.items()},
        ),
    )


def _modes(scene: GyrocompassScene, weights: FloatArray) -> FloatArray:
    """Along what the drift wanders; a tilt does not."""
    rates = scene.in_rows(np.ones(scene.dwells))
    return np.asarray(slow_modes(scene.hours, weights) * rates[:, None])
