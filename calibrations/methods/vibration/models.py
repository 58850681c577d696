"""What is stated of a unit: coefficients by the declared model and with what was found, and how far each predicts."""

from dataclasses import replace
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import BoolArray
from tumble.calibrations.core.budget import BudgetLine
from tumble.calibrations.core.parameter import ModelFit, Parameter
from tumble.calibrations.methods.vibration.fit import VibrationFit, fit_vibration, second_fits
from tumble.calibrations.methods.vibration.model import NAMES, values_of
from tumble.calibrations.methods.vibration.observations import SHAKER
from tumble.calibrations.methods.vibration.table import VibrationTable
from tumble.calibrations.tracing.explained import RIVALS_APART, Explained
from tumble.calibrations.tracing.held_out import held_out_rms
from tumble.calibrations.tracing.near_fits import averaged_over
from tumble.calibrations.tracing.penalties import NEAR
from tumble.calibrations.tracing.trace import Trace, Tracer
from tumble.messages import Message

_ONE_LEVEL: Final = 1.2
"""Mean squares of which the largest is no more than so many times the smallest show no curvature."""
_FOLDS: Final = 6
"""Into so many parts the settings are dealt for the held-out error, every repeat of one in the same part."""


def declared_model(table: VibrationTable, fit: VibrationFit, nothing: Trace) -> ModelFit:
    """The declared model."""
    errors = held_out_rms(Tracer(replace(table, effects=(), axes=())), nothing, _parts(table))
    return _modelled(table, fit, fit.parameters(), errors)


def augmented(explained: Explained[VibrationTable, VibrationFit]) -> tuple[ModelFit, tuple[BudgetLine, ...]]:
    """The model with what was found, and the line of near explanations in its budget.

    A coefficient that depends on which of near rivals is true has no value.
    """
    errors = held_out_rms(explained.judged.tracer, explained.judged.trace, _parts(explained.table))

    def refitted(trace: Trace) -> dict[str, Parameter]:
        return fit_vibration(explained.table, trace).parameters()

    parameters, lines = averaged_over(explained, _with_rivals(explained), refitted, values_of)
    return _modelled(explained.table, explained.best, parameters, errors), lines


def _modelled(
    table: VibrationTable, fit: VibrationFit, parameters: dict[str, Parameter], held_out_ug: float | None
) -> ModelFit:
    residual_ug = float(np.sqrt(np.mean(fit.residual**2)))
    remarked = {name: _remarked(table, each) for name, each in parameters.items()}
    return ModelFit(parameters=remarked, residual_rms=residual_ug, held_out_rms=held_out_ug)


def _remarked(table: VibrationTable, parameter: Parameter) -> Parameter:
    """What one direction of the drive takes for a coefficient, and what one level does not show, is said with it."""
    every = (parameter.remark, _absorbed(table, parameter), _one_level(table, parameter))
    said = [sentence for sentence in every if sentence]
    if parameter.value is None or not said:
        return parameter
    return replace(parameter, remark=Message.joined("; ", said))


def _absorbed(table: VibrationTable, parameter: Parameter) -> str:
    if parameter.name != NAMES[0] or not _absorbs(table):
        return ""
    return Message(
        "with the drive in one direction of the unit alone, sideways motion of the shaker and a lean of its table "
        "are part of it; turn the unit by 180° about its input axis, and reverse that axis"
    )


def _one_level(table: VibrationTable, parameter: Parameter) -> str:
    """That a coefficient comes of one level of vibration alone."""
    names = parameter.name.split("+")
    products_g2 = np.abs(table.scene.products_g2[:, [NAMES.index(name) for name in names]]).max(axis=1)
    levels_g2 = products_g2[products_g2 > 0.0]
    if not len(levels_g2) or levels_g2.max() > _ONE_LEVEL * levels_g2.min():
        return ""
    return Message(
        "it comes of one level of vibration: whether the rectification grows as the square of it is not seen; add a "
        "level of half as much"
    )


def _absorbs(table: VibrationTable) -> bool:
    """Whether all vibration comes from one shaker in one direction of the unit."""
    rows = table.observations
    moved = rows.vibrated & (rows.of_apparatus == SHAKER)
    ways = np.round(np.column_stack([rows.along("drive_"), rows.along("lateral_")]), 3)[moved]
    return bool(len(ways)) and len(np.unique(ways, axis=0)) == 1 and bool(np.all(moved == rows.vibrated))


def _with_rivals(explained: Explained[VibrationTable, VibrationFit]) -> dict[str, Parameter]:
    """Coefficients with what was found; those on which near rivals disagree are given for each of them."""
    own = explained.best.parameters()
    parameters = dict(own)
    for name, rivals in explained.near.items():
        for rival in rivals:
            other = fit_vibration(explained.table, rival.trace).parameters()
            for key, parameter in own.items():
                parameters[key] = _unless_apart(parameters[key], parameter, other.get(key), name, rival.name)
    for number, second in enumerate(second_fits(explained.table, explained.trace, explained.best, NEAR), start=2):
        other, told = second.parameters(), [str(item.effect.name) for item in second.found]
        for key, parameter in own.items():
            parameters[key] = _unless_apart(
                parameters[key], parameter, other.get(key), told[0], f"{told[0]} ({number})"
            )
    return parameters


def _unless_apart(so_far: Parameter, own: Parameter, other: Parameter | None, name: str, rival: str) -> Parameter:
    if own.value is None or own.standard_uncertainty is None:
        return so_far
    apart = other is None or other.value is None or (
        abs(other.value - own.value) > RIVALS_APART * own.standard_uncertainty
    )  # fmt: skip
    if not apart:
        return so_far
    reason = so_far.reason or Message(
        "it differs between {name} and {rival}, which this experiment does not clearly tell apart",
        name=name,
        rival=rival,
    )
    given = {**dict(so_far.given), name: own.value}
    if other is not None and other.value is not None:
        given[rival] = other.value
    return replace(own.withheld(reason), given=given)


def _parts(table: VibrationTable) -> list[BoolArray]:
    """Parts of the rows, whole settings with all their repeats; rests, which are all of one setting, in every part."""
    rows = table.observations
    number = np.where(rows.vibrated, table.blocks("angle"), np.arange(len(rows)))
    return [np.asarray(number % _FOLDS == fold) for fold in range(_FOLDS)]
