"""What a stand can add to a measurement: terms that are linear in their coefficients."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

from tumble.messages import Message

ECCENTRICITY: Final = Message.named("head_eccentricity", "eccentricity of the head's circle")
SECOND_HARMONIC: Final = Message.named("head_second_harmonic", "second harmonic of the head's circle")
GRADUATION: Final = Message.named("graduation", "graduation error")
"""Waves of any order above the second, each an effect of its own."""
BACKLASH: Final = Message("backlash")
AXIS_TILT: Final = Message.named("axis_tilt", "tilt of the head's axis")
DAQ_NONLINEARITY: Final = Message.named("daq_nonlinearity", "nonlinearity of the DAQ")
RANGE_STEP: Final = Message.named("range_step", "step between ranges")
HEAD_COURSE: Final = "head_course"
"""An error of the head that no effect of the catalogue describes, as all harmonics that the settings can tell."""
_ORDERS: Final[Mapping[str, int]] = {ECCENTRICITY: 1, SECOND_HARMONIC: 2}
_VOLTAGE: Final[Mapping[str, str]] = {AXIS_TILT: "deg", DAQ_NONLINEARITY: "V", RANGE_STEP: "V"}
"""Effects that are taken off the voltage, with the unit of their coefficients."""

_OUTER, _INNER = Message("outer"), Message("inner")
TWO_AXES: Final[tuple[Message, ...]] = (
    Message.named("axes_orthogonality", "axes of the stand not square"),
    Message.named("outer_eccentricity", "eccentricity of the {axis} axis", axis=_OUTER),
    Message.named("outer_second_harmonic", "second harmonic of the {axis} axis", axis=_OUTER),
    Message.named("outer_backlash", "backlash of the {axis} axis", axis=_OUTER),
    Message.named("inner_eccentricity", "eccentricity of the {axis} axis", axis=_INNER),
    Message.named("inner_second_harmonic", "second harmonic of the {axis} axis", axis=_INNER),
    Message.named("inner_backlash", "backlash of the {axis} axis", axis=_INNER),
    Message.named("outer_wobble", "wobble of the outer axis"),
    Message.named("inner_wobble", "wobble of the inner axis"),
)
"""Effects of a stand with two axes, each with an axis of its own; they are taken off the outputs, in arc seconds."""
_SINGLE: Final = ("axes_orthogonality", "outer_backlash", "inner_backlash")
"""Of these, those of one coefficient; the others have a sine and a cosine."""

LASTING: Final[tuple[str, ...]] = (*_ORDERS, GRADUATION, BACKLASH, *_VOLTAGE)
"""Effects of the catalogue that stay with a stand; a seat, a leaning base or a settling belongs to the run."""
_NAMES: Final[Mapping[str, str]] = {name: name for name in (*LASTING, *TWO_AXES)}
"""What a reader is shown for the name of an effect, which a record holds as text."""


@dataclass(frozen=True, kw_only=True)
class Term:
    """One effect of a stand, without its coefficients."""

    effect: str
    """Its name in the catalogue, or `HEAD_COURSE`."""
    orders: tuple[int, ...] = ()
    """Periods a turn of an error of the head."""
    scanned: Mapping[str, float] = field(default_factory=dict)
    """What enters nonlinearly: the period of a converter's error, the threshold of a step, in volts."""

    @property
    def size(self) -> int:
        """Number of coefficients: a sine and a cosine for each order, and for a wave of the voltage."""
        if self.orders:
            return 2 * len(self.orders)
        wave = self.effect == DAQ_NONLINEARITY or (self.effect in TWO_AXES and self.effect not in _SINGLE)
        return 2 if wave else 1

    @property
    def unit(self) -> str:
        """Of the coefficients."""
        return "arcsec" if self.effect in TWO_AXES else _VOLTAGE.get(self.effect, "deg")

    @property
    def of_angle(self) -> bool:
        """Whether it is an error of the angle, which a head map holds; otherwise it is taken off the voltage."""
        return self.effect not in (*_VOLTAGE, *TWO_AXES)

    @property
    def label(self) -> str:
        """What to call it in a sentence."""
        if self.effect == HEAD_COURSE:
            return Message("an error of the head of any shape (1 to {highest} per turn)", highest=max(self.orders))
        name = _NAMES.get(self.effect, self.effect)
        if self.effect == GRADUATION:
            return Message("{effect} ({order} per turn)", effect=name, order=self.orders[0])
        if not self.scanned:
            return name
        scanned = ", ".join(f"{key.removesuffix('_V')} {value:.4g} V" for key, value in self.scanned.items())
        return Message("{effect} ({values})", effect=name, values=scanned)


def harmonic_term(order: int) -> Term:
    """An error of the head so many times a turn, by the name that the catalogue has for it."""
    named = {number: name for name, number in _ORDERS.items()}
    return Term(effect=named.get(order, GRADUATION), orders=(order,))


def head_course(highest: int) -> Term:
    """An error of the head of any shape."""
    return Term(effect=HEAD_COURSE, orders=tuple(range(1, highest + 1)))


def union(first: tuple[Term, ...], second: tuple[Term, ...]) -> tuple[Term, ...]:
    """Terms of two runs together.

    A course of the head holds all its orders, so that single ones go into it; what is scanned is taken halfway.
    """
    merged: dict[tuple[str, tuple[int, ...]], Term] = {}
    for term in (*first, *second):
        key = (term.effect, term.orders)
        merged[key] = _halfway(merged[key], term) if key in merged else term
    course = max((term for term in merged.values() if term.effect == HEAD_COURSE), key=lambda t: t.size, default=None)
    if course is None:
        return tuple(merged.values())
    beside = [t for t in merged.values() if t.effect != HEAD_COURSE and not set(t.orders or (0,)) <= set(course.orders)]
    return (course, *beside)


def _halfway(first: Term, second: Term) -> Term:
    scanned = {key: (value + second.scanned[key]) / 2 for key, value in first.scanned.items()}
    return Term(effect=first.effect, orders=first.orders, scanned=scanned)
