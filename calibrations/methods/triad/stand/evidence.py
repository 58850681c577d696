"""What one run of a triad says of the stand on which it was made."""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.loop import TriadLoop
from tumble.calibrations.methods.triad.model import INTERNAL
from tumble.calibrations.methods.triad.observations import TriadObservations
from tumble.calibrations.methods.triad.stand.columns import LASTING, form_of
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.loop_run import LoopRun
from tumble.calibrations.stand_records.record import Validity
from tumble.calibrations.stand_records.terms import Term

_SCANNED: Final = {"daq_nonlinearity": ("period_V",), "range_step": ("threshold_V",)}
_SEEN: Final = 1e-3
"""A column of which less than this part is left beside all others is not told from them."""


@dataclass(frozen=True, kw_only=True)
class TriadRun(LoopRun):
    """A table with the loop closed on it, as far as its stand is concerned."""

    lasting = LASTING

    loop: TriadLoop

    @property
    def terms(self) -> tuple[Term, ...]:
        """Effects of the stand that the run tells apart."""
        return tuple(
            Term(
                effect=effect.name,
                scanned={key: effect.coefficients[key].value for key in _SCANNED.get(effect.name, ())},
            )
            for effect in self.loop.effects
            if effect.name in LASTING and not effect.also_possible
        )

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """Coefficients of those of these terms that the positions tell, fitted together with what else was found."""
        forms = {term.effect: form_of(term, self.loop.explained.table.scene) for term in terms}
        shown = [term for term in terms if forms[term.effect] is not None]
        columns = [form.columns for form in forms.values() if form is not None]
        sizes = np.cumsum([0, *(each.shape[1] for each in columns)]).tolist()
        design, misfit, variance = self._whitened(columns, [term.effect for term in shown])
        told = [_told(design, slice(INTERNAL + first, INTERNAL + last)) for first, last in itertools.pairwise(sizes)]
        if not all(told):
            return self.estimate([term for term, is_so in zip(shown, told, strict=True) if is_so])
        inverse = np.linalg.pinv(design)
        here = slice(INTERNAL, INTERNAL + sizes[-1])
        return Corrections(
            terms=tuple(shown),
            values=(inverse @ misfit)[here],
            covariance=(variance * inverse @ inverse.T)[here, here],
        )

    def validity(self, measured_at: str) -> Validity:
        """Over what it was measured."""
        return validity_of(self.loop.observations, measured_at)

    def _whitened(self, columns: Sequence[FloatArray], names: Sequence[str]) -> tuple[FloatArray, FloatArray, float]:
        """Declared model, these columns and what else was found: design and outputs, white, and their variance.

        What was found and could as well be one of the terms gives way to it.
        """
        explained, table, fit = self.loop.explained, self.loop.explained.table, self.loop.best
        rivals = {each.name for each in self.loop.effects if set(names) & {each.name, *each.also_possible}}
        beside = [item.form.columns for item in explained.trace.found if item.effect.name not in rivals]
        model = table.model
        slopes = table.declared @ model.slopes(fit.theta)
        left = table.output - table.declared @ model.coefficients(fit.theta)
        root, whiten = np.sqrt(table.weights), table.memory.whitening(explained.trace.noise)
        design = whiten(np.column_stack([slopes, *columns, *beside]) * root[:, None])
        misfit = whiten(left * root)
        solved = np.linalg.lstsq(design, misfit, rcond=None)[0]
        freedom = max(len(misfit) - design.shape[1], 1)
        return design, misfit, float(np.sum((misfit - design @ solved) ** 2)) / freedom


def _told(design: FloatArray, here: slice) -> bool:
    """Whether columns keep something of their own beside the others."""
    own = design[:, here]
    others = np.delete(design, np.arange(here.start, here.stop), axis=1)
    others = others / np.linalg.norm(others, axis=0).clip(1e-300)
    left = own - others @ np.linalg.lstsq(others, own, rcond=1e-9)[0]
    values = np.linalg.svd(left / np.linalg.norm(own, axis=0).clip(1e-300), compute_uv=False)
    return bool(values.min() > _SEEN)


def validity_of(rows: TriadObservations, measured_at: str = "") -> Validity:
    """Over what a table was measured; the angles are those of both axes."""
    known = [each for each in rows.temperatures_degc() if each is not None and np.isfinite(each).any()]
    return Validity(
        angle_deg=_ends(np.concatenate([rows.outer_deg, rows.inner_deg])),
        voltage_v=_ends(rows.outputs_v),
        temperature_degc=_ends(np.concatenate(known)) if known else None,
        measured_from=measured_at,
        measured_to=measured_at,
    )


def _ends(values: FloatArray) -> tuple[float, float]:
    return float(np.nanmin(values)), float(np.nanmax(values))
