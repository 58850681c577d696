"""What one run of a gyro platform says of the turntable on which it was made."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.loop import GyrocompassLoop
from tumble.calibrations.methods.gyrocompass.observations import GyrocompassObservations
from tumble.calibrations.methods.gyrocompass.stand.terms import LASTING, columns, term_of
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.loop_run import LoopRun
from tumble.calibrations.stand_records.record import Validity
from tumble.calibrations.stand_records.terms import Term

_SEEN: Final = 1e-3
"""A term of which less than this part is left beside all others is not told from them."""


@dataclass(frozen=True, kw_only=True)
class GyrocompassRun(LoopRun):
    """A table with the loop closed on it, as far as its turntable is concerned."""

    lasting = LASTING

    loop: GyrocompassLoop

    @property
    def terms(self) -> tuple[Term, ...]:
        """Errors of the turntable that the run tells apart."""
        return tuple(term_of(each) for each in self.loop.effects if each.name in LASTING and not each.also_possible)

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """Coefficients of those of these terms that the positions tell, fitted together with what else was found."""
        told = tuple(term for term in terms if self._tells(term, terms))
        if len(told) < len(terms):
            return self.estimate(told)
        design, misfit, variance = self._whitened(terms)
        inverse = np.linalg.pinv(design)
        size = sum(term.size for term in terms)
        return Corrections(
            terms=told, values=(inverse @ misfit)[:size], covariance=(variance * inverse @ inverse.T)[:size, :size]
        )

    def validity(self, measured_at: str) -> Validity:
        """Over what it was measured."""
        return validity_of(self.loop.observations, measured_at)

    def _tells(self, term: Term, terms: Sequence[Term]) -> bool:
        """Whether a term keeps something of its own beside the others and the model."""
        others = [each for each in terms if each != term]
        design, _, _ = self._whitened([term, *others])
        own, rest = design[:, : term.size], design[:, term.size :]
        length = np.linalg.norm(own, axis=0)
        if not length.all():
            return False
        rest = rest / np.linalg.norm(rest, axis=0).clip(1e-300)
        left = own - rest @ np.linalg.lstsq(rest, own, rcond=1e-9)[0]
        return bool(np.linalg.svd(left / length, compute_uv=False).min() > _SEEN)

    def _whitened(self, terms: Sequence[Term]) -> tuple[FloatArray, FloatArray, float]:
        """These terms, the model and what else was found, white; what is left of the model; and its variance.

        What was found and is, or could as well be, an error of the turntable gives way to the terms.
        """
        explained, table, fit = self.loop.explained, self.loop.explained.table, self.loop.best
        rivals = {each.name for each in self.loop.effects if set(LASTING) & {each.name, *each.also_possible}}
        beside = [item.form.columns for item in explained.trace.found if item.effect.name not in rivals]
        model = table.model
        theta = fit.theta[: model.parameters]
        left = table.output - table.declared @ model.coefficients(theta)
        root, whiten = np.sqrt(table.weights), table.memory.whitening(explained.trace.noise)
        slopes = table.declared @ model.slopes(theta)
        design = whiten(np.column_stack([columns(terms, table.scene), slopes, *beside]) * root[:, None])
        misfit = whiten(left * root)
        solved = np.linalg.lstsq(design, misfit, rcond=None)[0]
        freedom = max(len(misfit) - design.shape[1], 1)
        return design, misfit, float(np.sum((misfit - design @ solved) ** 2)) / freedom


def validity_of(rows: GyrocompassObservations, measured_at: str = "") -> Validity:
    """Over what a table was measured."""
    degc = rows.temperature_degc
    known = degc is not None and np.isfinite(degc).any()
    return Validity(
        angle_deg=_ends(rows.azimuth_deg),
        temperature_degc=_ends(degc) if degc is not None and known else None,
        measured_from=measured_at,
        measured_to=measured_at,
    )


def _ends(values: FloatArray) -> tuple[float, float]:
    return float(np.nanmin(values)), float(np.nanmax(values))
