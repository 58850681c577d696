"""Effects of the voltmeter."""

from collections.abc import Sequence

import numpy as np

from calibrations.effects.effect import Effect, Form, Quantity, plain, single, with_scanned
from calibrations.effects.scene import Scene
from calibrations.geometry import FloatArray


def _nonlinearity(scene: Scene) -> Sequence[Form]:
    """A sine of the voltage with any phase; periods from four times the span down to an eighth of it."""
    span_v = float(np.ptp(scene.output_v))
    if span_v <= 0:
        return ()
    return tuple(
        Form(
            columns=np.column_stack([np.sin(2 * np.pi * scene.output_v / p), np.cos(2 * np.pi * scene.output_v / p)]),
            scanned={"period_V": p},
        )
        for p in (span_v / np.arange(0.25, 8.01, 0.125)).tolist()
    )


def _amplitude(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
    amplitude = float(np.hypot(*coefficients))
    along = coefficients / amplitude
    uncertainty = float(np.sqrt(along @ covariance @ along))
    return {"amplitude": Quantity(value=amplitude, standard_uncertainty=uncertainty, unit="V")}


def _range_step(scene: Scene) -> Sequence[Form]:
    """An offset above a threshold, tried at evenly spaced places within the span of the output."""
    inner = np.quantile(scene.output_v, np.linspace(0.02, 0.98, 65))
    thresholds = np.unique(inner)
    return tuple(
        Form(columns=(scene.output_v > threshold).astype(float)[:, None], scanned={"threshold_V": threshold})
        for threshold in thresholds.tolist()
    )


DAQ_EFFECTS = (
    Effect(
        name="settling",
        belongs_to="daq",
        symbol="f (u_previous - u)",
        source="dwell begun before the reading has settled",
        forms=lambda scene: single(scene.left_over_v) if scene.left_over_v.any() else (),
        report=plain("settling", ""),
    ),
    Effect(
        name="daq_nonlinearity",
        belongs_to="daq",
        symbol="A sin(2π u/P + p)",
        source="integral nonlinearity of the converter",
        forms=_nonlinearity,
        report=with_scanned(_amplitude, period_V="V"),
    ),
    Effect(
        name="range_step",
        belongs_to="daq",
        symbol="s where u > u_t",
        source="autoranging",
        forms=_range_step,
        report=with_scanned(plain("step", "V"), threshold_V="V"),
    ),
)
