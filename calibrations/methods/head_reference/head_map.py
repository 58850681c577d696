"""The head map that a table of head and reference gives: a reference needs no second unit to agree."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from tumble.calibrations.methods.head_reference.loop import ReferenceLoop
from tumble.calibrations.stand_records.corrections import Corrections, corrections_from_map
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.calibrations.stand_records.terms import BACKLASH, Term

_ORDERS = {"head_eccentricity": 1, "head_second_harmonic": 2}


def head_map(loop: ReferenceLoop) -> HeadMap | None:
    """Harmonics and backlash with their covariance; None where there is neither.

    Backlash that could as well be something else is left out. Latency, drift and what adds up from turn to turn are no
    errors of the circle, and have no place in a map.
    """
    waves, back = _places(loop)
    if not waves and not back:
        return None
    chosen = np.array([column for _, place in waves for column in place] + back, dtype=int)
    size = len(chosen) + (not back)
    coefficients, covariance = np.zeros(size), np.zeros((size, size))
    coefficients[: len(chosen)] = loop.fit.coefficients[chosen]
    covariance[: len(chosen), : len(chosen)] = loop.fit.covariance[np.ix_(chosen, chosen)]
    return HeadMap(orders=tuple(order for order, _ in waves), coefficients_deg=coefficients, covariance_deg2=covariance)


def _places(loop: ReferenceLoop) -> tuple[list[tuple[int, list[int]]], list[int]]:
    """Columns of each harmonic, and of the backlash."""
    waves, back = [], []
    for item, columns in zip(loop.fit.found, loop.fit.columns, strict=True):
        name, place = item.effect.name, list(range(columns.start, columns.stop))
        if name in _ORDERS or "order" in item.form.scanned:
            waves.append((_ORDERS.get(name) or round(item.form.scanned["order"]), place))
        elif name == BACKLASH and not loop.explained.close[name]:
            back = place
    return sorted(waves), back


@dataclass(frozen=True, kw_only=True)
class ReferenceRun:
    """A table of head and reference as far as a stand record is concerned."""

    whole: Corrections

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """What it says of these terms; of those that it does not have, nothing."""
        known = tuple(term for term in terms if term in self.whole.terms)
        chosen = np.concatenate([np.arange(place.start, place.stop) for place in map(self.whole.place, known)])
        return Corrections(
            terms=known, values=self.whole.values[chosen], covariance=self.whole.covariance[np.ix_(chosen, chosen)]
        )


def reference_run(loop: ReferenceLoop) -> ReferenceRun | None:
    """What a table of head and reference gives to a stand record; None where it shows no error of the circle."""
    found = head_map(loop)
    return None if found is None else ReferenceRun(whole=corrections_from_map(found))
