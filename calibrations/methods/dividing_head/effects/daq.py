"""Effects of the voltmeter."""

from collections.abc import Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Effect, Form, Quantity, plain, scan, single, with_scanned
from tumble.messages import Message


def _sine(scene: Scene, period_v: float) -> Form:
    """A sine of the voltage with any phase."""
    phase = 2 * np.pi * scene.output_v / period_v
    return Form(
        columns=np.column_stack([np.sin(phase), np.cos(phase)]),
        scanned={"period_V": period_v},
    )


def _periods_v(scene: Scene) -> Sequence[float]:
    """From the span of the output (a longer wave is next to a parabola and a cubic) down to an eighth of it."""
    span_v = float(np.ptp(scene.output_v))
    return tuple((span_v / np.arange(1.0, 8.01, 0.125)).tolist()) if span_v > 0 else ()


def _amplitude(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
    amplitude = float(np.hypot(*coefficients))
    along = coefficients / amplitude
    uncertainty = float(np.sqrt(along @ covariance @ along))
    return {"amplitude": Quantity(value=amplitude, standard_uncertainty=uncertainty, unit="V")}


def _step(scene: Scene, threshold_v: float) -> Form:
    """An offset above a threshold."""
    return Form(columns=(scene.output_v > threshold_v).astype(float)[:, None], scanned={"threshold_V": threshold_v})


_MOST_THRESHOLDS = 150


def _thresholds_v(scene: Scene) -> Sequence[float]:
    """Between every two neighbouring outputs, or as many of these places as matter."""
    output_v = np.sort(scene.output_v)
    gaps = np.flatnonzero(np.diff(output_v) > np.ptp(output_v) / 1000.0)
    between = (output_v[gaps] + output_v[gaps + 1]) / 2
    picked = np.unique(np.linspace(0, len(between) - 1, min(len(between), _MOST_THRESHOLDS)).astype(int))
    return tuple(between[picked].tolist()) if len(between) else ()


def _latency(scene: Scene) -> Sequence[Form]:
    """The voltage is that of an angle which the head has left by so much: an error of -velocity times latency."""
    velocity_deg_s = scene.observations.velocity_deg_s
    if velocity_deg_s is None or not velocity_deg_s.any():
        return ()
    return single(-scene.slope_v_per_deg * velocity_deg_s)


DAQ_EFFECTS: tuple[Effect[Scene], ...] = (
    Effect(
        name=Message.named("settling", "incomplete settling"),
        belongs_to="daq",
        symbol="f (u_previous - u)",
        source="dwell begun before the reading has settled",
        forms=lambda scene: single(scene.left_over_v) if scene.left_over_v.any() else (),
        report=plain("settling", "fraction"),
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
        report=with_scanned(plain("step", "V"), threshold_V="V"),
        at=_step,
    ),
    Effect(
        name=Message.named("latency", "latency"),
        belongs_to="daq",
        symbol="angle error -ω t_l",
        source="reading late by a fixed time while the head moves",
        forms=_latency,
        report=plain("latency", "s"),
    ),
)
