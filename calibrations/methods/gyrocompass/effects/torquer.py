"""Effects of the torquer: the reported rate is not that which it makes."""

from typing import Final

import numpy as np

from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.tracing.effect import Effect, plain, single
from tumble.messages import Message

TORQUER_EFFECTS: Final[tuple[Effect[GyrocompassScene], ...]] = (
    Effect(
        name=Message.named("torquer_scale", "torquer scale factor error"),
        belongs_to="unit",
        depends_on="angle",
        symbol="k S; the drift is stated as reported, k in it",
        source="IEEE Std 813, torquer scale factor",
        forms=lambda scene: single(scene.in_rows(scene.earth_deg_h)),
        report=plain("torquer_scale", "fraction"),
    ),
    Effect(
        name=Message.named("torquer_asymmetry", "torquer asymmetry"),
        belongs_to="unit",
        depends_on="rate",
        symbol="k |S|",
        source="IEEE Std 813, torquer asymmetry",
        forms=lambda scene: single(scene.in_rows(np.abs(scene.rate_deg_h))),
        report=plain("torquer_asymmetry", "fraction"),
    ),
    Effect(
        name=Message.named("torquer_square", "torquer nonlinearity of second order"),
        belongs_to="unit",
        depends_on="rate",
        symbol="q S²",
        source="IEEE Std 813, torquer nonlinearity",
        forms=lambda scene: single(scene.in_rows(scene.rate_deg_h**2)),
        report=plain("torquer_square", "1/(°/h)"),
    ),
    Effect(
        name=Message.named("settling", "incomplete settling"),
        belongs_to="daq",
        depends_on="order",
        symbol="f (S_previous - S)",
        source="dwell begun before the levelling loop has settled",
        forms=lambda scene: single(scene.in_rows(scene.left_over_deg_h)) if scene.left_over_deg_h.any() else (),
        report=plain("settling", "fraction"),
    ),
)
