"""What a unit rectifies of random vibration with a given spectrum: VRE = ∫ VRC(f) G(f) df."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_concise
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.vibration.effects.curved import magnification
from tumble.calibrations.methods.vibration.loop import VibrationLoop
from tumble.calibrations.methods.vibration.observations import AXES
from tumble.calibrations.methods.vibration.profile import Profile
from tumble.calibrations.tracing.effect import Quantity
from tumble.messages import Message

SCHEMA: Final = "tumble.prediction/1"
_POINTS: Final = 20_000
"""Of the integral where there is a resonance."""
_NEAR: Final = 0.7
"""Above this part of a resonance without damping nothing is predicted: there its damping decides."""


@dataclass(frozen=True, kw_only=True)
class Predicted:
    """What is rectified of a spectrum along one axis."""

    profile: Profile
    axis: str
    value_ug: float | None
    """None where the coefficient of the axis is not told."""
    standard_uncertainty_ug: float | None
    beyond: bool = False
    """Whether a part of the spectrum lies beyond the frequencies that were measured."""
    reason: str = ""

    def as_json(self) -> dict[str, Any]:
        """As results have it."""
        said = {
            "profile": self.profile.name,
            "rms_g": self.profile.rms_g,
            "axis": self.axis,
            "value_ug": self.value_ug,
            "standard_uncertainty_ug": self.standard_uncertainty_ug,
            "beyond_measured_frequencies": self.beyond,
        }
        return said | ({"reason": self.reason} if self.reason else {})


@dataclass(frozen=True, kw_only=True)
class PredictedShown:
    """The same as it is shown."""

    predicted: Predicted
    warnings: tuple[str, ...] = ()
    title: str = Message("Rectification of random vibration")

    def document(self) -> dict[str, Any]:
        """The result as `tumble.prediction/1`."""
        return {"schema": SCHEMA, "method": "vibration", **self.predicted.as_json(), "warnings": list(self.warnings)}

    def sections(self) -> Sequence[Section]:
        """What is predicted, in a sentence or two."""
        found, profile = self.predicted, self.predicted.profile
        if found.value_ug is None or found.standard_uncertainty_ug is None:
            said = Message("nothing is predicted along axis {axis}: {reason}", axis=found.axis, reason=found.reason)
        else:
            said = Message(
                "{profile} ({rms:.3g} g r.m.s.) along axis {axis}: {value}",
                profile=profile.name,
                rms=profile.rms_g,
                axis=found.axis,
                value=format_concise(found.value_ug, found.standard_uncertainty_ug, "µg"),
            )
        beyond = [Message("A part of the spectrum lies beyond the frequencies that were measured.")]
        return (Section(title=self.title, lines=[said, *(beyond if found.beyond else ())], brief=True),)


def predicted(loop: VibrationLoop, profile: Profile, axis: str = "i", level_uncertainty: float = 0.0) -> Predicted:
    """Predict the rectification of random vibration along an axis.

    Along the input axis a resonance and a fourth order that were found are taken into account, for gravity across it.
    `level_uncertainty` is the relative standard uncertainty of the r.m.s. level of the vibration to come.
    """
    coefficient = loop.augmented.parameters[f"k_{axis}{axis}"]
    if coefficient.value is None or coefficient.standard_uncertainty is None:
        return Predicted(
            profile=profile, axis=axis, value_ug=None, standard_uncertainty_ug=None, reason=coefficient.reason
        )
    found = {str(effect.name): effect.coefficients for effect in loop.effects} if axis == AXES[0] else {}
    natural_hz = found["frequency_response"]["natural_hz"].value if "frequency_response" in found else np.inf
    fourth = found["k_iiii"]["k_iiii"] if "k_iiii" in found else Quantity(value=0.0, standard_uncertainty=0.0, unit="")
    square, moment = _weighted_square(profile, natural_hz), 3.0 * profile.mean_square_g2**2
    value = coefficient.value * square + fourth.value * moment
    parts = (
        coefficient.standard_uncertainty * square,
        (fourth.standard_uncertainty or 0.0) * moment,
        2.0 * level_uncertainty * value,
    )
    low_hz, high_hz = _measured_hz(loop)
    return Predicted(
        profile=profile,
        axis=axis,
        value_ug=value,
        standard_uncertainty_ug=float(np.linalg.norm(parts)),
        beyond=profile.within(low_hz, high_hz) < (1.0 - 1e-6) * profile.mean_square_g2,
    )


def _weighted_square(profile: Profile, natural_hz: float) -> float:
    """∫ H² G df, in g²; beyond the part of a resonance where damping decides, as there."""
    if np.isinf(natural_hz):
        return profile.mean_square_g2
    frequency_hz = np.geomspace(float(profile.f_hz[0]), float(profile.f_hz[-1]), _POINTS)
    gain: FloatArray = magnification(np.minimum(frequency_hz, _NEAR * natural_hz), natural_hz) ** 2
    return float(np.trapezoid(gain * profile.density(frequency_hz), frequency_hz))


def _measured_hz(loop: VibrationLoop) -> tuple[float, float]:
    """Lowest and highest frequency of the sines of a table; nothing where there are none."""
    frequency_hz = loop.explained.table.scene.frequency_hz
    moved = frequency_hz[frequency_hz > 0.0]
    return (float(moved.min()), float(moved.max())) if len(moved) else (np.inf, 0.0)
