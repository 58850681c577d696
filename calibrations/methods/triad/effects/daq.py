"""Effects of the voltmeter: one converter reads all channels."""

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.tracing.converter import converter_effects
from tumble.calibrations.tracing.effect import Effect, plain, single
from tumble.messages import Message

_MOST_THRESHOLDS = 100


def _all_v(scene: TriadScene) -> FloatArray:
    """Output of every row by the fit, shape (rows,)."""
    return scene.output_v.ravel()


DAQ_EFFECTS: tuple[Effect[TriadScene], ...] = (
    Effect(
        name=Message.named("settling", "incomplete settling"),
        belongs_to="daq",
        symbol="f (u_previous - u)",
        source="dwell begun before the reading has settled",
        forms=lambda scene: single(scene.left_over_v.ravel()) if scene.left_over_v.any() else (),
        report=plain("value", "fraction"),
    ),
    *converter_effects(_all_v, step_key="value", most_thresholds=_MOST_THRESHOLDS),
)
