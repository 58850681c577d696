"""Effects of a head that is measured against a reference: errors of its angle, and of how the reference is read.

The output is what has to be added to the angle that the head reports to have that of the reference.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.stand_records.terms import BACKLASH, ECCENTRICITY, GRADUATION, SECOND_HARMONIC
from tumble.calibrations.tracing.effect import Effect, Form, Forms, harmonic, plain, single, with_scanned
from tumble.messages import Message

HIGHEST_ORDER: Final = 36
TIMED: Final = ("reference_drift", "reference_temperature")
"""What changes between two visits to one setting."""
NEVER: Final = 1e9
"""Doubt in a shape that the settings cannot show by themselves: it may stand for what was found, and is never found."""
_READINGS_A_WAVE = 4
"""So many settings a wave are asked for: fewer would make a wave of any scatter."""
_FEWEST_ANGLES = 5
"""A wave and an offset are three numbers; so many angles leave two to contradict them."""
_FEWEST_FOR_A_SLOPE = 2
_ARC_DEG: Final = {1: 170.0, 2: 144.0}
"""Once and twice a turn are known of circles: so much of the circle must have been visited to tell them."""
_UNKNOWN_PERIODS = 2.0
"""What comes so many times a turn, nobody knows how many, was seen to come back only where that much was visited."""


def wave(scene: HeadScene, order: int) -> FloatArray:
    """A sin(n φ + p), as a sine and a cosine of the angle at which the head was seen, shape (rows, 2)."""
    phase = np.deg2rad(order * scene.seen_deg)
    return np.column_stack([np.sin(phase), np.cos(phase)])


def _periods(order: int) -> Forms[HeadScene]:
    """Waves that circles are known for. On a shorter arc they are rivals of whatever was found, and are never found."""

    def forms(scene: HeadScene) -> Sequence[Form]:
        if scene.distinct_angles < _FEWEST_ANGLES:
            return ()
        seen = scene.arc_deg >= _ARC_DEG[order]
        return (Form(columns=wave(scene, order), penalty=0.0 if seen else NEVER),)

    return forms


def _order(order: int) -> Effect[HeadScene]:
    """So many periods a turn: each is an effect of its own, as a circle has any number of them."""

    def forms(scene: HeadScene) -> Sequence[Form]:
        periods = scene.arc_deg * order / 360.0
        seen = scene.distinct_angles >= _READINGS_A_WAVE * periods and periods >= _UNKNOWN_PERIODS
        return (Form(columns=wave(scene, order), scanned={"order": float(order)}),) if seen else ()

    return Effect(
        name=Message.named(f"graduation {order}", "graduation error, {order} per turn", order=order),
        family=GRADUATION,
        depends_on="angle",
        belongs_to="stand",
        symbol="A sin(nφ + p)",
        source=Message("n per turn: graduation, worm, pole pairs of a resolver"),
        forms=forms,
        report=with_scanned(harmonic, order=""),
    )


def _scale(scene: HeadScene) -> Sequence[Form]:
    return single(scene.turns) if scene.distinct_angles > _FEWEST_FOR_A_SLOPE else ()


def _backlash(scene: HeadScene) -> Sequence[Form]:
    """Play, where some angles were reached from both sides; else it is the same as a step of the error."""
    return single((scene.direction < 0).astype(float)) if scene.both_ways else ()


def _latency(scene: HeadScene) -> Sequence[Form]:
    """The reference tells where the head was so long ago: less than the head reports while its angle grows."""
    late = scene.late_deg_per_s
    return () if late is None or not np.ptp(late) else single(late)


def _drift(scene: HeadScene) -> Sequence[Form]:
    return single(scene.hours) if scene.hours is not None and np.ptp(scene.hours) > 0 else ()


def _temperature(scene: HeadScene) -> Sequence[Form]:
    return single(scene.temperature_k) if scene.temperature_k is not None and np.ptp(scene.temperature_k) > 0 else ()


HEAD_EFFECTS: tuple[Effect[HeadScene], ...] = (
    Effect(
        name=ECCENTRICITY,
        depends_on="angle",
        belongs_to="stand",
        symbol="A sin(φ + p)",
        source=Message("once per turn: eccentricity of the circle"),
        forms=_periods(1),
        report=harmonic,
    ),
    Effect(
        name=SECOND_HARMONIC,
        depends_on="angle",
        belongs_to="stand",
        symbol="A sin(2φ + p)",
        source=Message("twice per turn: ellipticity or tilt of the circle"),
        forms=_periods(2),
        report=harmonic,
    ),
    *(_order(order) for order in range(3, HIGHEST_ORDER + 1)),
    Effect(
        name=Message.named("head_scale", "scale of the head"),
        depends_on="angle",
        belongs_to="stand",
        symbol=Message("s per turn"),
        source=Message("steps per degree that do not suit the drive, or steps that it loses"),
        forms=_scale,
        report=plain("head_scale", "deg/turn"),
    ),
    Effect(
        name=BACKLASH,
        depends_on="direction",
        belongs_to="stand",
        symbol=Message("b after a move in - direction"),
        source=Message("play of the drive"),
        forms=_backlash,
        report=plain(BACKLASH, "deg"),
    ),
    Effect(
        name=Message("latency"),
        depends_on="time",
        belongs_to="reference",
        symbol=Message("-τ times speed"),
        source=Message("the reference is read late"),
        forms=_latency,
        report=plain("latency", "s"),
    ),
    Effect(
        name=Message.named("reference_drift", "drift of the reference"),
        depends_on="time",
        belongs_to="reference",
        symbol="d t",
        source=Message("reference or its coupling"),
        forms=_drift,
        report=plain("reference_drift", "deg/h"),
    ),
    Effect(
        name=Message.named("reference_temperature", "temperature sensitivity of the reference"),
        depends_on="temperature",
        belongs_to="reference",
        symbol="c T",
        source=Message("expansion of the coupling"),
        forms=_temperature,
        report=plain("reference_temperature", "deg/K"),
    ),
)
"""All of them. Of two that explain the data equally well with as many coefficients, the first gives its name."""
