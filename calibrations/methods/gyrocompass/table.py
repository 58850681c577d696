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
from tumble.calibrations.tracing.noise import MODES, Memory, scaled_levels
from tumble.calibrations.tracing.table import Extensible, View

_MANY_POSITIONS: Final = 8
"""From so many positions of a base on a shape must hold among positions; of fewer every dwell counts by itself."""

_SPARE_MODES: Final = 4
"""So many fewer modes of a wandering drift than dwells there are, and not fewer than so many."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassTable(Extensible):
    """Rows are the rate and, where that is used, the sine of the tilt of each dwell in turn."""

    scene: GyrocompassScene
    known: FloatArray
    """What is taken off the output beside the earth rate at the anchor, shape (rows,)."""

    @property
    def observations(self) -> GyrocompassObservations:
        """The dwells in use."""
        return self.scene.observations

    @property
    def bases(self) -> int:
        """On how many bases the platform stood."""
        return _bases(self.scene)

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
        known, own = self.observations.base_numbers, rows.base_numbers
        anew = leans(rows) if set(own) - set(known) else Lean(cosine=np.zeros(len(rows)), sine=np.zeros(len(rows)))
        for base in set(own) & set(known):
            first = int(np.argmax(known == base))
            anew.cosine[own == base], anew.sine[own == base] = (
                self.scene.lean.cosine[first],
                self.scene.lean.sine[first],
            )
        return anew

    def functions(self, view: View) -> FloatArray:
        """The functions of the declared model, shape (rows, functions)."""
        assert isinstance(view, GyrocompassScene), "it is a view of this table"
        return functions(view, self.bases)

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


def functions(scene: GyrocompassScene, bases: int) -> FloatArray:
    """Of each row what sin α0, cos α0 and the drift are multiplied by, then A and B of so many bases, shape (rows, n).

    The lean of any further base is taken as given.
    """
    heading = heading_functions(scene.delta_rad, scene.observations.latitude_deg, scene.lean)
    rates = scene.in_rows(np.column_stack([heading, np.ones(scene.dwells)]))
    if not scene.with_tilts:
        return rates
    its = scene.observations.bases[:, None] == np.arange(bases)
    tilts = np.column_stack([its * np.cos(scene.delta_rad)[:, None], its * np.sin(scene.delta_rad)[:, None]])
    return np.column_stack([rates, scene.in_rows(np.zeros_like(tilts), tilts)])


def _bases(scene: GyrocompassScene) -> int:
    return int(scene.observations.bases.max(initial=0)) + 1


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
    model = Gyrocompass(functions=functions(blank, _bases(blank)))
    theta = model.fitted(compress(model.functions, measured(blank), weights))
    return seen_from(replace(blank, theta=theta), weights, np.zeros(blank.rows))


def measured(scene: GyrocompassScene) -> FloatArray:
    """The rates and the sines of the tilts, shape (rows,)."""
    rows = scene.observations
    if rows.tilt_gamma_deg is None:
        return scene.in_rows(rows.rate_deg_h)
    return scene.in_rows(rows.rate_deg_h, np.sin(np.deg2rad(rows.tilt_gamma_deg)))


def seen_from(scene: GyrocompassScene, weights: FloatArray, known: FloatArray) -> GyrocompassTable:
    """Dwells as a table that is anchored at the α0 of a scene, with what is known of the rows taken off."""
    anchor_rad = float(scene.theta[ALPHA0])
    model = Gyrocompass(functions=functions(scene, _bases(scene)), anchor_rad=anchor_rad)
    drawn = {
        each.name: forms[0].columns for each in GYROCOMPASS_EFFECTS if each.random and (forms := each.forms(scene))
    }
    return GyrocompassTable(
        model=model,
        output=measured(scene) - model.functions[:, :HEADING] @ direction(anchor_rad) - known,
        unit="°/h",
        weights=weights,
        scene=scene,
        known=known,
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
    """A constant and cosines over the run, along which the drift wanders and a tilt does not, shape (rows, n).

    There are nearly as many as dwells, lest the steps of a strong walk from dwell to dwell pass for white noise. Beside
    a walk the drift is its mean over the dwells: the cosines have none, however unevenly the dwells lie in the run.
    """
    hours, count = scene.dwell_hours, min(MODES, scene.dwells - _SPARE_MODES)
    if hours is None or count < _SPARE_MODES or not np.ptp(hours) > 0:
        return np.empty((scene.rows, 0))
    phase = np.pi * np.outer((hours - hours.min()) / np.ptp(hours), np.arange(1, count + 1))
    cosines = np.sqrt(2.0) * np.cos(phase)
    waves = np.column_stack([np.ones(scene.dwells), cosines - cosines.mean(axis=0)])
    return scene.in_rows(waves) * np.sqrt(weights)[:, None]
