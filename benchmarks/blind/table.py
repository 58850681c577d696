"""One table and its truth."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from benchmarks.blind import nuisances
from benchmarks.blind.clock import drawn_run
from benchmarks.blind.geometry import FloatArray
from benchmarks.blind.named import CATALOGUE, OF_NO_SIZE
from benchmarks.blind.right import beyond_catalogue_units, right_variables
from benchmarks.blind.run import Run
from benchmarks.blind.sizing import CannotShowError, signal_v, sized, visible_units
from benchmarks.blind.stand_ins import stand_ins
from benchmarks.blind.together import VISIBLE_UNITS, check_together
from benchmarks.blind.unnamed import KINDS
from benchmarks.blind.world import Effect, Unit, respond_v

FRESH: Final = 2
_TRIES: Final = 60
_COLUMN: Final = {"temperature": "temperature_degC"}
_NEEDS: Final[Mapping[str, frozenset[str]]] = {
    "bias_temperature": frozenset({"temperature_degC"}),
    "scale_temperature": frozenset({"temperature_degC"}),
    "vibration_rectification": frozenset({"voltage_sd_V"}),
    "backlash": frozenset({"direction"}),
    "hysteresis": frozenset({"direction"}),
} | {name: frozenset({_COLUMN.get(kind.variable, kind.variable)}) for name, kind in KINDS.items()}
"""Columns without which an effect cannot be seen for what it is."""


@dataclass(frozen=True, kw_only=True)
class Spec:
    """What a table is to hold."""

    kind: str
    designs: tuple[str, ...]
    """Of which one is drawn that can show the effects."""
    nuisance: str = nuisances.PLAIN
    effects: tuple[tuple[str, float], ...] = ()
    """Names of the catalogue or of `KINDS`, each with its noise units."""


@dataclass(frozen=True, kw_only=True)
class Table:
    """A table, what was put in, and what a prediction is judged on."""

    spec: Spec
    design: str
    run: Run
    unit: Unit
    effects: tuple[Effect, ...]
    voltage_v: FloatArray
    """Readings with noise; of fresh realisations too."""
    noise_free_v: FloatArray
    right: frozenset[str]
    """Right variables for what has no name; empty without such."""
    stand_ins: frozenset[str]
    """Single catalogue effects that the design does not part from it."""
    beyond_catalogue_units: float
    left_out: tuple[str, ...]

    @property
    def named(self) -> tuple[str, ...]:
        """Effects of the catalogue that are there."""
        return tuple(effect.name for effect in self.effects if effect.name in CATALOGUE)

    @property
    def unnamed(self) -> tuple[str, ...]:
        """Effects outside it that are there."""
        return tuple(effect.name for effect in self.effects if effect.name in KINDS)

    def truth(self) -> dict[str, Any]:
        """Return what was put in, for JSON."""
        return {
            "kind": self.spec.kind,
            "design": self.design,
            "nuisance": self.spec.nuisance,
            "effects": list(self.named),
            "unnamed": list(self.unnamed),
            "right_variables": sorted(self.right),
            "stand_ins": sorted(self.stand_ins),
            "beyond_catalogue_units": round(self.beyond_catalogue_units, 2),
            "noise_units": dict(self.spec.effects),
            "coefficients": {effect.name: dict(effect.coefficients) for effect in self.effects},
            "unit": vars(self.unit),
            "left_out": list(self.left_out),
        }


def make_table(spec: Spec, rng: np.random.Generator) -> Table:
    """Draw a table; designs and forms are drawn anew until one shows what is asked for.

    Raises
    ------
    CannotShowError
        Where none does.
    """
    for _ in range(_TRIES):
        try:
            return _drawn(spec, rng)
        except CannotShowError as error:
            last = error
    raise last


def _drawn(spec: Spec, rng: np.random.Generator) -> Table:
    design = nuisances.DESIGNED.get(spec.nuisance) or str(rng.choice(spec.designs))
    run = drawn_run(design, nuisances.realisations(spec.nuisance), FRESH, rng)
    names = [name for name, _ in spec.effects]
    run = nuisances.with_noise(run, spec.nuisance, "vibration_rectification" in names, rng)
    unit = _drawn_unit(rng)
    effects = tuple(_effect(name, units, run, unit, rng) for name, units in spec.effects)
    check_together(effects, run, unit)
    right, others, beyond = _without_name(effects, run, unit)
    noise_free_v = respond_v(run, unit, effects)
    return Table(
        spec=spec,
        design=design,
        run=run,
        unit=unit,
        effects=effects,
        voltage_v=_read(noise_free_v, run, spec.nuisance, rng),
        noise_free_v=noise_free_v,
        right=right,
        stand_ins=others,
        beyond_catalogue_units=beyond,
        left_out=nuisances.left_out(spec.nuisance, _needed(names), rng),
    )


def _read(noise_free_v: FloatArray, run: Run, nuisance: str, rng: np.random.Generator) -> FloatArray:
    """Return the readings: with noise, and rounded where the nuisance says so."""
    quantum_v = nuisances.quantum_v(nuisance, rng)
    voltage_v = noise_free_v + run.noise_v * rng.normal(size=len(noise_free_v))
    return np.asarray(np.round(voltage_v / quantum_v) * quantum_v) if quantum_v else voltage_v


def _needed(names: list[str]) -> frozenset[str]:
    return frozenset().union(*(_NEEDS.get(name, frozenset()) for name in names))


def _drawn_unit(rng: np.random.Generator) -> Unit:
    """A unit like the published one (domain.md, section 1)."""
    u0, kx = 2.5 + rng.uniform(-0.03, 0.03), 1.0 + rng.uniform(-0.03, 0.03)
    ky, kz = rng.uniform(-0.01, 0.01, 2)
    kxy = rng.choice([-1.0, 1.0]) * rng.uniform(0.5e-3, 1.5e-3)
    return Unit(u0=u0, kx=kx, ky=ky, kz=kz, kxy=kxy, alpha0_deg=rng.uniform(-0.5, 0.5))


def _effect(name: str, units: float, run: Run, unit: Unit, rng: np.random.Generator) -> Effect:
    if name in KINDS:
        return sized(KINDS[name].drawn(run, unit, rng), run, unit, units)
    family = CATALOGUE[name](run, unit, rng)
    return family(units) if name in OF_NO_SIZE else sized(family, run, unit, units)


def _without_name(effects: tuple[Effect, ...], run: Run, unit: Unit) -> tuple[frozenset[str], frozenset[str], float]:
    """Return right variables and stand-ins of what has no name, and how much of it no catalogue effect takes up."""
    strange = [effect for effect in effects if effect.name in KINDS]
    if not strange:
        return frozenset(), frozenset(), 0.0
    signal = signal_v(run, unit, strange)
    beyond = beyond_catalogue_units(signal, run, unit)
    if beyond < max(VISIBLE_UNITS, 0.5 * visible_units(run, unit, strange)):
        raise CannotShowError(f"{strange[0].name}: catalogue effects take it up")
    meant = frozenset(word for effect in strange for word in (KINDS[effect.name].variable, *KINDS[effect.name].also))
    return right_variables(signal, run, unit) | meant, stand_ins(signal, run, unit), beyond
