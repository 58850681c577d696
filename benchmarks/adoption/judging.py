"""What adoption does for a type: found on the first units, adopted, sought on further ones and on one that lacks it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Final

import numpy as np

from benchmarks.adoption.world import DWELL_V, Unit, UnitType, measured, unit, unit_type
from tumble.app.adopted_effects import contradicted, with_what_is_known
from tumble.app.adopting import adopt
from tumble.app.adoption_wish import Wish
from tumble.app.analysed import Traced
from tumble.app.analysing import fit
from tumble.app.jobs import find_job
from tumble.app.measurement import Measurement
from tumble.app.measurements import read_measurement
from tumble.calibrations.adopted.effect import UnitType as KeptWithType
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.dividing_head.fit import joint_fit
from tumble.calibrations.methods.dividing_head.loop.table import scene_of
from tumble.calibrations.methods.dividing_head.model import ALPHA0

FIRST_UNITS: Final = 5
FURTHER: Final = 10
NAME: Final = "laboratory_effect"


@dataclass(frozen=True, kw_only=True)
class Error:
    """Of a realisation that was held out, root mean square in volts."""

    declared: float
    unnamed: float
    """With what the loop finds without the adopted effect."""
    adopted: float
    """With it."""


@dataclass(frozen=True, kw_only=True)
class Further:
    """One further unit."""

    number: int
    named: bool
    """Whether the adopted effect was found, alone, and nothing unexplained beside it."""
    alone: bool
    said_against: tuple[str, ...]
    error: Error
    inside: int
    stated: int
    """Parameters with a value, of which so many are inside their 95% interval."""
    size: float | None
    size_uncertainty: float | None
    true_size: float


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """One type."""

    seed: int
    kind: UnitType
    found: int
    """First units on which structure without a name was found."""
    spread: float
    true_spread: float
    further: tuple[Further, ...]
    lacking: tuple[str, ...]
    """What the unit that lacks the effect says against it."""


def outcome(seed: int) -> Outcome:
    """Adopt the effect of a type, and judge what that does."""
    with TemporaryDirectory() as name:
        folder, kind = Path(name), unit_type(seed)
        units = [unit(seed, number) for number in range(FIRST_UNITS + FURTHER)]
        first = [_read(folder, kind, each) for each in units[:FIRST_UNITS]]
        analysed = [fit(each, trials=0, folder=folder) for each in first]
        found = sum(bool(_traced(each).explained.trace.components) for each in first)  # type: ignore[union-attr]
        wish = Wish(name=NAME, kept_with=KeptWithType(name=kind.name), channel="offset", variable="acceleration ax")
        effect, _ = adopt(wish, analysed, folder)
        sizes = np.array([each.size for each in units[:FIRST_UNITS]])
        mean = float(np.mean(sizes))
        lacking = _traced(with_what_is_known(_read(folder, kind, unit(seed, 99, lacking=True)), folder))
        return Outcome(
            seed=seed,
            kind=kind,
            found=found,
            spread=effect.spread or 0.0,
            true_spread=float(np.std(sizes, ddof=1)) / mean,
            further=tuple(_further(folder, kind, each, mean) for each in units[FIRST_UNITS:]),
            lacking=tuple(map(str, contradicted(lacking))),
        )


def _further(folder: Path, kind: UnitType, one: Unit, mean: float) -> Further:
    bare = _read(folder, kind, one)
    known = with_what_is_known(bare, folder)
    traced = _traced(known)
    sizes = [effect.coefficients["size"] for effect in traced.loop.effects if effect.name == NAME]
    stated = [(name, each) for name, each in _parameters(traced).items() if each.value is not None]
    return Further(
        number=int(one.serial_number.removeprefix("U-")),
        named=bool(sizes),
        alone=[effect.name for effect in traced.loop.effects] == [NAME] and not traced.explained.trace.components,  # type: ignore[union-attr]
        said_against=tuple(map(str, contradicted(traced))),
        error=_error(bare, known),
        inside=sum(_inside(one.truth[name], each) for name, each in stated),
        stated=len(stated),
        size=sizes[0].value if sizes else None,
        size_uncertainty=sizes[0].standard_uncertainty if sizes else None,
        true_size=one.size / mean,
    )


def _read(folder: Path, kind: UnitType, one: Unit) -> Measurement:
    recording = folder / f"{one.serial_number}.mcap"
    return read_measurement(recording if recording.exists() else measured(folder, kind, one))


def _traced(measurement: Measurement) -> Traced:
    return find_job(measurement.method).trace(fit(measurement, trials=0))


def _parameters(traced: Traced) -> dict[str, Parameter]:
    return dict(traced.loop.augmented.parameters)  # type: ignore[attr-defined]


def _inside(truth: float, parameter: Parameter) -> bool:
    assert parameter.interval_95 is not None, "it has a value"
    low, high = parameter.interval_95
    return low <= truth <= high


def _error(bare: Measurement, known: Measurement) -> Error:
    """The last realisation, predicted from the others."""
    rows = bare.observations
    last = rows.realisations == rows.realisations.max()
    held_out = rows.select(last)
    before, after = (_traced(replace(each, observations=rows.select(~last))) for each in (bare, known))
    declared = joint_fit(before.explained.table.joint.compressed).theta  # type: ignore[union-attr]
    scene = scene_of(held_out, declared)
    return Error(
        declared=_rms(held_out.output_v - scene.output_v),  # type: ignore[attr-defined]
        unnamed=_rms(_left(before, held_out)),
        adopted=_rms(_left(after, held_out)),
    )


def _left(traced: Traced, rows: object) -> np.ndarray:  # type: ignore[type-arg]
    """What a fit leaves of rows; effects are seen from where they were linearised."""
    explained = traced.explained
    assert explained is not None, "the rows are traced"
    theta = explained.best.joint.fit.theta.copy()
    theta[ALPHA0] = explained.table.scene.alpha0_deg
    return explained.best.residual_v(scene_of(rows, theta))  # type: ignore[no-any-return, arg-type]


def _rms(values: np.ndarray) -> float:  # type: ignore[type-arg]
    return float(np.sqrt(np.mean(values**2)))


def removed(before: float, after: float) -> float:
    """Part of the mean square error beyond the noise of a dwell that is gone."""
    return (before**2 - after**2) / (before**2 - DWELL_V**2)


def medians(further: Sequence[Further]) -> tuple[float, float, float]:
    """Of the errors, declared, unnamed, adopted."""
    errors = np.array([[each.error.declared, each.error.unnamed, each.error.adopted] for each in further])
    declared, unnamed, adopted = np.median(errors, axis=0).tolist()
    return declared, unnamed, adopted
