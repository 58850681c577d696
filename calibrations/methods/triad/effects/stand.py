"""Effects of the two axes and of the base. They turn gravity in the case, and leave its length alone."""

from collections.abc import Callable, Sequence
from typing import Literal

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.geometry import ARCSEC_PER_RAD, square_change, wobble_changes
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.stand_records.terms import TWO_AXES
from tumble.calibrations.tracing.effect import Effect, Form, Quantity, Reported, Variable, harmonic_in, plain
from tumble.messages import Message

_AXIS = Literal["outer", "inner"]


def _axis(scene: TriadScene, axis: _AXIS) -> tuple[FloatArray, FloatArray]:
    """Angle of an axis at each row, in radians, and volts per arc second of it, both of shape (rows,)."""
    angle_deg = scene.observations.outer_deg if axis == "outer" else scene.observations.inner_deg
    volts = scene.outer_v if axis == "outer" else scene.inner_v
    return np.repeat(np.deg2rad(angle_deg), 3), volts / ARCSEC_PER_RAD


def _periods(axis: _AXIS, order: int) -> Callable[[TriadScene], Sequence[Form]]:
    """An error of the angle with so many periods a turn, as a sine and a cosine."""

    def forms(scene: TriadScene) -> Sequence[Form]:
        angle_rad, volts = _axis(scene, axis)
        if len(np.unique(np.round(np.rad2deg(angle_rad) % 360.0, 1))) <= 2 * order:
            return ()
        waves = np.column_stack([np.sin(order * angle_rad), np.cos(order * angle_rad)])
        return (Form(columns=volts[:, None] * waves),)

    return forms


def _backlash(axis: _AXIS) -> Callable[[TriadScene], Sequence[Form]]:
    def forms(scene: TriadScene) -> Sequence[Form]:
        after = (scene.outer_direction if axis == "outer" else scene.inner_direction) < 0
        if not after.any() or after.all():
            return ()
        return (Form(columns=(_axis(scene, axis)[1] * np.repeat(after, 3))[:, None]),)

    return forms


def _square(scene: TriadScene) -> Sequence[Form]:
    change = square_change(scene.observations.outer_deg, scene.observations.inner_deg)
    return (Form(columns=scene.turned_v(change)[:, None] / ARCSEC_PER_RAD),)


def _outer_wobble(scene: TriadScene) -> Sequence[Form]:
    angle_rad = np.repeat(np.deg2rad(scene.observations.outer_deg), 3)
    volts = scene.turned_v(scene.directions.along) / ARCSEC_PER_RAD
    return (Form(columns=volts[:, None] * np.column_stack([np.sin(2 * angle_rad), np.cos(2 * angle_rad)])),)


def _inner_wobble(scene: TriadScene) -> Sequence[Form]:
    changes = wobble_changes(scene.observations.outer_deg, scene.observations.inner_deg)
    return (Form(columns=np.column_stack([scene.turned_v(change) for change in changes]) / ARCSEC_PER_RAD),)


def _level_drift(scene: TriadScene) -> Sequence[Form]:
    hours = scene.hours
    if hours is None or not np.ptp(hours) > 0:
        return ()
    levels = np.column_stack([scene.outer_v, scene.turned_v(scene.directions.along)]) / ARCSEC_PER_RAD
    return (Form(columns=hours[:, None] * levels),)


def _drifts(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
    uncertainty = np.sqrt(np.diag(covariance))
    return {
        key: Quantity(value=float(value), standard_uncertainty=float(u), unit="arcsec/h")
        for key, value, u in zip(("x_arcsec_h", "y_arcsec_h"), coefficients, uncertainty, strict=True)
    }


def _of_axis(
    name: str, depends_on: Variable, symbol: str, forms: Callable[[TriadScene], Sequence[Form]], report: Reported
) -> Effect[TriadScene]:
    return Effect(
        name=name,
        belongs_to="stand",
        depends_on=depends_on,
        symbol=symbol,
        source="error of an axis",
        forms=forms,
        report=report,
    )


_NAMES = {str(name): name for name in TWO_AXES}


def _axis_effects(axis: _AXIS) -> tuple[Effect[TriadScene], ...]:
    eccentricity, second, backlash = (
        _NAMES[f"{axis}_{kind}"] for kind in ("eccentricity", "second_harmonic", "backlash")
    )
    return (
        _of_axis(eccentricity, "angle", "A sin(φ + p)", _periods(axis, 1), harmonic_in("arcsec")),
        _of_axis(second, "angle", "A sin(2φ + p)", _periods(axis, 2), harmonic_in("arcsec")),
        _of_axis(
            backlash, "direction", "e after a move in - direction", _backlash(axis), plain("value_arcsec", "arcsec")
        ),
    )


STAND_EFFECTS: tuple[Effect[TriadScene], ...] = (
    Effect(
        name=_NAMES["axes_orthogonality"],
        belongs_to="stand",
        depends_on="angle",
        symbol="κ: the axes are not square",
        source="geometry of the stand",
        forms=_square,
        report=plain("value_arcsec", "arcsec"),
    ),
    *_axis_effects("outer"),
    *_axis_effects("inner"),
    Effect(
        name=_NAMES["outer_wobble"],
        belongs_to="stand",
        depends_on="angle",
        symbol="level_y + w sin(2A + p)",
        source="bearing of the outer axis",
        forms=_outer_wobble,
        report=harmonic_in("arcsec"),
    ),
    Effect(
        name=_NAMES["inner_wobble"],
        belongs_to="stand",
        depends_on="angle",
        symbol="inner axis turned by w (cos(2B + p), sin(2B + p), 0)",
        source="bearing of the inner axis",
        forms=_inner_wobble,
        report=harmonic_in("arcsec"),
    ),
    Effect(
        name=Message.named("level_drift", "drift of the stand's levels"),
        belongs_to="stand",
        depends_on="time",
        symbol="levels linear in time",
        source="foundation",
        forms=_level_drift,
        report=_drifts,
    ),
)
