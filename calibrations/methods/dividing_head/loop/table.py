"""A table of an accelerometer, fitted with the declared model, ready to be explained."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.repeats import visits
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.effects.unnamed import unnamed
from tumble.calibrations.methods.dividing_head.fit import fit_given_alpha0
from tumble.calibrations.methods.dividing_head.identifiability import determined_without_kxy
from tumble.calibrations.methods.dividing_head.joint import Joint
from tumble.calibrations.methods.dividing_head.loop.declared import Accelerometer
from tumble.calibrations.methods.dividing_head.model import (
    ALPHA0,
    BASIS_SIZE,
    PARAMETERS,
    basis,
    coefficients,
    coefficients_jacobian,
)
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import distinct_settings
from tumble.calibrations.tracing.components import Axis
from tumble.calibrations.tracing.effect import Effect, Variable
from tumble.calibrations.tracing.table import Extensible, View, memory_of


@dataclass(frozen=True, kw_only=True)
class DividingHeadTable(Extensible):
    """The table of an accelerometer."""

    joint: Joint
    scene: Scene

    @property
    def observations(self) -> Observations:
        """The rows in use."""
        return self.joint.observations

    def blocks(self, variable: Variable) -> NDArray[np.int64]:
        """Settings; the order of the rows for time; realisations; visits of a temperature."""
        if variable in ("time", "order"):
            return np.arange(self.rows)
        if variable == "realisation":
            return self.scene.realisation
        if variable == "temperature" and self.scene.temperature_k is not None:
            return visits(self.scene.temperature_k, self.scene.realisation)
        return distinct_settings(self.observations)

    def view(self, rows: Observations, theta: FloatArray) -> Scene:
        """Rows as effects see them with these parameters."""
        return scene_of(rows, theta, self.scene.reference_temperature_degc)

    def functions(self, view: View) -> FloatArray:
        """The ten functions of the pose, shape (rows, 10)."""
        assert isinstance(view, Scene), "it is a view of this table"
        return basis(view.observations)

    def axes_in(self, view: View) -> tuple[Axis, ...]:
        """Channels, each with every variable that varies in the view."""
        assert isinstance(view, Scene), "it is a view of this table"
        return unnamed(view)


def dividing_head_table(
    joint: Joint, effects: Sequence[Effect[Scene]], reference_temperature_degc: float = 23.0
) -> DividingHeadTable:
    """Prepare a table fitted with the declared model.

    Where alpha0 rests on kxy alone, an effect that is not yet known may have moved it by many degrees: then effects are
    linearised at alpha0 = 0, which is nearer the truth.
    """
    fit = joint.fit
    if fit.alpha0_fitted and not determined_without_kxy(joint.compressed, fit)[ALPHA0]:
        fit = fit_given_alpha0(joint.compressed, 0.0)
    return _table(joint, effects, scene_of(joint.observations, fit.theta, reference_temperature_degc))


def relinearised(table: DividingHeadTable, theta: FloatArray) -> DividingHeadTable:
    """The same table, linearised at better parameters."""
    scene = scene_of(table.joint.observations, theta, table.scene.reference_temperature_degc)
    return _table(table.joint, table.effects, scene)


def _table(joint: Joint, effects: Sequence[Effect[Scene]], scene: Scene) -> DividingHeadTable:
    functions = joint.basis[:, :BASIS_SIZE]
    return DividingHeadTable(
        model=Accelerometer(
            functions=functions, alpha0_fitted=joint.fit.alpha0_fitted, linearised_at_deg=scene.alpha0_deg
        ),
        output=joint.observations.output_v,
        unit="V",
        weights=joint.weights,
        scene=scene,
        effects=tuple(effects),
        structures=(),
        axes=unnamed(scene),
        memory=memory_of(effects, scene, joint.weights),
        joint=joint,
    )


def scene_of(observations: Observations, theta: FloatArray, reference_temperature_degc: float = 23.0) -> Scene:
    """Rows as effects see them, for given declared parameters."""
    theta = theta[: len(PARAMETERS)]
    functions = basis(observations)
    return Scene(
        observations=observations,
        alpha0_deg=float(theta[ALPHA0]),
        output_v=np.asarray(functions @ coefficients(theta)),
        slope_v_per_deg=np.asarray(functions @ coefficients_jacobian(theta)[:, ALPHA0]),
        response_v_per_g=theta[1:4],
        product_v_per_g2=float(theta[4]),
        reference_temperature_degc=reference_temperature_degc,
    )
