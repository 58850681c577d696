"""Effects of the stand: head, axis, base and seat. They act on the angle, not on the voltage."""

from collections.abc import Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.calibrations.tracing.effect import (
    Effect,
    Form,
    Forms,
    contrasts,
    harmonic,
    plain,
    single,
    spread,
    with_scanned,
)
from tumble.messages import Message

HIGHEST_ORDER = 35
"""Every 5 degrees a reading: 36 periods a turn are seen as half a wave at most, and more not at all."""


def _angle(scene: Scene, error_deg: FloatArray) -> FloatArray:
    """Volts that small errors of the angle, shape (rows, n), make."""
    return np.asarray(scene.slope_v_per_deg[:, None] * error_deg)


def _wave(scene: Scene, order: int) -> FloatArray:
    """A sin(n φ + p), as a sine and a cosine of the reported angle, shape (rows, 2)."""
    phase = np.deg2rad(order * scene.angle_deg)
    return _angle(scene, np.column_stack([np.sin(phase), np.cos(phase)]))


def _periods(order: int) -> Forms[Scene]:
    """So many periods a turn."""
    return lambda scene: (Form(columns=_wave(scene, order)),)


def _graduation(scene: Scene) -> Sequence[Form]:
    settings = len(np.unique(np.round(scene.angle_deg % 360.0, 1)))
    highest = min(HIGHEST_ORDER, (settings - 1) // 2)
    return [Form(columns=_wave(scene, order), scanned={"order": float(order)}) for order in range(3, highest + 1)]


def _backlash(scene: Scene) -> Sequence[Form]:
    if not (scene.direction < 0).any():
        return ()
    return (Form(columns=_angle(scene, (scene.direction < 0).astype(float)[:, None])),)


def _axis_tilt(scene: Scene) -> Sequence[Form]:
    """Gravity gains a component along the head's axis: what the axis of each mount that lies along it feels."""
    along = np.array([MOUNTS[str(mount)][:, 2] for mount in scene.observations.mounts])
    product = along[:, 0] * scene.gravity_g[:, 1] + along[:, 1] * scene.gravity_g[:, 0]
    return single(np.deg2rad(along @ scene.response_v_per_g + scene.product_v_per_g2 * product))


def _seating(scene: Scene) -> Sequence[Form]:
    levels = int(scene.mounting.max(initial=0)) + 1
    if levels < 2:
        return ()
    return (Form(columns=_angle(scene, contrasts(levels)[scene.mounting])),)


STAND_EFFECTS: tuple[Effect[Scene], ...] = (
    Effect(
        name=Message.named("head_eccentricity", "eccentricity of the head's circle"),
        belongs_to="stand",
        depends_on="angle",
        symbol="A sin(φ + p)",
        source="once per turn: eccentricity of the circle",
        forms=_periods(1),
        report=harmonic,
    ),
    Effect(
        name=Message.named("head_second_harmonic", "second harmonic of the head's circle"),
        belongs_to="stand",
        depends_on="angle",
        symbol="A sin(2φ + p)",
        source="twice per turn: ellipticity or tilt of the circle",
        forms=_periods(2),
        report=harmonic,
    ),
    Effect(
        name=Message.named("graduation", "graduation error"),
        belongs_to="stand",
        depends_on="angle",
        symbol="A sin(nφ + p)",
        source="n per turn: graduation, worm",
        given=True,
        forms=_graduation,
        report=with_scanned(harmonic, order=""),
    ),
    Effect(
        name=Message.named("backlash", "backlash"),
        belongs_to="stand",
        depends_on="direction",
        symbol="b after a move in - direction",
        source="play of the drive",
        forms=_backlash,
        report=plain("backlash", "deg"),
    ),
    Effect(
        name=Message.named("axis_tilt", "tilt of the head's axis"),
        belongs_to="stand",
        symbol="τ: Z end of the axis below the horizon",
        source="levelling of the head",
        forms=_axis_tilt,
        report=plain("axis_tilt", "deg"),
    ),
    Effect(
        name=Message.named("base_tilt_drift", "drift of the foundation's tilt"),
        belongs_to="stand",
        depends_on="time",
        symbol="d t on the angle",
        source="foundation",
        forms=lambda scene: () if scene.hours is None else (Form(columns=_angle(scene, scene.hours[:, None])),),
        report=plain("base_tilt_drift", "deg/h"),
    ),
    Effect(
        name=Message.named("seating", "repeatability of the seat"),
        belongs_to="stand",
        symbol="s_m on the angle",
        source="repeatability of the seat",
        forms=_seating,
        report=spread("seating", "deg"),
        random=True,
    ),
)
