"""Effects of the unit that the contract names (effects.md), each in the form its sentence says."""

from collections.abc import Mapping
from typing import Any, Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.named import signed
from benchmarks.blind.named.lag import lag
from benchmarks.blind.named.signed import Form, hours
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import Draw, Family
from benchmarks.blind.world import Acts, Effect, Unit, World

_REFERENCE_DEGC: Final = 23.0


def _warmer(world: World) -> FloatArray:
    return world.run.temperature_degc - _REFERENCE_DEGC


FORMS: Final[Mapping[str, Form]] = {
    "k_xx": lambda world: world.ax**2,
    "k_yy": lambda world: world.ay**2,
    "k_zz": lambda world: world.az**2,
    "k_xz": lambda world: world.ax * world.az,
    "k_yz": lambda world: world.ay * world.az,
    "k_xxx": lambda world: world.ax**3,
    "scale_asymmetry": lambda world: np.abs(world.ax),
    "hysteresis": lag,
    "bias_temperature": _warmer,
    "scale_temperature": lambda world: world.ax * _warmer(world),
    "bias_drift": hours,
    "scale_drift": lambda world: world.ax * hours(world),
    "vibration_rectification": lambda world: world.run.voltage_sd_v**2,
}
"""What one unit of the coefficient adds, in V."""


def _warming_up(amplitude_v: float, tau_s: float) -> Effect:
    """Settles exponentially; the settled state is the reference (result.md)."""
    return Effect(
        name="warm_up",
        acts=Acts.OUTPUT,
        amount=lambda world: amplitude_v * np.exp(-world.run.time_s / tau_s),
        coefficients={"amplitude": amplitude_v, "tau_s": tau_s},
    )


def _warm_up(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    sign, tau_s = float(rng.choice([-1.0, 1.0])), run.span_s * float(rng.uniform(0.06, 0.3))
    return lambda size: _warming_up(sign * size, tau_s)


def _walk(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """A Wiener process; its mean over the rows belongs to u0 (result.md)."""
    hours_between = np.diff(run.time_s, prepend=0.0) / 3600.0
    course = run.centred(np.cumsum(rng.normal(size=len(run.time_s)) * np.sqrt(hours_between)))
    return signed.given("bias_random_walk", Acts.OUTPUT, course, 1.0)


def _jumps(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """A level for each realisation; their mean belongs to u0 (result.md)."""
    levels = rng.normal(size=run.realisation.max())
    held = levels[: run.realisation[~run.fresh].max()]
    course = (levels - held.mean())[run.realisation - 1]
    return signed.given("realisation_bias", Acts.OUTPUT, course, float(held.std(ddof=1)))


DRAWS: Final[Mapping[str, Draw]] = {
    **{name: signed.drawn(name, Acts.OUTPUT, form) for name, form in FORMS.items()},
    "warm_up": _warm_up,
    "bias_random_walk": _walk,
    "realisation_bias": _jumps,
}


def stated(name: str, values: Mapping[str, Any]) -> Effect | None:
    """Return the effect that a result states, from its coefficients; None where they do not fix its course."""
    if name == "warm_up":
        return _warming_up(values["amplitude"], values["tau_s"])
    return signed.stated({key: (Acts.OUTPUT, form) for key, form in FORMS.items()}, name, values)
