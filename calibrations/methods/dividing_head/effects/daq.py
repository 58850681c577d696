"""Effects of the voltmeter."""

from collections.abc import Sequence

from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.converter import converter_effects
from tumble.calibrations.tracing.effect import Effect, Form, plain, single
from tumble.messages import Message

_MOST_THRESHOLDS = 150


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
    *converter_effects(lambda scene: scene.output_v, step_key="step", most_thresholds=_MOST_THRESHOLDS),
    Effect(
        name=Message.named("latency", "latency"),
        belongs_to="daq",
        symbol="angle error -ω t_l",
        source="reading late by a fixed time while the head moves",
        forms=_latency,
        report=plain("latency", "s"),
    ),
)
