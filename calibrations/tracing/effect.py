"""How an effect is declared: by the columns that it adds to the model, and by what its coefficients are called."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Final, Generic, Literal, TypeAlias, TypeVar

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.messages import Message

Owner: TypeAlias = Literal["unit", "stand", "daq", "reference"]
Variable: TypeAlias = Literal[
    "angle",
    "acceleration",
    "rate",
    "amplitude",
    "frequency",
    "time",
    "temperature",
    "direction",
    "realisation",
    "order",
]
"""On what an effect, or structure without a name, may depend."""
OWNER_WORDS: Final[Mapping[str, Message]] = {
    "unit": Message("unit"),
    "stand": Message("stand"),
    "daq": Message("DAQ"),
    "reference": Message("reference"),
}
"""What an effect belongs to, as a reader calls it."""


@dataclass(frozen=True, kw_only=True)
class Form:
    """One shape of an effect: what is linear in its coefficients, for given values of what is not."""

    columns: FloatArray
    """Volts per unit of each coefficient, shape (rows, coefficients)."""
    scanned: Mapping[str, float] = field(default_factory=dict)
    """Values of what enters nonlinearly (order, time constant, threshold, period), by contract key."""
    penalty: float = 0.0
    """What the shape is penalised by in -2 ln L beyond others, as one that could stand in for almost anything."""


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with its standard uncertainty (None where it has none, as a whole-numbered order) and unit."""

    value: float
    standard_uncertainty: float | None
    unit: str


@dataclass(frozen=True, kw_only=True)
class Expected:
    """A coefficient as it is known before a table is seen: the mean of a population, and how its members differ."""

    value: float
    standard_deviation: float


Seen = TypeVar("Seen")
"""The kind of scene in which an effect is seen: what is known of each row of a table of its kind."""
Forms: TypeAlias = Callable[[Seen], Sequence[Form]]
Reported: TypeAlias = Callable[[Form, FloatArray, FloatArray], Mapping[str, Quantity]]
"""From form, coefficients and their covariance to what is reported, by contract key."""


@dataclass(frozen=True, kw_only=True)
class Effect(Generic[Seen]):
    """A physical effect that the declared model of its kind of table lacks."""

    name: str
    """A word of the contract, or of the user; of several that share one, the word with something added.

    `Message.named` where a reader is shown words in its place, in the language that is theirs.
    """
    family: str = ""
    """The word that several share; empty where `name` is it."""
    belongs_to: Owner
    symbol: str
    source: str
    forms: Forms[Seen]
    """Every shape to try; none where the table lacks what the effect depends on."""
    report: Reported
    at: Callable[[Seen, float], Form] | None = None
    """The form for any value of what is scanned, where that is a continuous quantity."""
    again: Callable[[Seen, Mapping[str, float]], Form] | None = None
    """The form of certain scanned values in any rows, where all the others take long; found among `forms` without."""
    random: bool = False
    """Whether it is a random effect: a level for every seat or turn-on."""
    given: bool = False
    """Whether its shape is given, so that no second form of it may stand in for what the first one lacks."""
    additive: bool = False
    """Whether coefficients of two forms add up to one reported coefficient; otherwise the larger is reported."""
    depends_on: Variable = "acceleration"
    """The variable whose blocks carry the evidence: settings for angle, acceleration (voltage too) and direction."""
    expected: Expected | None = None
    """What is known of its only coefficient before a table is seen; None where nothing is."""
    unknown: Callable[[Seen], FloatArray] | None = None
    """What is not known of its shape: what one standard uncertainty of each independent part of that adds to the output
    where the coefficient is 1, shape (rows, parts); None where the shape is given."""

    @property
    def word(self) -> str:
        """How it is called in a result."""
        return self.family or self.name


@dataclass(frozen=True, kw_only=True)
class Structure(Effect[Seen]):
    """A family of shapes of one variable without a name."""

    depends_on: Variable
    describe: Callable[[Form], str]
    """What the structure is and where, in words."""


def single(column: FloatArray | None) -> tuple[Form, ...]:
    """One form with one column; none without a column."""
    return () if column is None else (Form(columns=np.asarray(column, dtype=float)[:, None]),)


def scan(at: Callable[[Seen, float], Form], values: Callable[[Seen], Sequence[float]]) -> Forms[Seen]:
    """One form for each of the values to try."""
    return lambda scene: tuple(at(scene, value) for value in values(scene))


def plain(key: str, unit: str) -> Reported:
    """Report the only coefficient under its key."""

    def report(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
        uncertainty = float(np.sqrt(covariance[0, 0]))
        return {key: Quantity(value=float(coefficients[0]), standard_uncertainty=uncertainty, unit=unit)}

    return report


def harmonic_in(unit: str) -> Reported:
    """Report a sine and a cosine coefficient as A sin(n φ + p): amplitude in a unit of angle, phase in degrees."""

    def report(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
        sine, cosine = float(coefficients[0]), float(coefficients[1])
        amplitude = float(np.hypot(sine, cosine))
        along = np.array([sine, cosine]) / amplitude
        across = np.array([-cosine, sine]) / amplitude**2
        phase_deg = float(np.rad2deg(np.arctan2(cosine, sine)) % 360.0)
        u_amplitude = float(np.sqrt(along @ covariance @ along))
        u_phase_deg = float(np.rad2deg(np.sqrt(across @ covariance @ across)))
        return {
            f"amplitude_{unit}": Quantity(value=amplitude, standard_uncertainty=u_amplitude, unit=unit),
            "phase_deg": Quantity(value=phase_deg, standard_uncertainty=u_phase_deg, unit="deg"),
        }

    return report


harmonic: Final = harmonic_in("deg")
"""The same in degrees."""


def with_scanned(report: Reported, **units: str) -> Reported:
    """Report the scanned values too, under their keys, with these units."""

    def extended(form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
        scanned = {
            key: Quantity(value=form.scanned[key], standard_uncertainty=None, unit=unit) for key, unit in units.items()
        }
        return {**report(form, coefficients, covariance), **scanned}

    return extended


def spread(key: str, unit: str) -> Reported:
    """Report the standard deviation of the levels that happened.

    The coefficients are those of `contrasts`; their covariance is what is not known of them.
    """

    def report(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
        count = len(coefficients)
        value = float(np.sqrt((coefficients @ coefficients + np.trace(covariance)) / count))
        known = float(np.sqrt(coefficients @ covariance @ coefficients)) / (count * value)
        return {key: Quantity(value=value, standard_uncertainty=known, unit=unit)}

    return report


def contrasts(levels: int) -> FloatArray:
    """Orthonormal contrasts, shape (levels, levels - 1): every combination of levels with mean zero (Helmert)."""
    matrix = np.zeros((levels, levels - 1))
    for column in range(levels - 1):
        matrix[: column + 1, column] = -1.0
        matrix[column + 1, column] = column + 1.0
    return np.asarray(matrix / np.linalg.norm(matrix, axis=0))
