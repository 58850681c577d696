"""One simulated observation table and the truth behind it."""

from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from typing import Any, Final

import numpy as np

from benchmarks.bank.beyond import BEYOND
from benchmarks.bank.catalogue import DRAW, LARGEST, NAMED, UNNAMED
from benchmarks.bank.dwells import dwells
from benchmarks.bank.geometry import FloatArray
from benchmarks.bank.misreading import Misreading, drawn_misreading
from benchmarks.bank.noise import drawn_noise
from benchmarks.bank.novel import NOVEL
from benchmarks.bank.scene import SAMPLES, Effect, Run, Sized, Unit, drawn_unit, respond
from benchmarks.bank.surroundings import THERMOMETER_DEGC, drawn_run
from benchmarks.bank.together import told_apart
from benchmarks.bank.visibility import Sight, sight
from tumble.calibrations.methods.dividing_head.observations import Observations

COLUMNS: Final = {
    "time_s": "time_s",
    "realisation": "realisation",
    "procedure": "procedure",
    "mount": "mount",
    "direction": "direction",
    "temperature_degC": "temperature_degc",
    "voltage_sd_V": "voltage_sd_v",
    "samples": "samples",
}
"""Columns that a table may do without, and their fields in `Observations`."""

_CATALOGUE: Final = {name: draw for name, draw in DRAW.items() if name not in UNNAMED}
_DWELLS, _UNIT, _AROUND, _NOISE, _FIRST_EFFECT = range(5)
_THERMOMETER: Final = "thermometer"
_ORDER: Final = (*NAMED, *NOVEL, _THERMOMETER, *BEYOND)
"""Of what draws random numbers of its own: what comes later changes nothing of what is before it."""
SHAKEN_ANYWAY = 0.1
"""Part of the tables in which the scatter of the samples varies although the bias does not follow it."""


@dataclass(frozen=True, kw_only=True)
class Spec:
    """What a table is to hold. A table is fixed by its spec and a seed."""

    design: str = "bfd"
    realisations: int = 5
    effects: tuple[tuple[str, float], ...] = ()
    """Effects of the catalogue or novel ones, each with its visible signal in noise units."""
    noise: str = "white"
    noise_v: float = 1e-4
    """Noise of a dwell: the unit in which `effects` are asked for."""
    quantum_v: float = 0.0
    """Resolution of the readings; 0: none."""
    left_out: tuple[str, ...] = ()
    """Columns that the table does without, named as in observations.md."""


@dataclass(frozen=True, kw_only=True)
class Truth:
    """What was put in, in the contract's names, keys, units and reference conventions."""

    seed: int
    spec: Spec
    unit: Unit
    effects: tuple[str, ...]
    """Effects of the catalogue."""
    novel: Mapping[str, str]
    """Effects outside the catalogue, and what each depends on."""
    coefficients: Mapping[str, Any]
    shapes: Mapping[str, str]
    """Which functional form each effect took."""
    visible: Mapping[str, float]
    """Norm of what the declared model cannot absorb of each effect alone, in noise units."""
    noise_free_v: FloatArray = field(repr=False)
    novel_v: FloatArray = field(repr=False)
    """What the effects outside the catalogue add, shape (rows,)."""

    def as_json(self) -> dict[str, Any]:
        """Return everything but the noise-free voltage, ready for JSON."""
        spec = asdict(self.spec)
        return {
            "seed": self.seed,
            "design": spec.pop("design"),
            "realisations": spec.pop("realisations"),
            "effects": list(self.effects),
            "coefficients": dict(self.coefficients),
            "unit": asdict(self.unit),
            "visible_noise_units": dict(self.visible),
            "noise_V": spec.pop("noise_v"),
            "noise": spec.pop("noise"),
            "quantum_V": spec.pop("quantum_v"),
            "left_out": list(self.spec.left_out),
            "novel": dict(self.novel),
            "shapes": dict(self.shapes),
        }


@dataclass(frozen=True, kw_only=True)
class Case:
    """A table and its truth."""

    observations: Observations
    truth: Truth


@dataclass(frozen=True, kw_only=True)
class Stage:
    """What is behind a table: its run, its unit, and its effects in the form and size that were drawn."""

    run: Run
    unit: Unit
    sized: tuple[Sized, ...]
    visible: Mapping[str, float]
    """As in `Truth`."""


def make_table(spec: Spec, seed: int) -> Case | None:
    """Make the table; None where the design cannot show an effect within its physical maximum or beside the others.

    Raises
    ------
    ValueError
        For an unknown design, effect, kind of noise or column.
    """
    staged = make_stage(spec, seed)
    if staged is None:
        return None
    run, unit, sized = staged.run, staged.unit, staged.sized
    noise_v = drawn_noise(spec.noise, run.dwells.time_s, spec.noise_v, _stream(seed, _NOISE))
    reading_v = respond(run, unit, sized, noise_v)
    if spec.quantum_v:
        reading_v = spec.quantum_v * np.round(reading_v / spec.quantum_v)
    names = [effect.name for effect, _ in sized]
    truth = Truth(
        seed=seed,
        spec=spec,
        unit=unit,
        effects=tuple(name for name in names if name not in UNNAMED),
        novel={name: UNNAMED[name][0] for name in names if name in UNNAMED},
        coefficients={effect.name: effect.coefficient(amplitude) for effect, amplitude in sized},
        shapes={effect.name: effect.shape for effect, _ in sized},
        visible=staged.visible,
        noise_free_v=respond(run, unit, sized),
        novel_v=respond(run, unit, [each for each in sized if each[0].name in UNNAMED]) - respond(run, unit, ()),
    )
    return Case(observations=_observations(spec, seed, run, sized, reading_v), truth=truth)


