"""Effects of the turntable: the true pickoff angle is not the reported one, or the base turns."""

from collections.abc import Callable, Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.gyrocompass.scene import GyrocompassScene
from tumble.calibrations.tracing.effect import Effect, Form, Forms, Reported, Variable, harmonic, plain, with_scanned
from tumble.messages import Message

_FIRST_ORDER: Final = 3
_LAST_ORDER: Final = 36
_ROUNDING: Final = 1e-9
"""What is smaller than this beside the largest is zero."""


def _periods(orders: Callable[[int], Sequence[int]], scanned: bool) -> Forms[GyrocompassScene]:
    """Errors of the angle with so many periods a turn, as a sine and a cosine, for a number of angles."""

    def forms(scene: GyrocompassScene) -> Sequence[Form]:
        shown = [(order, _waves(scene, order)) for order in orders(_angles(scene))]
        return tuple(
            Form(columns=columns, scanned={"order": float(order)} if scanned else {}) for order, columns in shown
        )

    return forms


def _waves(scene: GyrocompassScene, order: int) -> FloatArray:
    """Rates and tilts for errors sin(nδ) and cos(nδ) of a degree; zero where these are but for rounding."""
    phase = order * scene.delta_rad
    waves = np.column_stack([np.sin(phase), np.cos(phase)])
    columns = scene.turned(np.deg2rad(np.where(np.abs(waves) < _ROUNDING, 0.0, waves)))
    return np.where(np.abs(columns) < _ROUNDING * np.abs(columns).max(), 0.0, columns)


def _angles(scene: GyrocompassScene) -> int:
    """How many different angles there are."""
    return len(np.unique(np.round(scene.observations.azimuth_deg % 360.0, 1) % 360.0))


def _fine(angles: int) -> Sequence[int]:
    """Orders that so many angles tell from lower ones; the first whatever they tell."""
    return range(_FIRST_ORDER, min(max(angles // 2, _FIRST_ORDER), _LAST_ORDER) + 1)


def _scale(scene: GyrocompassScene) -> Sequence[Form]:
    return (Form(columns=scene.turned(scene.delta_rad)[:, None]),) if np.ptp(scene.delta_rad) > 0 else ()


def _backlash(scene: GyrocompassScene) -> Sequence[Form]:
    after = scene.direction < 0
    if not after.any() or after.all():
        return ()
    return (Form(columns=scene.turned(np.deg2rad(after.astype(float)))[:, None]),)


def _yaw(scene: GyrocompassScene) -> Sequence[Form]:
    """The base turns with its lean, so that the tilts stay what they are."""
    hours = scene.dwell_hours
    if hours is None or not np.ptp(hours) > 0:
        return ()
    return (Form(columns=scene.in_rows(scene.rate_slope * np.deg2rad(hours))[:, None]),)


def _of_turntable(
    name: str, depends_on: Variable, symbol: str, forms: Forms[GyrocompassScene], report: Reported
) -> Effect[GyrocompassScene]:
    return Effect(
        name=name,
        belongs_to="stand",
        depends_on=depends_on,
        symbol=symbol,
        source="error of the azimuth",
        forms=forms,
        report=report,
    )


TURNTABLE_EFFECTS: Final[tuple[Effect[GyrocompassScene], ...]] = (
    _of_turntable(
        Message.named("pickoff_eccentricity", "eccentricity of the pickoff"),
        "angle",
        "δ + A sin(δ + p)",
        _periods(lambda _: (1,), scanned=False),
        harmonic,
    ),
    _of_turntable(
        Message.named("pickoff_second_harmonic", "error of the pickoff twice a turn"),
        "angle",
        "δ + A sin(2δ + p)",
        _periods(lambda _: (2,), scanned=False),
        harmonic,
    ),
    _of_turntable(
        Message.named("pickoff_scale", "scale factor error of the pickoff"),
        "angle",
        "δ (1 + k)",
        _scale,
        plain("pickoff_scale", "fraction"),
    ),
    _of_turntable(
        Message.named("backlash", "backlash of the turntable"),
        "direction",
        "δ + b after a move in - direction",
        _backlash,
        plain("backlash", "deg"),
    ),
    _of_turntable(
        Message.named("base_yaw", "slow turn of the base"),
        "time",
        "α0 + w t",
        _yaw,
        plain("base_yaw", "deg/h"),
    ),
    _of_turntable(
        Message.named("pickoff_graduation", "graduation error of the pickoff"),
        "angle",
        "δ + A sin(nδ + p), n ≥ 3",
        _periods(_fine, scanned=True),
        with_scanned(harmonic, order=""),
    ),
)
