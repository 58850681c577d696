"""How much of an effect the declared model cannot absorb, and the amplitude at which that is a given amount."""

from dataclasses import astuple, dataclass

import numpy as np

from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.scene import Effect, Run, Unit, respond

_STEPS = (1e-3, 1e-3, 1e-3, 1e-3, 1e-3, 1e-2)
"""Steps of u0, kx, ky, kz, kxy (V and g) and alpha0 (degrees) in the central differences."""


@dataclass(frozen=True, kw_only=True)
class Sight:
    """What a run with this unit reads without any effect, and what small changes of its parameters do to that."""

    run: Run
    unit: Unit
    plain_v: FloatArray
    tangent: FloatArray
    """Orthonormal columns: the changes that the six declared parameters can absorb."""

    def shown_v(self, effect: Effect, amplitude: float) -> float:
        """Norm of what the effect alone does outside the tangent space, in volts."""
        difference_v = respond(self.run, self.unit, ((effect, amplitude),)) - self.plain_v
        return float(np.linalg.norm(difference_v - self.tangent @ (self.tangent.T @ difference_v)))

    def amplitude_for(self, effect: Effect, wanted_v: float, largest: float) -> tuple[float, float] | None:
        """Solve for the amplitude at which the effect shows as `wanted_v`, by secants through zero.

        Returns the amplitude and what it shows; None where that takes more than `largest`, the physical maximum.
        """
        amplitude = effect.sign * largest / 10.0
        shown_v = self.shown_v(effect, amplitude)
        for _ in range(4):
            if shown_v * largest <= wanted_v * abs(amplitude):
                return None
            if abs(shown_v / wanted_v - 1.0) < 0.01:
                break
            amplitude *= wanted_v / shown_v
            shown_v = self.shown_v(effect, amplitude)
        return amplitude, shown_v


def sight(run: Run, unit: Unit) -> Sight:
    """Differentiate the declared model numerically at the truth."""
    at = np.array(astuple(unit))
    slopes = [respond(run, _unit(at + move), ()) - respond(run, _unit(at - move), ()) for move in np.diag(_STEPS)]
    columns = np.stack(slopes, axis=1)
    norms = np.linalg.norm(columns, axis=0)
    left, singular, _ = np.linalg.svd(columns[:, norms > 0.0] / norms[norms > 0.0], full_matrices=False)
    return Sight(run=run, unit=unit, plain_v=respond(run, unit, ()), tangent=left[:, singular > 1e-9])


def _unit(values: FloatArray) -> Unit:
    return Unit(**dict(zip(Unit.__dataclass_fields__, values.tolist(), strict=True)))
