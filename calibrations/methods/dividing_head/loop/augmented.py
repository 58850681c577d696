"""The declared model with what was found: parameters, coefficients and their uncertainty."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.budget import Source
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.effects.unnamed import unnamed
from tumble.calibrations.methods.dividing_head.fit import covariance
from tumble.calibrations.methods.dividing_head.joint import Joint, fit_rows
from tumble.calibrations.methods.dividing_head.loop.table import DividingHeadTable
from tumble.calibrations.methods.dividing_head.loop.tilted import Tilt, tilt_found
from tumble.calibrations.methods.dividing_head.model import (
    BASIS_SIZE,
    PARAMETERS,
    basis,
    coefficients,
    coefficients_jacobian,
)
from tumble.calibrations.tracing.components import Component, carried
from tumble.calibrations.tracing.courses import Course, Rows, courses
from tumble.calibrations.tracing.quantified import Quantified, expectations, form_in, slices, tangent
from tumble.calibrations.tracing.trace import Trace
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Augmented(Quantified):
    """A joint fit with further columns."""

    joint: Joint
    tilt: Tilt
    """Of the head's axis, by which the declared model's functions are foreshortened."""
    unnamed_v: Sequence[tuple[Component, FloatArray]]
    """Structure without a name, each with what is known of it in the rows of the fit."""

    @property
    def shapes(self) -> tuple[Source, ...]:
        """What is not known of the shape of effects that were found, as sources of uncertainty."""
        return (*self._adopted, *self.tilt.sources(self.joint.basis, self.joint.fit.theta))

    @property
    def _adopted(self) -> tuple[Source, ...]:
        return tuple(
            Source(
                name=Message("course of {name}", name=item.effect.name),
                symbol=Message("as far as it was not known when it was adopted"),
                errors_v=float(self.coefficients[columns][0]) * item.effect.unknown(self.joint.scene),
            )
            for item, columns in zip(self.found, self.columns, strict=True)
            if item.effect.unknown is not None
        )

    def courses(self, whole: DividingHeadTable, trace: Trace) -> tuple[Course, ...]:
        """What is known of structure without a name; `whole` is the table with the components of the trace."""
        slopes = self.joint.basis @ coefficients_jacobian(self.joint.fit.theta)
        rows = Rows(table=whole, noise=trace.noise, columns=slopes, residual=self.residual, dwell=self.dwell)
        return courses(rows, trace.components)

    def residual_v(self, scene: Scene) -> FloatArray:
        """Measured minus fitted for any rows of the same table, shape (rows,), in volts."""
        forms = [form_in(scene, item).columns for item in self.found]
        columns = np.column_stack([self.tilt.foreshortened(basis(scene.observations)), *forms])
        used = columns.shape[1] + len(PARAMETERS) - BASIS_SIZE
        residual_v = scene.observations.output_v - columns @ coefficients(self.joint.fit.theta[:used])
        along = {axis.name: axis for axis in unnamed(scene)} if self.unnamed_v else {}
        carried_v = [carried(component, part_v, along[component.axis.name]) for component, part_v in self.unnamed_v]
        return np.asarray(residual_v - sum(carried_v, np.zeros(scene.rows)))


def augment(table: DividingHeadTable, trace: Trace) -> Augmented:
    """Fit the declared model with what was found.

    What was scanned for counts as fitted: the change of each form with its scanned value is a column of its own.
    """
    chosen = trace.found
    first = _fit(table, trace, Tilt(), [item.form.columns for item in chosen])
    places = slices([item.form.columns.shape[1] for item in chosen])
    start = len(PARAMETERS)
    tangents = [
        tangent(table.scene, item, first.fit.theta[start + where.start : start + where.stop])
        for item, where in zip(chosen, places, strict=True)
    ]
    scanned = [change for change in tangents if change is not None]
    columns = [*(item.form.columns for item in chosen), *scanned]
    expected = expectations(chosen, places, first.noise.used_v)
    known = [(BASIS_SIZE + place, value, weight_v) for place, value, weight_v in expected]
    tilt = tilt_found(chosen, places, first.fit.theta[start:])
    joint = _fit(table, trace, tilt, columns, known) if scanned or known or tilt.rad else first
    everything = covariance(joint.compressed, joint.fit, joint.profile, joint.noise.used_v**2)
    numbers = iter(range(places[-1].stop if places else 0, len(joint.fit.theta)))
    further = everything[start:, start:]
    return Augmented(
        joint=joint,
        tilt=tilt_found(chosen, places, joint.fit.theta[start:], np.sqrt(np.diag(further))),
        unnamed_v=[(component, _known_v(table, trace, joint, component)) for component in trace.components],
        found=chosen,
        columns=tuple(places),
        scanned=tuple(None if t is None else next(numbers) for t in tangents),
        coefficients=joint.fit.theta[start:],
        covariance=further,
        residual=joint.residual_v,
        dwell=joint.noise.used_v,
    )


def _known_v(table: DividingHeadTable, trace: Trace, joint: Joint, component: Component) -> FloatArray:
    """What is known of a component in the rows of the fit: its mean given the rows, in volts."""
    root, level = np.sqrt(joint.weights), table.memory.levels[component.name]
    shown = level.T @ (joint.residual_v * root)
    return np.asarray(dict(trace.noise.levels)[component.name] * (level @ shown) / root)


def _fit(
    table: DividingHeadTable,
    trace: Trace,
    tilt: Tilt,
    columns: Sequence[FloatArray],
    known: Sequence[tuple[int, float, float]] = (),
) -> Joint:
    functions = np.column_stack([tilt.foreshortened(table.declared), *columns])
    return fit_rows(
        table.joint.observations, functions, table.joint.weights, table.memory.whitening(trace.noise), known
    )
