"""What every explanation of a table starts from: its rows, the declared model, the scene that effects see."""

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from calibrations.effects.effect import Effect, Form
from calibrations.effects.scene import Scene
from calibrations.fit import fit_given_alpha0
from calibrations.geometry import FloatArray
from calibrations.identifiability import determined_without_kxy
from calibrations.joint import Joint
from calibrations.model import ALPHA0, BASIS_SIZE, PARAMETERS, basis, coefficients, coefficients_jacobian
from calibrations.observations import Observations
from calibrations.tracing.declared import Accelerometer
from calibrations.tracing.footing import Fitted, Footing
from calibrations.tracing.noise import Memory, NoiseModel, scaled_levels, slow_modes


@dataclass(frozen=True, kw_only=True)
class Ground:
    """A table, fitted with the declared model, ready to be explained."""

    joint: Joint
    scene: Scene
    effects: tuple[Effect, ...]
    """The catalogue."""
    memory: Memory
    _footings: dict[NoiseModel, Footing] = field(default_factory=dict, repr=False, compare=False)

    @property
    def rows(self) -> int:
        """Number of rows in use."""
        return len(self.joint.observations)

    @property
    def declared(self) -> FloatArray:
        """The ten functions of the declared model, shape (rows, 10)."""
        return self.joint.basis[:, :BASIS_SIZE]

    def footing(self, noise: NoiseModel) -> Footing:
        """The declared model in a kind of noise."""
        if noise not in self._footings:
            self._footings[noise] = self.footing_of(np.ones(self.rows, dtype=bool), noise)
        return self._footings[noise]

    def footing_of(self, kept: NDArray[np.bool_], noise: NoiseModel) -> Footing:
        """The same for some of the rows."""
        model = Accelerometer(functions=self.declared[kept], alpha0_told=self.joint.fit.alpha0_fitted)
        output_v, weights = self.joint.observations.output_v[kept], self.joint.weights[kept]
        return Footing(model, output_v, weights, self.memory.rows(kept).whitening(noise))

    def deviance(self, forms: Sequence[Form], noise: NoiseModel) -> float:
        """-2 ln L of the declared model with these forms in this noise, up to a constant of the table."""
        return self.footing(noise).deviance(self.fit(forms, noise))

    def fit(self, forms: Sequence[Form], noise: NoiseModel) -> Fitted:
        """The declared model with these forms in this noise."""
        footing = self.footing(noise)
        columns = np.column_stack([np.empty((self.rows, 0)), *(form.columns for form in forms)])
        return footing.fit(footing.split(columns))


def ground(joint: Joint, effects: Sequence[Effect], reference_temperature_degc: float = 23.0) -> Ground:
    """Prepare a table fitted with the declared model.

    Where alpha0 rests on kxy alone, an effect that is not yet known may have moved it by many degrees: then effects are
    seen from alpha0 = 0, which is nearer the truth.
    """
    fit = joint.fit
    if fit.alpha0_fitted and not determined_without_kxy(joint.compressed, fit)[ALPHA0]:
        fit = fit_given_alpha0(joint.compressed, 0.0)
    return _ground(joint, effects, scene_of(joint.observations, fit.theta, reference_temperature_degc))


def seen_anew(base: Ground, theta: FloatArray) -> Ground:
    """The same table seen from better parameters."""
    scene = scene_of(base.joint.observations, theta, base.scene.reference_temperature_degc)
    return _ground(base.joint, base.effects, scene)


def _ground(joint: Joint, effects: Sequence[Effect], scene: Scene) -> Ground:
    drawn = {effect.name: forms[0].columns for effect in effects if effect.drawn and (forms := effect.forms(scene))}
    levels = {name: scaled_levels(columns, joint.weights) for name, columns in drawn.items()}
    return Ground(
        joint=joint,
        scene=scene,
        effects=tuple(effects),
        memory=Memory(modes=slow_modes(scene.hours, joint.weights), levels=levels),
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
        reference_temperature_degc=reference_temperature_degc,
    )
