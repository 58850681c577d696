"""Effects of the converter that reads an output: a wave of the voltage, and a step between two ranges."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.tracing.effect import Effect, Form, Quantity, Seen, plain, scan, with_scanned
from tumble.calibrations.tracing.penalties import SIMPLER
from tumble.messages import Message


def converter_effects(
    output_v: Callable[[Seen], FloatArray], step_key: str, most_thresholds: int
) -> tuple[Effect[Seen], ...]:
    """The two effects of a converter.

    Parameters
    ----------
    output_v
        What it read in each row of a scene, by the fit, shape (rows,), in volts.
    step_key
        Key of the contract under which the height of the step is reported.
    most_thresholds
        How many places of the step are tried at most.
    """

    def sine(scene: Seen, period_v: float) -> Form:
        return _sine(output_v(scene), period_v)

    def step(scene: Seen, threshold_v: float) -> Form:
        return _step(output_v(scene), threshold_v)

    return (
        Effect(
            name=Message.named("daq_nonlinearity", "nonlinearity of the DAQ"),
            belongs_to="daq",
            symbol="A sin(2π u/P + p)",
            source="integral nonlinearity of the converter",
            given=True,
            forms=scan(sine, lambda scene: _periods_v(output_v(scene))),
            report=with_scanned(_amplitude, period_V="V"),
            at=sine,
        ),
        Effect(
            name=Message.named("range_step", "step between ranges"),
            belongs_to="daq",
            symbol="s where u > u_t",
            source="autoranging",
            given=True,
            forms=scan(step, lambda scene: _thresholds_v(output_v(scene), most_thresholds)),
            report=with_scanned(plain(step_key, "V"), threshold_V="V"),
            at=step,
        ),
    )


def _sine(output_v: FloatArray, period_v: float) -> Form:
    """A sine of the voltage with any phase."""
    phase = 2 * np.pi * output_v / period_v
    is_long = np.ptp(output_v) < _FEW_WAVES * period_v
    return Form(
        columns=np.column_stack([np.sin(phase), np.cos(phase)]),
        scanned={"period_V": period_v},
        penalty=2.0 * SIMPLER * is_long,  # it may be a parabola and a cubic: two coefficients
    )


_FEW_WAVES: Final = 1.5
"""Over the span of the output fewer of them are next to a parabola and a cubic."""


def _periods_v(output_v: FloatArray) -> Sequence[float]:
    """From the span of the output down to a sixteenth of it; a longer wave is nothing but a parabola and a cubic."""
    span_v = float(np.ptp(output_v))
    return tuple((span_v / np.arange(1.0, 16.01, 0.125)).tolist()) if span_v > 0 else ()


def _amplitude(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
    amplitude = float(np.hypot(*coefficients))
    along = coefficients / amplitude
    uncertainty = float(np.sqrt(along @ covariance @ along))
    return {"amplitude": Quantity(value=amplitude, standard_uncertainty=uncertainty, unit="V")}


def _step(output_v: FloatArray, threshold_v: float) -> Form:
    """An offset above a threshold."""
    return Form(columns=(output_v > threshold_v).astype(float)[:, None], scanned={"threshold_V": threshold_v})


def _thresholds_v(output_v: FloatArray, most: int) -> Sequence[float]:
    """Between every two neighbouring outputs, or as many of these places as matter."""
    ordered_v = np.sort(output_v)
    gaps = np.flatnonzero(np.diff(ordered_v) > np.ptp(ordered_v) / 1000.0)
    between = (ordered_v[gaps] + ordered_v[gaps + 1]) / 2
    picked = np.unique(np.linspace(0, len(between) - 1, min(len(between), most)).astype(int))
    return tuple(between[picked].tolist()) if len(between) else ()
