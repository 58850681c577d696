"""Effects that turn with the base, and of what is stated of it: g-sensitive drift, tilt sensor, latitude."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.geometry import up_rate
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.tracing.effect import Effect, Form, plain, single
from tumble.messages import Message


def _latitude(scene: GyrocompassScene) -> Sequence[Form]:
    """ωη of the true latitude for that of the stated one."""
    change = -np.tan(np.deg2rad(scene.observations.latitude_deg)) * np.deg2rad(1.0)
    return single(scene.in_rows(change * scene.earth_deg_h))


def _leaning(scene: GyrocompassScene, times: FloatArray) -> Sequence[Form]:
    return single(scene.in_rows(times)) if np.any(times) else ()


def _tilt_scale(scene: GyrocompassScene) -> Sequence[Form]:
    return _leaning(scene, up_rate(scene.observations.latitude_deg) * np.arcsin(scene.sin_tilt))


def _tilt_bias(scene: GyrocompassScene) -> Sequence[Form]:
    """A bias of the tilt sensor shows in its own readings; in the rates it is a drift."""
    if not scene.with_tilts:
        return ()
    per_degree = np.deg2rad(1.0) * np.sqrt(1.0 - scene.sin_tilt**2)
    return single(scene.in_rows(up_rate(scene.observations.latitude_deg) * per_degree, per_degree))


PLATFORM_EFFECTS: Final[tuple[Effect[GyrocompassScene], ...]] = (
    Effect(
        name=Message.named("latitude", "error of the stated latitude"),
        belongs_to="stand",
        depends_on="angle",
        symbol="φ + d",
        source="Meleshko, Kornejchuk, Skudneva 2008, equation 9",
        forms=_latitude,
        report=plain("latitude", "deg"),
    ),
    Effect(
        name=Message.named("g_unbalance", "g-sensitive drift"),
        belongs_to="unit",
        depends_on="angle",
        symbol="K sin γ",
        source="IEEE Std 813, g-sensitive drift rate",
        forms=lambda scene: _leaning(scene, scene.sin_tilt),
        report=plain("g_unbalance", "°/h/g"),
    ),
    Effect(
        name=Message.named("tilt_scale", "scale factor error of the tilt sensor"),
        belongs_to="unit",
        depends_on="angle",
        symbol="ωζ k γ",
        source="Meleshko, Kornejchuk, Skudneva 2008, equation 9",
        forms=_tilt_scale,
        report=plain("tilt_scale", "fraction"),
    ),
    Effect(
        name=Message.named("tilt_bias", "bias of the tilt sensor"),
        belongs_to="unit",
        depends_on="order",
        symbol="γ + b; ωζ (sin(γ + b) - sin γ)",
        source="Meleshko, Kornejchuk, Skudneva 2008, equation 9",
        forms=_tilt_bias,
        report=plain("tilt_bias", "deg"),
    ),
)
