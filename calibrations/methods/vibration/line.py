"""The line of the users: DC against g² r.m.s., with the intercept and the curvature that it should not have."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.beside import Beside, corrected_ug, fitted_beside
from tumble.calibrations.methods.vibration.fit import VibrationFit
from tumble.calibrations.methods.vibration.model import COEFFICIENTS
from tumble.calibrations.methods.vibration.observations import AXES
from tumble.calibrations.methods.vibration.table import VibrationTable
from tumble.calibrations.tracing.trace import Trace

_FEWEST_LEVELS: Final = 3
"""Levels by which a line has an intercept; one more, and it has a curvature too."""
_P: Final = 0.05
"""Of calling any line of a table bent though all are straight."""


@dataclass(frozen=True, kw_only=True)
class Line:
    """DC of one axis against its mean square, beside everything else that is known."""

    axis: str
    mean_square_g2: FloatArray
    """Of the dwells that are vibrated along the axis, shape (dwells,)."""
    rectified_ug: FloatArray
    """Of the same, less their rest, less what other axes add and what was found."""
    intercept_ug: tuple[float, float]
    """With its standard uncertainty, of the line with curvature where there is one."""
    slope_ug_g2: tuple[float, float]
    curvature_ug_g4: tuple[float, float] | None
    """None where there are too few levels."""
    p_value: float
    """Of the F test that intercept and curvature together are zero."""
    straight: bool
    """Whether they are, at 5% for all axes together."""

    def as_json(self) -> dict[str, Any]:
        """As results have it."""
        said = {"intercept": (self.intercept_ug, "µg"), "slope": (self.slope_ug_g2, "µg/g²")}
        if self.curvature_ug_g4:
            said["curvature"] = (self.curvature_ug_g4, "µg/g⁴")
        values = {
            key: {"value": value, "standard_uncertainty": uncertainty, "unit": unit}
            for key, ((value, uncertainty), unit) in said.items()
        }
        return {"axis": self.axis, **values, "p_value": self.p_value, "straight": self.straight}


def lines(table: VibrationTable, fit: VibrationFit, trace: Trace) -> tuple[Line, ...]:
    """The line of every axis whose coefficient is told and that was vibrated at several levels."""
    return tuple(_lines(table, fit, trace))


def _lines(table: VibrationTable, fit: VibrationFit, trace: Trace) -> Iterator[Line]:
    levels = {axis: _levels(table.scene.products_g2[:, axis]) for axis in range(len(AXES)) if fit.told((axis,))}
    drawn = [axis for axis, count in levels.items() if count >= _FEWEST_LEVELS]
    for axis in drawn:
        square = table.scene.products_g2[:, axis]
        columns = [square, (square > 0.0).astype(float), *([square**2] if levels[axis] > _FEWEST_LEVELS else [])]
        found = fitted_beside(table, fit, trace, np.column_stack(columns), left_out=(axis,))
        yield _line(table, fit, axis, found, _P / len(drawn))


def _levels(square: FloatArray) -> int:
    return len(np.unique(np.round(square[square > 0.0], 2)))


def _line(table: VibrationTable, fit: VibrationFit, axis: int, found: Beside, chance: float) -> Line:
    square = table.scene.products_g2[:, axis]
    moved = square > 0.0
    others = np.where(np.arange(COEFFICIENTS) == axis, 0.0, fit.coefficients_ug_g2)
    at_rest = table.declared[:, COEFFICIENTS:] @ fit.theta[COEFFICIENTS:]
    static = (table.declared[:, :COEFFICIENTS] - table.scene.products_g2) @ fit.coefficients_ug_g2
    rectified = corrected_ug(table, fit) - at_rest - static - table.scene.products_g2 @ others
    slope, intercept, *curvature = zip(found.values.tolist(), found.uncertainties.tolist(), strict=True)
    return Line(
        axis=AXES[axis],
        mean_square_g2=square[moved],
        rectified_ug=rectified[moved],
        intercept_ug=intercept,
        slope_ug_g2=slope,
        curvature_ug_g4=curvature[0] if curvature and found.told[2] else None,
        p_value=(p_value := _p_value(found)),
        straight=p_value > chance,
    )


def _p_value(found: Beside) -> float:
    """Of the F test of intercept and curvature together."""
    from scipy.special import fdtrc  # takes a tenth of a second, in which a window is half up

    told = [place for place in range(1, len(found.values)) if found.told[place]]
    if not told:
        return 1.0
    values, covariance = found.values[told], found.covariance[np.ix_(told, told)]
    ratio = float(values @ np.linalg.solve(covariance, values)) / len(told)
    return float(fdtrc(len(told), found.degrees_of_freedom, ratio))