def make_stage(spec: Spec, seed: int) -> Stage | None:
    """Make what is behind a table, for whoever may know the truth; None as for `make_table`.

    Raises
    ------
    ValueError
        For an unknown design, effect or column.
    """
    _refuse_unknown(spec)
    unit = drawn_unit(_stream(seed, _UNIT))
    run = _surrounded(spec, seed)
    sized, visible = _sized(spec, seed, run, unit)
    return None if len(sized) < len(spec.effects) else Stage(run=run, unit=unit, sized=tuple(sized), visible=visible)


def read_on(spec: Spec, seed: int, stage: Stage, run: Run) -> FloatArray:
    """Return what the unit of a table reads on a longer run that begins with that of the table; without noise.

    Only for effects that are no draws of each row, seat or realisation, and no part of the length of the run.
    """
    drawn = [DRAW[name](_stream(seed, _FIRST_EFFECT + _ORDER.index(name)), run) for name, _ in spec.effects]
    return respond(
        run, stage.unit, [(effect, amplitude) for effect, (_, amplitude) in zip(drawn, stage.sized, strict=True)]
    )


def _refuse_unknown(spec: Spec) -> None:
    if unknown := [name for name, _ in spec.effects if name not in (*NAMED, *UNNAMED)]:
        raise ValueError(f"There is no effect {unknown[0]}; known are {', '.join((*NAMED, *UNNAMED))}.")
    if missing := set(spec.left_out) - set(COLUMNS):
        raise ValueError(f"Column {min(missing)} cannot be left out; {', '.join(COLUMNS)} can.")


def _stream(seed: int, part: int) -> np.random.Generator:
    """Random numbers of one part of a table, so that no part changes what another draws."""
    return np.random.default_rng((seed, part))


def _surrounded(spec: Spec, seed: int) -> Run:
    laid_out = dwells(spec.design, spec.realisations, _stream(seed, _DWELLS))
    rng = _stream(seed, _AROUND)
    shaken = rng.uniform() < SHAKEN_ANYWAY or "vibration_rectification" in dict(spec.effects)
    return drawn_run(laid_out, spec.design, spec.noise_v, shaken, rng)


def _sized(spec: Spec, seed: int, run: Run, unit: Unit) -> tuple[list[Sized], dict[str, float]]:
    """Draw the effects and find their amplitudes; fewer than asked for where one cannot be seen or told apart."""
    sized: list[Sized] = []
    visible: dict[str, float] = {}
    if not spec.effects:
        return sized, visible
    seen = sight(run, unit)
    for name, units in spec.effects:
        effect = _drawn(name, spec, seen, _stream(seed, _FIRST_EFFECT + _ORDER.index(name)))
        found = _amplitude(effect, units * spec.noise_v, seen)
        if found is None:
            break
        sized.append((effect, found[0]))
        visible[name] = found[1] / spec.noise_v
    if len(sized) > 1 and not told_apart(seen, sized, _CATALOGUE, LARGEST, spec.noise_v):
        return [], {}
    return sized, visible


def _drawn(name: str, spec: Spec, seen: Sight, rng: np.random.Generator) -> Effect:
    return drawn_misreading(seen, spec.noise_v, rng) if name == "misreading" else DRAW[name](rng, seen.run)


def _amplitude(effect: Effect, wanted_v: float, seen: Sight) -> tuple[float, float] | None:
    """Return the amplitude and what it shows, in volts. A misreading is as large as it was drawn."""
    if isinstance(effect, Misreading):
        return 1.0, seen.shown_v(effect, 1.0)
    return seen.amplitude_for(effect, wanted_v, LARGEST[effect.name])


def _observations(spec: Spec, seed: int, run: Run, sized: Sequence[Sized], reading_v: FloatArray) -> Observations:
    laid_out, rows = run.dwells, len(run.dwells)
    shift_deg = sum(
        (effect.reported_shift_deg for effect, _ in sized if isinstance(effect, Misreading)), np.zeros(rows)
    )
    thermometer_degc = _stream(seed, _FIRST_EFFECT + _ORDER.index(_THERMOMETER)).normal(0.0, THERMOMETER_DEGC, rows)
    optional: dict[str, Any] = {
        "time_s": laid_out.time_s,
        "realisation": laid_out.realisation,
        "procedure": laid_out.procedure,
        "mount": laid_out.mount,
        "direction": laid_out.direction,
        "temperature_degc": run.temperature_degc + thermometer_degc,
        "voltage_sd_v": run.measured_sd_v,
        "samples": np.full(rows, SAMPLES),
    }
    kept = {name: optional[name] for column, name in COLUMNS.items() if column not in spec.left_out}
    return Observations(
        row=np.arange(1, rows + 1),
        angle_deg=laid_out.angle_deg + shift_deg,
        voltage_v=reading_v,
        source=f"bank {spec.design} {seed}",
        **kept,
    )
