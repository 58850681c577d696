"""What a stand adds to a measurement, with one covariance."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import chdtrc

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.quantities import format_concise
from tumble.calibrations.stand_records.head_map import HeadMap
from tumble.calibrations.stand_records.terms import BACKLASH, Term, harmonic_term
from tumble.messages import Message


@dataclass(frozen=True, kw_only=True)
class Corrections:
    """Terms of a stand with their coefficients."""

    terms: tuple[Term, ...]
    values: FloatArray
    """Coefficients of all terms, one after the other, each in the unit of its term."""
    covariance: FloatArray
    """Shape (coefficients, coefficients)."""

    def place(self, term: Term) -> slice:
        """Where the coefficients of a term are."""
        start = sum(each.size for each in self.terms[: self.terms.index(term)])
        return slice(start, start + term.size)

    def without_a_place_for(self, terms: Sequence[Term]) -> list[Term]:
        """Those of the terms that these corrections do not have; a course of the head may be all their harmonics."""
        orders = {order for term in self.terms for order in term.orders}
        effects = {term.effect for term in self.terms if not term.orders}
        return [
            term
            for term in terms
            if (term.orders and not orders & set(term.orders)) or (not term.orders and term.effect not in effects)
        ]

    def p_value(self, term: Term) -> float:
        """Probability of coefficients so far from zero by chance (chi-square)."""
        here = self.place(term)
        return chi_square_p(self.values[here], self.covariance[here, here])

    @property
    def head_map(self) -> HeadMap | None:
        """The errors of the angle; None where there are none."""
        waves = [term for term in self.terms if term.orders]
        back = [term for term in self.terms if term.effect == BACKLASH]
        if not waves and not back:
            return None
        places = [np.arange(self.place(term).start, self.place(term).stop) for term in (*waves, *back)]
        chosen = np.concatenate(places)
        size = len(chosen) + (not back)
        coefficients, covariance = np.zeros(size), np.zeros((size, size))
        coefficients[: len(chosen)] = self.values[chosen]
        covariance[: len(chosen), : len(chosen)] = self.covariance[np.ix_(chosen, chosen)]
        orders = tuple(order for term in waves for order in term.orders)
        return HeadMap(orders=orders, coefficients_deg=coefficients, covariance_deg2=covariance)

    def text(self, term: Term) -> str:
        """A term with its standard uncertainty: `axis_tilt 0.0498(5)°`; of a wave, amplitude and phase."""
        here = self.place(term)
        values, covariance = self.values[here], self.covariance[here, here]
        if term.size == 1:
            value = format_concise(float(values[0]), float(np.sqrt(covariance[0, 0])), term.unit)
            return Message("{term} {value}", term=term.label, value=value)
        amplitude = float(np.linalg.norm(values))
        along = values / amplitude
        text = format_concise(amplitude, float(np.sqrt(along @ covariance @ along)), term.unit)
        if term.size != 2:  # a sine and a cosine
            return Message("{term} amplitude {amplitude}", term=term.label, amplitude=text)
        return Message(
            "{term} amplitude {amplitude}, phase {phase_deg:.0f}°",
            term=term.label,
            amplitude=text,
            phase_deg=np.degrees(np.arctan2(values[1], values[0])) % 360.0,
        )

    def as_json(self) -> dict[str, Any]:
        """Plain data; the inverse of `corrections_from_json`."""
        terms = [
            {
                "effect": term.effect,
                "orders": list(term.orders),
                "scanned": dict(term.scanned),
                "unit": term.unit,
                "coefficients": self.values[self.place(term)].tolist(),
            }
            for term in self.terms
        ]
        return {"terms": terms, "covariance": self.covariance.tolist()}


def corrections_from_json(content: Mapping[str, Any]) -> Corrections:
    """Undo `Corrections.as_json`."""
    terms = tuple(
        Term(effect=entry["effect"], orders=tuple(entry["orders"]), scanned=entry["scanned"])
        for entry in content["terms"]
    )
    values = [value for entry in content["terms"] for value in entry["coefficients"]]
    size = len(values)
    covariance = np.array(content["covariance"], dtype=float).reshape(size, size)
    return Corrections(terms=terms, values=np.array(values, dtype=float), covariance=covariance)


def corrections_from_map(head_map: HeadMap) -> Corrections:
    """A head map that came from elsewhere, such as a head held against a reference."""
    waves = tuple(harmonic_term(order) for order in head_map.orders)
    size = len(head_map.coefficients_deg) - (not head_map.covariance_deg2[-1, -1])
    backlash = (Term(effect=BACKLASH),) if size == len(head_map.coefficients_deg) else ()
    return Corrections(
        terms=(*waves, *backlash),
        values=head_map.coefficients_deg[:size],
        covariance=head_map.covariance_deg2[:size, :size],
    )


def chi_square_p(values: FloatArray, covariance: FloatArray) -> float:
    """Probability of values so far from zero, or further, if they have this covariance."""
    return float(chdtrc(len(values), values @ np.linalg.solve(covariance, values)))
