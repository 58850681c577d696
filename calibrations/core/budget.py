"""An uncertainty budget by the GUM: sources as errors of the rows, and what each adds to every parameter."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.coverage import coverage_factor
from tumble.calibrations.core.parameter import Parameter, finite
from tumble.calibrations.core.quantities import format_number
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class BudgetLine:
    """One source of uncertainty and what it adds to each parameter."""

    name: str
    kind: str
    """`A` or `B`."""
    symbol: str
    """Size of the source with its unit."""
    contributions: Mapping[str, float]
    """Standard uncertainty by parameter name, in the parameter's unit."""
    degrees_of_freedom: float

    def as_json(self) -> dict[str, Any]:
        """The line as a result has it."""
        return {
            "name": self.name,
            "kind": self.kind,
            "size": self.symbol,
            "degrees_of_freedom": finite(self.degrees_of_freedom),
            "contributions": dict(self.contributions),
        }


@dataclass(frozen=True, kw_only=True)
class Source:
    """One independent source of uncertainty, as errors of the rows."""

    name: str
    symbol: str
    """What is uncertain, as a short text with its unit and size."""
    errors_v: FloatArray
    """What one standard uncertainty does to each row: of one independent error per column, shape (rows, errors)."""
    shared_by: NDArray[np.int64] | None = None
    """Where each group of rows has an error of its own: the number of the group of each row. `errors_v` then has one
    column, in which they all stand: as a table of a column per group, a million rows would take tens of gigabytes."""

    def turned(self, rotation: FloatArray) -> FloatArray:
        """What each independent error does to the rotated voltages, shape (rotated, errors).

        `rotation` has the shape (rows, rotated), see `compression.Compressed`.
        """
        if self.shared_by is None:
            return np.asarray(rotation.T @ self.errors_v)
        return np.stack([np.bincount(self.shared_by, column * self.errors_v[:, 0]) for column in rotation.T])

    def line(self, contributions: Mapping[str, float]) -> BudgetLine:
        """What it adds to each parameter, as a line of a budget."""
        return BudgetLine(
            name=self.name,
            kind="B",
            symbol=self.symbol,
            contributions=contributions,
            degrees_of_freedom=float("inf"),
        )


def scatter_line(dwell_v: float, degrees_of_freedom: float, contributions: Mapping[str, float]) -> BudgetLine:
    """What the scatter of the data adds to each parameter (type A), `dwell_v` that of a dwell."""
    return BudgetLine(
        name=Message("scatter of the data"),
        kind="A",
        symbol=Message("{scatter} a dwell", scatter=format_number(dwell_v, "V")),
        contributions=contributions,
        degrees_of_freedom=degrees_of_freedom,
    )


def contributions(covariance: FloatArray, names: Sequence[str], stated: Sequence[str]) -> dict[str, float]:
    """Standard uncertainties by a covariance of all parameters, of those that are stated."""
    return {name: float(np.sqrt(covariance[i, i])) for i, name in enumerate(names) if name in stated}


def not_included(stated: Mapping[str, float | None], nothing: Message) -> str:
    """That some of what a stand adds is not in the stated uncertainty; empty where all of it is stated.

    `nothing` is said where no key has a value.
    """
    missing = [key for key, value in stated.items() if value is None]
    if not missing:
        return ""
    if len(missing) == len(stated):
        return nothing
    return Message(
        "part of the stand's contribution is not included in the stated uncertainty: the stand file does not state "
        "{keys}; state it there, as 0 where it is negligible",
        keys=", ".join(missing),
    )


def effective_freedom(contributions: list[tuple[float, float]]) -> float:
    """Welch-Satterthwaite degrees of freedom (GUM, G.4.1) of (standard uncertainty, degrees of freedom) pairs."""
    total = sum(u**2 for u, _ in contributions)
    denominator = sum(u**4 / freedom for u, freedom in contributions if freedom > 0 and np.isfinite(freedom))
    return float(total**2 / denominator) if denominator > 0 else float("inf")


def with_type_b(parameter: Parameter, further: float) -> Parameter:
    """A parameter with a further standard uncertainty of type B, by root sum of squares (GUM 5.1.2).

    Degrees of freedom by Welch and Satterthwaite, those of type B infinite. The interval becomes wider on both sides by
    the same part.
    """
    u, type_a, freedom = parameter.standard_uncertainty, parameter.type_a, parameter.degrees_of_freedom
    if parameter.value is None or parameter.interval_95 is None or u is None or type_a is None or freedom is None:
        return parameter
    combined = float(np.hypot(u, further))
    before, after = (
        effective_freedom([(type_a, freedom), (float(np.sqrt(max(each**2 - type_a**2, 0.0))), np.inf)])
        for each in (u, combined)
    )
    wider = coverage_factor(after) * combined / (coverage_factor(before) * u)
    low, high = (parameter.value + wider * (end - parameter.value) for end in parameter.interval_95)
    return replace(parameter, standard_uncertainty=combined, degrees_of_freedom=after, interval_95=(low, high))
