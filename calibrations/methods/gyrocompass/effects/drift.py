"""Effects of the gyro's drift: what is added to the rate and follows time, temperature or realisation."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.tracing.effect import Effect, Form, contrasts, plain, scan, single, spread, with_scanned
from tumble.messages import Message

WALK: Final = Message.named("drift_random_walk", "random walk of the drift")
"""Drift that wanders: noise to a fit (IEEE Std 952, rate random walk)."""


def _ramp(scene: GyrocompassScene) -> Sequence[Form]:
    hours = scene.dwell_hours
    return () if hours is None or not np.ptp(hours) > 0 else single(scene.in_rows(hours))


def _warm_up(scene: GyrocompassScene, tau_s: float) -> Form:
    """Exponential in time, settled at zero."""
    assert scene.dwell_hours is not None
    decay = scene.in_rows(np.exp(-scene.dwell_hours * 3600.0 / tau_s))
    return Form(columns=decay[:, None], scanned={"tau_s": tau_s})


def _time_constants_s(scene: GyrocompassScene) -> Sequence[float]:
    """From a few dwells to most of the run."""
    hours = scene.dwell_hours
    if hours is None or not hours[-1] > 0:
        return ()
    run_s = float(hours[-1]) * 3600.0
    return tuple(np.geomspace(run_s / 40.0, run_s / 1.5, 10).tolist())


def _temperature(scene: GyrocompassScene) -> Sequence[Form]:
    temperature_k = scene.temperature_k
    return () if temperature_k is None or not np.ptp(temperature_k) > 0 else single(scene.in_rows(temperature_k))


def _realisations(scene: GyrocompassScene) -> Sequence[Form]:
    levels = int(scene.realisation.max(initial=0)) + 1
    return () if levels < 2 else (Form(columns=scene.in_rows(contrasts(levels)[scene.realisation])),)


DRIFT_EFFECTS: Final[tuple[Effect[GyrocompassScene], ...]] = (
    Effect(
        name=Message.named("drift_ramp", "ramp of the drift"),
        belongs_to="unit",
        depends_on="time",
        symbol="r t",
        source="IEEE Std 952, drift rate ramp",
        forms=_ramp,
        report=plain("drift_ramp", "°/h²"),
    ),
    Effect(
        name=Message.named("drift_warm_up", "warm-up of the drift"),
        belongs_to="unit",
        depends_on="time",
        symbol="A exp(-t/τ)",
        source="IEEE Std 528, warm-up time",
        forms=scan(_warm_up, _time_constants_s),
        report=with_scanned(plain("amplitude", "°/h"), tau_s="s"),
        at=_warm_up,
        additive=True,
    ),
    Effect(
        name=Message.named("drift_temperature", "temperature sensitivity of the drift"),
        belongs_to="unit",
        depends_on="temperature",
        symbol="c (T - 23 °C)",
        source="IEEE Std 813, drift rate temperature sensitivity",
        forms=_temperature,
        report=plain("drift_temperature", "°/h/K"),
    ),
    Effect(
        name=Message.named("realisation_drift", "drift from turn-on to turn-on"),
        belongs_to="unit",
        depends_on="realisation",
        symbol="ω_r",
        source="IEEE Std 528, turn-on to turn-on repeatability",
        forms=_realisations,
        report=spread("realisation_drift", "°/h"),
        random=True,
    ),
)
