"""Every effect of the bank by name: what it belongs to, how large it can be, how to draw it."""

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final

from benchmarks.bank.beyond import BEYOND
from benchmarks.bank.daq_effects import DAQ_EFFECTS
from benchmarks.bank.novel import NOVEL
from benchmarks.bank.stand_effects import STAND_EFFECTS
from benchmarks.bank.unit_effects import UNIT_EFFECTS, Draw

UNNAMED: Final = MappingProxyType({**NOVEL, **BEYOND})
"""Effects outside the catalogue: what each depends on, its largest amplitude, and how to draw it."""

DRAW: Final[Mapping[str, Draw]] = MappingProxyType(
    {**UNIT_EFFECTS, **STAND_EFFECTS, **DAQ_EFFECTS, **{name: draw for name, (_, _, draw) in UNNAMED.items()}}
)
"""How to draw an effect, named or novel; only `misreading` is made otherwise."""

LARGEST: Final[Mapping[str, float]] = MappingProxyType(
    {
        "k_xx": 5e-3,
        "k_yy": 5e-3,
        "k_zz": 5e-3,
        "k_xz": 5e-3,
        "k_yz": 5e-3,
        "k_xxx": 5e-3,
        "scale_asymmetry": 5e-3,
        "hysteresis": 2e-3,
        "bias_temperature": 5e-4,
        "scale_temperature": 5e-4,
        "bias_drift": 1e-3,
        "scale_drift": 1e-3,
        "warm_up": 2e-2,
        "bias_random_walk": 2e-3,
        "realisation_bias": 2e-3,
        "vibration_rectification": 300.0,
        "head_eccentricity": 0.1,
        "head_second_harmonic": 0.1,
        "graduation": 0.05,
        "backlash": 0.1,
        "axis_tilt": 0.5,
        "base_tilt_drift": 0.1,
        "seating": 0.1,
        "settling": 0.05,
        "daq_nonlinearity": 2e-3,
        "range_step": 5e-3,
        **{name: largest for name, (_, largest, _) in UNNAMED.items()},
    }
)
"""Physical maximum of the amplitude, in the unit of its coefficient: beyond it the bank has no such table."""

NAMED: Final = (*UNIT_EFFECTS, *STAND_EFFECTS, *DAQ_EFFECTS, "misreading")
"""The names of effects.md that the bank makes; `latency` needs a moving head."""

BELONGS_TO: Final[Mapping[str, str]] = MappingProxyType(
    {
        **dict.fromkeys(UNIT_EFFECTS, "unit"),
        **dict.fromkeys((*STAND_EFFECTS, "misreading"), "stand"),
        **dict.fromkeys(DAQ_EFFECTS, "daq"),
    }
)
