"""Effects of the voltmeter: one converter reads all channels."""

from collections.abc import Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.tracing.effect import Effect, Form, Quantity, plain, scan, single, with_scanned
from tumble.messages import Message

_MOST_THRESHOLDS = 100


def _all_v(scene: TriadScene) -> FloatArray:
    """Output of every row by the fit, shape (rows,)."""
    return np.asarray(scene.output_v.T.ravel())


def _sine(scene: TriadScene, period_v: float) -> Form:
    """A sine of the voltage with any phase."""
    phase = 2 * np.pi * _all_v(scene) / period_v
    return Form(columns=np.column_stack([np.sin(phase), np.cos(phase)]), scanned={"period_V": period_v})


def _periods_v(scene: TriadScene) -> Sequence[float]:
    """From the span of the outputs down to an eighth of it."""
    span_v = float(np.ptp(_all_v(scene)))
    return tuple((span_v / np.arange(1.0, 8.01, 0.125)).tolist()) if span_v > 0 else ()


def _amplitude(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
    amplitude = float(np.hypot(*coefficients))
    along = coefficients / amplitude
    uncertainty = float(np.sqrt(along @ covariance @ along))
    return {"amplitude": Quantity(value=amplitude, standard_uncertainty=uncertainty, unit="V")}


def _step(scene: TriadScene, threshold_v: float) -> Form:
    """An offset above a threshold."""
    return Form(columns=(_all_v(scene) > threshold_v).astype(float)[:, None], scanned={"threshold_V": threshold_v})


def _thresholds_v(scene: TriadScene) -> Sequence[float]:
    """Between every two neighbouring outputs, or as many of these places as matter."""
    output_v = np.sort(_all_v(scene))
    gaps = np.flatnonzero(np.diff(output_v) > np.ptp(output_v) / 1000.0)
    between = (output_v[gaps] + output_v[gaps + 1]) / 2
    picked = np.unique(np.linspace(0, len(between) - 1, min(len(between), _MOST_THRESHOLDS)).astype(int))
    return tuple(between[picked].tolist()) if len(between) else ()


DAQ_EFFECTS: tuple[Effect[TriadScene], ...] = (
    Effect(
        name=Message.named("settling", "incomplete settling"),
        belongs_to="daq",
        symbol="f (u_previous - u)",
        source="dwell begun before the reading has settled",
        forms=lambda scene: single(scene.left_over_v.T.ravel()) if scene.left_over_v.any() else (),
        report=plain("value", "fraction"),
    ),
    Effect(
        name=Message.named("daq_nonlinearity", "nonlinearity of the DAQ"),
        belongs_to="daq",
        symbol="A sin(2π u/P + p)",
        source="integral nonlinearity of the converter",
        forms=scan(_sine, _periods_v),
        report=with_scanned(_amplitude, period_V="V"),
        at=_sine,
    ),
    Effect(
        name=Message.named("range_step", "step between ranges"),
        belongs_to="daq",
        symbol="s where u > u_t",
        source="autoranging",
        forms=scan(_step, _thresholds_v),
        report=with_scanned(plain("value", "V"), threshold_V="V"),
        at=_step,
    ),
)
