"""Effects of a head that is measured against a reference: errors of its angle, and of how the reference is read.

The output is what has to be added to the angle that the head reports to have that of the reference.
"""

from collections.abc import Sequence
from typing import Final

import numpy as np

from calibrations.effects.effect import Effect, Form, Forms, harmonic, plain, single, with_scanned
from calibrations.geometry import FloatArray
from calibrations.reference.scene import HeadScene

HIGHEST_ORDER: Final = 36
_READINGS_A_WAVE = 4
"""So many settings a wave are asked for: fewer would make a wave of any scatter."""


def wave(scene: HeadScene, order: int) -> FloatArray:
    """A sin(n φ + p), as a sine and a cosine of the angle at which the head was seen, shape (rows, 2)."""
    phase = np.deg2rad(order * scene.seen_deg)
    return np.column_stack([np.sin(phase), np.cos(phase)])


def _periods(order: int) -> Forms[HeadScene]:
    return lambda scene: (Form(columns=wave(scene, order)),) if settings(scene) >= 3 else ()


def settings(scene: HeadScene) -> int:
    """How many different degrees of the circle were visited."""
    return len(np.unique(np.round(scene.angle_deg % 360.0)))


def _order(order: int) -> Effect[HeadScene]:
    """So many periods a turn: each is an effect of its own, as a circle has any number of them."""

    def forms(scene: HeadScene) -> Sequence[Form]:
        seen = settings(scene) >= _READINGS_A_WAVE * order
        return (Form(columns=wave(scene, order), scanned={"order": float(order)}),) if seen else ()

    return Effect(
        name=f"graduation {order}",
        family="graduation",
        belongs_to="stand",
        symbol="A sin(nφ + p)",
        source="n per turn: graduation, worm, pole pairs of a resolver",
        forms=forms,
        report=with_scanned(harmonic, order=""),
    )


def _scale(scene: HeadScene) -> Sequence[Form]:
    return single(scene.turns) if np.ptp(scene.turns) > 0 else ()


def _backlash(scene: HeadScene) -> Sequence[Form]:
    back = (scene.direction < 0).astype(float)
    return single(back) if back.any() and not back.all() else ()


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
        name="head_eccentricity",
        belongs_to="stand",
        symbol="A sin(φ + p)",
        source="once per turn: eccentricity of the circle",
        forms=_periods(1),
        report=harmonic,
    ),
    Effect(
        name="head_second_harmonic",
        belongs_to="stand",
        symbol="A sin(2φ + p)",
        source="twice per turn: ellipticity or tilt of the circle",
        forms=_periods(2),
        report=harmonic,
    ),
    *(_order(order) for order in range(3, HIGHEST_ORDER + 1)),
    Effect(
        name="head_scale",
        belongs_to="stand",
        symbol="s per turn",
        source="steps per degree that do not suit the drive, or steps that it loses",
        forms=_scale,
        report=plain("head_scale", "deg/turn"),
    ),
    Effect(
        name="backlash",
        belongs_to="stand",
        symbol="b after a move in - direction",
        source="play of the drive",
        forms=_backlash,
        report=plain("backlash", "deg"),
    ),
    Effect(
        name="latency",
        belongs_to="reference",
        symbol="-τ times speed",
        source="the reference is read late",
        forms=_latency,
        report=plain("latency", "s"),
    ),
    Effect(
        name="reference_drift",
        belongs_to="reference",
        symbol="d t",
        source="reference or its coupling",
        forms=_drift,
        report=plain("reference_drift", "deg/h"),
    ),
    Effect(
        name="reference_temperature",
        belongs_to="reference",
        symbol="c T",
        source="expansion of the coupling",
        forms=_temperature,
        report=plain("reference_temperature", "deg/K"),
    ),
)
"""All of them. Of two that explain the data equally well with as many coefficients, the first gives its name."""
