"""What one run says of the stand on which it was made."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.core.sentences import equals, series
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty, sources
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.effects.stand import HIGHEST_ORDER
from tumble.calibrations.methods.dividing_head.fit import covariance
from tumble.calibrations.methods.dividing_head.joint import LACK_OF_FIT_P, Joint, fit_rows
from tumble.calibrations.methods.dividing_head.loop.loop import Explained, Loop
from tumble.calibrations.methods.dividing_head.model import PARAMETERS
from tumble.calibrations.methods.dividing_head.stand.columns import columns_v, tangent_v
from tumble.calibrations.stand_records.corrections import Corrections
from tumble.calibrations.stand_records.terms import LASTING, Term, harmonic_term, head_course, union
from tumble.calibrations.tracing.components import Component
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.trace import Found, Trace
from tumble.messages import Message

_ANGLE: Final = "angle"
_HARMONICS: Final = {"head_eccentricity": 1, "head_second_harmonic": 2, "graduation": None}
"""Effects that are one harmonic of the angle, with its order; None where the order is found."""
_SCANNED: Final = {"daq_nonlinearity": ("period_V",), "range_step": ("threshold_V",)}


@dataclass(frozen=True, kw_only=True)
class Run:
    """A table with the loop closed on it, as far as its stand is concerned."""

    loop: Loop
    explained: Explained
    uncertainty: StandUncertainty

    @property
    def terms(self) -> tuple[Term, ...]:
        """Effects of the stand that the run distinguishes."""
        return union(tuple(self._terms()), ())

    @property
    def doubtful(self) -> Mapping[str, tuple[str, ...]]:
        """Effects that may or may not be of the stand, with what they could be as well."""
        return {
            effect.name: effect.also_possible
            for effect in self.loop.effects
            if effect.also_possible and set(LASTING) & {effect.name, *effect.also_possible}
        }

    @property
    def objections(self) -> tuple[str, ...]:
        """Why nothing may be learned from the run, as parts of a sentence; empty for a good run."""
        after = self.loop.augmented
        unexplained = self.loop.unexplained
        reasons = {
            Message("it was cut off"): not after.observations.complete,
            Message("nothing was traced"): bool(self.loop.not_traced),
            Message("part of what it leaves is unexplained"): unexplained is not None
            and unexplained.depends_on != _ANGLE,
        }
        p_value = after.lack_of_fit_p
        if p_value is not None and p_value < LACK_OF_FIT_P:
            disagree = Message("the poses disagree with what was found (p {p_value})", p_value=equals(p_value))
            reasons[disagree] = True
        return tuple(reason for reason, holds in reasons.items() if holds)

    def estimate(self, terms: Sequence[Term]) -> Corrections:
        """Coefficients of those of these terms that are identifiable, fitted together with what else was found.

        What could as well be one of the terms gives way to it. The covariance holds the scatter of the data and what
        seat and voltmeter add; the head's own uncertainty is what is sought.
        """
        trace = self._without(terms)
        first = _fit(self.explained, trace, [columns_v(term, self._scene) for term in terms])
        start = len(PARAMETERS)
        roughly = _cut(terms, first.fit.theta[start:])
        tangents = [tangent_v(term, self._scene, value) for term, value in zip(terms, roughly, strict=True)]
        columns = [*(columns_v(term, self._scene) for term in terms), *(t for t in tangents if t is not None)]
        joint = _fit(self.explained, trace, columns)
        here = slice(start, start + sum(term.size for term in terms))
        identifiable = [bool(mask.all()) for mask in _cut(terms, joint.fit.estimable[here])]
        if not all(identifiable):
            return self.estimate([term for term, is_so in zip(terms, identifiable, strict=True) if is_so])
        scatter = covariance(joint.compressed, joint.fit, joint.profile, joint.noise.used_v**2)
        return Corrections(
            terms=tuple(terms),
            values=joint.fit.theta[here],
            covariance=scatter[here, here] + self._of_the_stand(joint)[here, here],
        )

    @property
    def highest_order(self) -> int:
        """Of an error of the head that is identifiable from the settings of the head."""
        settings = len(np.unique(np.round(self._scene.angle_deg % 360.0, 1)))
        return min(HIGHEST_ORDER, (settings - 1) // 2)

    @property
    def _scene(self) -> Scene:
        return self.explained.table.scene

    def _terms(self) -> Iterator[Term]:
        distinguished = {effect.name: effect for effect in self._lasting() if not effect.also_possible}
        if any(_of_the_head(component) for component in self.explained.trace.components):
            yield head_course(self.highest_order)
        for item in self.explained.trace.found:
            if item.effect.name in distinguished and _is_harmonic(item):
                yield harmonic_term(_order(item))
        yield from (_term(effect) for effect in distinguished.values() if effect.name not in _HARMONICS)

    def _lasting(self) -> list[EffectFound]:
        return [effect for effect in self.loop.effects if effect.name in LASTING]

    def _without(self, terms: Sequence[Term]) -> Trace:
        """The trace without what the terms stand for."""
        trace, names = self.explained.trace, {term.effect for term in terms}
        rivals = {effect.name for effect in self.loop.effects if names & set(effect.also_possible)}
        courses = [each.name for each in trace.components if _of_the_head(each)]
        for name in (*(rivals - names), *courses):
            trace = trace.without(name)
        return replace(trace, found=tuple(item for item in trace.found if not _stands_for(terms, item)))

    def _of_the_stand(self, joint: Joint) -> FloatArray:
        """Covariance of all parameters from what the stand file says of seat and voltmeter."""
        listed = sources(joint.scene, replace(self.uncertainty, head_accuracy_arcsec=0.0, record=None))
        shifts = [joint.fit.inverse @ source.turned(joint.compressed.rotation) for source in listed]
        size = len(joint.fit.theta)
        return np.asarray(sum((shift @ shift.T for shift in shifts), start=np.zeros((size, size))))


def _fit(explained: Explained, trace: Trace, columns: Sequence[FloatArray]) -> Joint:
    """The declared model with further columns and what else was found."""
    base = explained.table
    functions = np.column_stack([base.declared, *columns, *(form.columns for form in trace.forms)])
    return fit_rows(base.joint.observations, functions, base.joint.weights, base.memory.whitening(trace.noise))


def _term(effect: EffectFound) -> Term:
    """An effect with what was scanned for, as it is reported."""
    scanned = {key: effect.coefficients[key].value for key in _SCANNED.get(effect.name, ())}
    return Term(effect=effect.name, scanned=scanned)


def _of_the_head(component: Component) -> bool:
    """Whether structure without a name is one of the circle, whichever way the head turned."""
    return component.axis.coordinate.word == _ANGLE and not component.axis.channel.detail


def _is_harmonic(item: Found) -> bool:
    return item.effect.name in _HARMONICS


def _order(item: Found) -> int:
    return _HARMONICS[item.effect.name] or int(item.form.scanned["order"])


def _stands_for(terms: Sequence[Term], item: Found) -> bool:
    """Whether one of the terms is the same as what was found, or holds it."""
    if _is_harmonic(item):
        return any(_order(item) in term.orders for term in terms)
    return any(term.effect == item.effect.name for term in terms)


def _cut(terms: Sequence[Term], values: NDArray[Any]) -> list[NDArray[Any]]:
    """What there is one of for each coefficient, term by term."""
    ends = np.cumsum([term.size for term in terms]).tolist()
    return [values[end - term.size : end] for end, term in zip(ends, terms, strict=True)]


def doubts(run: Run) -> list[str]:
    """Sentences on effects of the stand that are not distinguishable in the run from others."""
    return [
        Message(
            "in this run alone {effect} is not distinguishable from {others}: by itself it says nothing of it",
            effect=name,
            others=series(others, "or"),
        )
        for name, others in run.doubtful.items()
    ]
