"""Effects of the accelerometer."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.effects.curved import CLIPPING, RESPONSE
from tumble.calibrations.methods.vibration.scene import VibrationScene
from tumble.calibrations.tracing.effect import Effect, Form, Quantity, contrasts, plain, single, spread, with_scanned
from tumble.messages import Message

_IEEE: Final = "IEEE Std 1293-2018, model equation"
_KILO: Final = 1e3


def third_order(scene: VibrationScene) -> FloatArray:
    """Mean of Ai³ that vibration adds: 3 G mii; shape (rows,), in g³."""
    return np.asarray(3.0 * scene.gravity_g[:, 0] * scene.products_g2[:, 0])


def fourth_order(scene: VibrationScene) -> FloatArray:
    """The same of Ai⁴: 6 G² mii and the fourth moment, which is 1.5 mii² of a sine and 3 mii² of random vibration."""
    square = scene.products_g2[:, 0]
    moment = np.where(scene.observations.random, 3.0, 1.5) * square**2
    return np.asarray(6.0 * scene.gravity_g[:, 0] ** 2 * square + moment)


def _varies(values: FloatArray | None) -> Sequence[Form]:
    return single(values) if values is not None and np.ptp(values) > 0 else ()


def _natural(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
    """From 1/fn² in 1/kHz²."""
    inverse = float(max(coefficients[0], 1e-12))
    natural_hz = _KILO / float(np.sqrt(inverse))
    uncertainty = 0.5 * natural_hz / inverse * float(np.sqrt(covariance[0, 0]))
    return {"natural_hz": Quantity(value=natural_hz, standard_uncertainty=uncertainty, unit="Hz")}


def _realisation_bias(scene: VibrationScene) -> Sequence[Form]:
    levels = int(scene.realisation.max(initial=0)) + 1
    return () if levels < 2 else (Form(columns=contrasts(levels)[scene.realisation]),)


def after_shift(scene: VibrationScene, row: float) -> Form:
    """A step after a row of the table, to the end of the mounting that it is in."""
    number, mounting = scene.observations.row, scene.observations.mountings
    its = mounting[np.searchsorted(number, row, side="right") - 1]
    return Form(columns=((number > row) & (mounting == its)).astype(float)[:, None], scanned={"row": row})


def _shifts(scene: VibrationScene) -> Sequence[Form]:
    """After every row but the last of each mounting."""
    mounting = scene.observations.mountings
    inside = np.flatnonzero(mounting[1:] == mounting[:-1])
    return [after_shift(scene, float(row)) for row in scene.observations.row[inside]]


UNIT_EFFECTS: Final[tuple[Effect[VibrationScene], ...]] = (
    Effect(
        name=Message.named("k_iii", "third-order nonlinearity K_iii"),
        belongs_to="unit",
        symbol="3/2 K_iii G a_i²",
        source=_IEEE,
        forms=lambda scene: _varies(third_order(scene)),
        report=plain("k_iii", "µg/g³"),
    ),
    Effect(
        name=Message.named("k_iiii", "fourth-order nonlinearity K_iiii"),
        belongs_to="unit",
        symbol="K_iiii (3 G² a_i² + 3/8 a_i⁴)",
        source=_IEEE,
        forms=lambda scene: _varies(fourth_order(scene)),
        report=plain("k_iiii", "µg/g⁴"),
    ),
    Effect(
        name=Message.named("frequency_response", "resonance of the proof mass"),
        belongs_to="unit",
        depends_on="frequency",
        symbol="K_ii m_ii (H² - 1), H = 1 / (1 - (f/fn)²)",
        source="IEEE Std 1293-2018, frequency response",
        forms=RESPONSE.forms,
        report=_natural,
    ),
    Effect(
        name=Message.named("clipping", "clipping at the limit of the range"),
        belongs_to="unit",
        symbol="mean of what lies above L",
        source="mean of a clipped sine",
        forms=CLIPPING.forms,
        report=plain("limit_g", "g"),
    ),
    Effect(
        name=Message.named("after_shift", "bias shift after vibration"),
        belongs_to="unit",
        depends_on="time",
        symbol="step after row k to the end of the mounting",
        source="IEEE Std 1293-2018, bias shift by vibration",
        forms=_shifts,
        report=with_scanned(plain("step", "µg"), row=""),
        given=True,
    ),
    Effect(
        name=Message.named("bias_drift", "bias drift"),
        belongs_to="unit",
        depends_on="time",
        symbol="b t",
        source="IEEE Std 528, drift",
        forms=lambda scene: _varies(scene.hours),
        report=plain("bias_drift", "µg/h"),
    ),
    Effect(
        name=Message.named("bias_temperature", "bias temperature sensitivity"),
        belongs_to="unit",
        depends_on="temperature",
        symbol="b (T - 23 °C)",
        source="IEEE Std 1293-2018, bias temperature sensitivity",
        forms=lambda scene: _varies(scene.temperature_k),
        report=plain("bias_temperature", "µg/K"),
    ),
    Effect(
        name=Message.named("realisation_bias", "turn-on to turn-on bias"),
        belongs_to="unit",
        depends_on="realisation",
        symbol="a level for each realisation",
        source="IEEE Std 528, turn-on to turn-on",
        forms=_realisation_bias,
        report=spread("realisation_bias", "µg"),
        random=True,
    ),
)
