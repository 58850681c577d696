"""Names of effects and of instruments as words for the operator, in the language of the window.

The words of the contracts (`scale_drift`) stay what they are in tables and documents.
"""

from typing import Final

from tumble.messages import translatable, translate
from tumble.window.look.language import spoken, tr

EFFECT_NAMES: Final = {
    # the unit
    "k_xx": translatable("second-order nonlinearity k_xx"),
    "k_yy": translatable("second-order nonlinearity k_yy"),
    "k_zz": translatable("second-order nonlinearity k_zz"),
    "k_xz": translatable("cross-coupling k_xz"),
    "k_yz": translatable("cross-coupling k_yz"),
    "k_xxx": translatable("third-order nonlinearity k_xxx"),
    "scale_asymmetry": translatable("scale factor asymmetry"),
    "hysteresis": translatable("hysteresis"),
    "bias_temperature": translatable("bias temperature sensitivity"),
    "scale_temperature": translatable("scale factor temperature sensitivity"),
    "bias_drift": translatable("bias drift"),
    "scale_drift": translatable("scale factor drift"),
    "warm_up": translatable("warm-up"),
    "realisation_bias": translatable("turn-on to turn-on bias"),
    "vibration_rectification": translatable("vibration rectification"),
    # the stand
    "head_eccentricity": translatable("eccentricity of the head's circle"),
    "head_second_harmonic": translatable("second harmonic of the head's circle"),
    "head_scale": translatable("scale of the head"),
    "graduation": translatable("graduation error"),
    "backlash": translatable("backlash"),
    "axis_tilt": translatable("tilt of the head's axis"),
    "base_tilt_drift": translatable("drift of the foundation's tilt"),
    "seating": translatable("repeatability of the seat"),
    "reference_drift": translatable("drift of the reference"),
    "reference_temperature": translatable("temperature sensitivity of the reference"),
    # the DAQ
    "settling": translatable("incomplete settling"),
    "daq_nonlinearity": translatable("nonlinearity of the DAQ"),
    "range_step": translatable("step between ranges"),
    "latency": translatable("latency"),
    # a parameter over temperature
    "temperature_linear": translatable("linear temperature dependence"),
    "temperature_quadratic": translatable("quadratic temperature dependence"),
    "temperature_cubic": translatable("cubic temperature dependence"),
    "temperature_quartic": translatable("quartic temperature dependence"),
    "temperature_break": translatable("break in the temperature dependence"),
    "temperature_step": translatable("step in the temperature dependence"),
    "temperature_hysteresis": translatable("temperature hysteresis"),
    "run_drift": translatable("drift from run to run"),
    # the operator
    "misreading": translatable("misreading"),
}
"""Every effect of the catalogues; one of the user's own keeps the word that its author gave it."""


def instrument_name(name: str) -> str:
    """An instrument of a stand file as an operator reads it: those of every stand in words, others by their names."""
    return {"head": tr("Dividing head"), "daq": tr("Voltmeter")}.get(name, name)


def effect_name(effect: str) -> str:
    """An effect as an operator reads it."""
    return translate(EFFECT_NAMES.get(effect, effect), spoken())
