"""Effects of the unit that the contract names (effects.md), each in the form its sentence says."""

from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import Draw, Family
from benchmarks.blind.world import Acts, Effect, Unit, World

_REFERENCE_DEGC: Final = 23.0
_S_PER_H: Final = 3600.0


def _of(name: str, form: Callable[[World], FloatArray]) -> Draw:
    """An effect whose only coefficient has its name; its sign is drawn."""

    def draw(_run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
        sign = float(rng.choice([-1.0, 1.0]))
        return lambda size: Effect(
            name=name,
            acts=Acts.OUTPUT,
            amount=lambda world: sign * size * form(world),
            coefficients={name: sign * size},
        )

    return draw


def _cooled(world: World) -> FloatArray:
    return world.run.temperature_degc - _REFERENCE_DEGC


def _hours(world: World) -> FloatArray:
    return world.run.time_s / _S_PER_H


def _lag(world: World) -> FloatArray:
    """-1 where ax rose on the last of the way, 1 where it fell, 0 where neither (effects.md, `hysteresis`)."""
    run = world.run
    before_deg = run.angle_deg - 0.01 * run.direction
    none = np.zeros(len(before_deg))
    shift = World(run, world.unit, world.angle_error_deg + before_deg - run.angle_deg, none, none)
    rise = world.ax - shift.ax
    return -np.sign(np.where(np.abs(rise) < 1e-7, 0.0, rise))


def _settling(amplitude_v: float, tau_s: float) -> Effect:
    """Settles exponentially; the settled state is the reference (result.md)."""
    return Effect(
        name="warm_up",
        acts=Acts.OUTPUT,
        amount=lambda world: amplitude_v * np.exp(-world.run.time_s / tau_s),
        coefficients={"amplitude": amplitude_v, "tau_s": tau_s},
    )


def _warm_up(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    sign, tau_s = float(rng.choice([-1.0, 1.0])), run.span_s * float(rng.uniform(0.06, 0.3))
    return lambda size: _settling(sign * size, tau_s)


def _walk(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """A Wiener process; its mean over the rows belongs to u0 (result.md)."""
    steps = rng.normal(size=len(run.time_s)) * np.sqrt(np.diff(run.time_s, prepend=0.0) / _S_PER_H)
    course = run.centred(np.cumsum(steps))
    return _given("bias_random_walk", course, 1.0)


def _jumps(run: Run, _unit: Unit, rng: np.random.Generator) -> Family:
    """A level for each realisation; their mean belongs to u0 (result.md)."""
    levels = rng.normal(size=run.realisation.max())
    held = levels[: run.realisation[~run.fresh].max()]
    return _given("realisation_bias", (levels - held.mean())[run.realisation - 1], float(held.std(ddof=1)))


def _given(name: str, course: FloatArray, spread: float) -> Family:
    return lambda size: Effect(
        name=name, acts=Acts.OUTPUT, amount=lambda _: size * course, coefficients={name: size * spread}
    )


FORMS: Final[Mapping[str, Callable[[World], FloatArray]]] = {
    "k_xx": lambda world: world.ax**2,
    "k_yy": lambda world: world.ay**2,
    "k_zz": lambda world: world.az**2,
    "k_xz": lambda world: world.ax * world.az,
    "k_yz": lambda world: world.ay * world.az,
    "k_xxx": lambda world: world.ax**3,
    "scale_asymmetry": lambda world: np.abs(world.ax),
    "hysteresis": _lag,
    "bias_temperature": _cooled,
    "scale_temperature": lambda world: world.ax * _cooled(world),
    "bias_drift": _hours,
    "scale_drift": lambda world: world.ax * _hours(world),
    "vibration_rectification": lambda world: world.run.voltage_sd_v**2,
}
"""What one unit of the coefficient adds, in V."""

DRAWS: Final[Mapping[str, Draw]] = {
    **{name: _of(name, form) for name, form in FORMS.items()},
    "warm_up": _warm_up,
    "bias_random_walk": _walk,
    "realisation_bias": _jumps,
}


def stated(name: str, values: Mapping[str, Any]) -> Effect | None:
    """Return the effect that a result states, from its coefficients; None where they do not fix its course."""
    if name == "warm_up":
        return _settling(values["amplitude"], values["tau_s"])
    if name not in FORMS:
        return None
    return Effect(
        name=name, acts=Acts.OUTPUT, amount=lambda world: values[name] * FORMS[name](world), coefficients=values
    )
