"""Closing the loop on a head that is measured against a reference."""

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.blas_threads import one_blas_thread
from tumble.calibrations.core.parameter import ModelFit
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.head_reference.adequacy import (
    Agreement,
    AngleError,
    Reversal,
    agreement,
    errors_by_setting,
    reversal,
)
from tumble.calibrations.methods.head_reference.adequacy import by_setting as left_by_setting
from tumble.calibrations.methods.head_reference.experiments import next_reference_experiments
from tumble.calibrations.methods.head_reference.explanation import Explanation, explain_head, fit_found
from tumble.calibrations.methods.head_reference.limits import limits
from tumble.calibrations.methods.head_reference.observations import HeadObservations
from tumble.calibrations.methods.head_reference.passes import Passes, passes
from tumble.calibrations.methods.head_reference.questions import question
from tumble.calibrations.methods.head_reference.rows import as_dwells
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.methods.head_reference.settings import head_settings
from tumble.calibrations.methods.head_reference.slips import slips
from tumble.calibrations.methods.head_reference.table import UNITS, HeadTable, head_table
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.findings import EffectFound, Unexplained
from tumble.calibrations.tracing.linear import LinearFit
from tumble.calibrations.tracing.linear_loop import LinearExplained, as_stated, rms, stated, withheld
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class ReferenceLoop:
    """The loop closed on one table."""

    observations: HeadObservations
    """The dwells that were used."""
    rows_read: int
    question: str
    """What there is to ask before anything is stated; empty where there is nothing."""
    declared: ModelFit
    augmented: ModelFit
    agreements: tuple[Agreement | None, Agreement | None]
    """Of both models with the repeats; None where no setting was visited twice."""
    effects: tuple[EffectFound, ...]
    unexplained: tuple[Unexplained, ...]
    by_setting: tuple[AngleError, ...]
    """The error of each angle from each side; none where nothing was visited twice."""
    reversal: Reversal | None
    passes: Passes | None
    """How forward and backward passes differ; None where the head was turned in one direction only."""
    warnings: tuple[str, ...]
    limits: tuple[str, ...]
    """What the table cannot tell, in sentences."""
    explanation: Explanation
    """What it rests on."""
    fit: LinearFit
    """The best fit with uncertainties that know that neighbouring dwells err alike."""

    @property
    def explained(self) -> LinearExplained[HeadTable]:
        """What settings, or dwells, were traced to."""
        return self.explanation.between

    @property
    def not_traced(self) -> str:
        """Why nothing was looked for; empty where it was."""
        return self.question or self.explained.table.not_traced

    @property
    def dwell_deg(self) -> float:
        """Standard deviation of a dwell about all that was found."""
        squares = float(np.sum(self.explanation.residual_deg**2))
        return float(np.sqrt(squares / max(self.degrees_of_freedom, 1)))

    @property
    def degrees_of_freedom(self) -> int:
        """Of the noise of a dwell."""
        return len(self.observations) - self.explanation.found - len(UNITS)

    @cached_property
    def next_experiment(self) -> tuple[Experiment, ...]:
        """What would part the rivals that are left."""
        return () if self.not_traced else next_reference_experiments(self.explained)


@one_blas_thread
def close_reference_loop(observations: HeadObservations) -> ReferenceLoop:
    """Find what makes a reference differ from the head.

    Where settings were visited again, their means are traced and their scatter is the noise; else the dwells are. Of a
    table that must be asked about, or of too few rows or settings, no parameter is stated.

    Raises
    ------
    ValueError
        The table holds no reference, or no usable row.
    """
    if not len(observations):
        raise ValueError(Message("{source}: no usable row", source=observations.source))
    if asked := question(observations):
        return _stated(observations, explain_head(_scene(observations), asked=True), asked[0])
    observations = _without_slips(observations, head_table(_scene(observations)).output)
    explanation = explain_head(_scene(observations), asked=False)
    if not explanation.settings.repeated:  # what was found hid slips from their neighbours
        cleaned = _without_slips(observations, explanation.residual_deg)
        if len(cleaned) < len(observations):
            observations, explanation = cleaned, explain_head(_scene(cleaned), asked=False)
    return _stated(observations, explanation, "")


