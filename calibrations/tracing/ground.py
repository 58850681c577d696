"""What every explanation of a table starts from: its rows, the declared model, the scene that effects see."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

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
from calibrations.tracing.footing import Fitted
from calibrations.tracing.noise import Memory, NoiseModel, scaled_levels, slow_modes
from calibrations.tracing.sample import Sample, sample


@dataclass(frozen=True, kw_only=True)
class Ground:
    """A table, fitted with the declared model, ready to be explained."""

    joint: Joint
    scene: Scene
    effects: tuple[Effect, ...]
    """The catalogue."""
    memory: Memory

    @property
    def rows(self) -> int:
        """Number of rows in use."""
        return len(self.joint.observations)

    @property
    def declared(self) -> FloatArray:
        """The ten functions of the declared model, shape (rows, 10)."""
        return self.joint.basis[:, :BASIS_SIZE]

    @cached_property
    def whole(self) -> Sample:
        """All rows, ready for comparison."""
        return self.sample_of(np.ones(self.rows, dtype=bool))

    def sample_of(self, kept: NDArray[np.bool_]) -> Sample:
        """Some of the rows, ready for comparison."""
        model = Accelerometer(functions=self.declared[kept], alpha0_told=self.joint.fit.alpha0_fitted)
        memory = self.memory if kept.all() else self.memory.rows(kept)
        return sample(model, self.joint.observations.output_v[kept], self.joint.weights[kept], memory)

    def deviance(self, forms: Sequence[Form], noise: NoiseModel) -> float:
        """-2 ln L of the declared model with these forms in this noise, up to a constant of the table."""
        return self.whole.footing(noise).deviance(self.fit(forms, noise))

    def deviance_by_noise(self, forms: Sequence[Form]) -> Callable[[NoiseModel], float]:
        """The same as a function of the noise, where many are to be tried."""
        return self.whole.deviance_by_noise(self._columns(forms))

    def fit(self, forms: Sequence[Form], noise: NoiseModel) -> Fitted:
        """The declared model with these forms in this noise."""
        footing = self.whole.footing(noise)
        return footing.fit(footing.split(self.whole.turned(self._columns(forms))))

    def _columns(self, forms: Sequence[Form]) -> FloatArray:
        return np.column_stack([np.empty((self.rows, 0)), *(form.columns for form in forms)])


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