def _scene(observations: HeadObservations) -> HeadScene:
    return HeadScene(dwells=as_dwells(observations))


def _without_slips(observations: HeadObservations, error_deg: FloatArray) -> HeadObservations:
    """The table without its gross errors, by what is left of the error of its dwells."""
    scene = _scene(observations)
    reference_deg = scene.dwells.observations.reference_deg
    assert reference_deg is not None, "as_dwells sees to that"
    found = slips(error_deg, reference_deg, _beside(scene), head_settings(scene))
    dwell = scene.dwells.number.tolist()
    rows = zip(observations.row.tolist(), dwell, strict=True)
    return observations.without(
        tuple(SetAside(row=row, reason=found[at], gross=True) for row, at in rows if at in found)
    )


def _beside(scene: HeadScene) -> NDArray[np.int64]:
    """Dwells in an order in which neighbours err alike: of a stream as they came, else by direction and angle."""
    if scene.dwells.streamed:
        return np.arange(scene.rows)
    return np.lexsort((scene.angle_deg, scene.direction))


def _stated(observations: HeadObservations, explanation: Explanation, asked: str) -> ReferenceLoop:
    between, settings = explanation.between, explanation.settings
    why = asked or between.table.not_traced
    fit = fit_found(between)
    before, after = (
        agreement(residual_deg, len(UNITS) + found, settings)
        for residual_deg, found in ((explanation.before_deg, 0), (explanation.residual_deg, explanation.found))
    )
    errors = () if asked else errors_by_setting(explanation.scene, explanation.error_deg, settings)
    changing = reversal(errors, before.pure_degrees_of_freedom) if before else None
    return ReferenceLoop(
        observations=replace(explanation.scene.dwells.observations, set_aside=observations.set_aside),
        rows_read=observations.rows_read,
        question=asked,
        declared=withheld(UNITS, why) if why else _declared(explanation),
        augmented=withheld(UNITS, why) if why else _augmented(explanation, fit),
        agreements=(None, None) if asked else (before, after),
        effects=_effects(explanation, fit),
        unexplained=() if asked else tuple(_unexplained(explanation, after, errors, changing)),
        by_setting=errors,
        reversal=changing,
        passes=None if asked else passes(explanation.scene, explanation.before_deg, explanation.residual_deg),
        warnings=tuple(filter(None, (*observations.warnings, why))),
        limits=() if asked else (*between.withheld, *limits(explanation.scene, settings)),
        explanation=explanation,
        fit=fit,
    )


def _declared(explanation: Explanation) -> ModelFit:
    return ModelFit(
        parameters=as_stated(explanation.between.before),
        residual_rms=rms(explanation.before_deg),
        held_out_rms=explanation.held_out_constant(),
    )


def _augmented(explanation: Explanation, fit: LinearFit) -> ModelFit:
    return ModelFit(
        parameters=stated(explanation.between, fit, UNITS),
        residual_rms=rms(explanation.residual_deg),
        held_out_rms=explanation.held_out_found(),
    )


def _effects(explanation: Explanation, fit: LinearFit) -> tuple[EffectFound, ...]:
    inside = () if explanation.within is None else explanation.within.effects
    return tuple(sorted((*explanation.between.effects(fit), *inside), key=lambda effect: effect.p_value))


def _unexplained(
    explanation: Explanation, after: Agreement | None, errors: tuple[AngleError, ...], changing: Reversal | None
) -> Iterator[Unexplained]:
    """Shapes without a name; where there are none, that settings differ by more than their repeats."""
    inside = () if explanation.within is None else explanation.within.unexplained
    shapes = (*explanation.between.unexplained, *inside)
    yield from shapes or left_by_setting(after, errors, changing)
