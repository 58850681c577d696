"""Against what to draw a residual, so that an engineer sees the effect that it was traced to."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.messages import Message

Column = NDArray[Any]


@dataclass(frozen=True, kw_only=True)
class Sides:
    """Two kinds of rows that are drawn apart."""

    below: Callable[[Scene], NDArray[np.bool_]]
    """Whether each row is of the second kind."""
    labels: tuple[str, str]


@dataclass(frozen=True, kw_only=True)
class Abscissa:
    """What explains a residual."""

    name: str
    label: str
    values: Callable[[Scene], Column | None]
    """Of every row; None where the table does not say."""
    levels: bool = False
    """Whether the values are few levels, each with a box of its own, and no scale."""
    as_angle: bool = False
    """Whether the residual is an error of the angle, and stands in seconds of arc."""
    sides: Sides | None = None
    bins: int = 30
    """Where there are more different values than that, means are taken over neighbours."""


_SLACK_G = 0.02
"""What ax must have moved by to count as risen or fallen."""


def _turn(scene: Scene) -> FloatArray:
    return np.asarray(np.round(np.mod(scene.angle_deg, 360.0), 2))


def _projection(axis: int) -> Callable[[Scene], FloatArray]:
    return lambda scene: np.asarray(scene.gravity_g[:, axis])


def _product(first: int, second: int) -> Callable[[Scene], FloatArray]:
    return lambda scene: np.asarray(scene.gravity_g[:, first] * scene.gravity_g[:, second])


def _times_ax(column: Callable[[Scene], FloatArray | None]) -> Callable[[Scene], FloatArray | None]:
    return lambda scene: None if (values := column(scene)) is None else np.asarray(values * scene.ax_g)


def _hours(scene: Scene) -> FloatArray | None:
    return scene.hours


def _warmth(scene: Scene) -> FloatArray | None:
    return scene.temperature_k


def _variance_mv2(scene: Scene) -> FloatArray | None:
    return None if (variance_v2 := scene.variance_v2) is None else np.asarray(variance_v2 * 1e6)


def _place(scene: Scene) -> Column:
    """How many rows of the same realisation came before."""
    starts = np.searchsorted(np.sort(scene.realisation), scene.realisation)
    order = np.argsort(np.argsort(scene.realisation, kind="stable"))
    return np.asarray(order - starts)


def _direction(scene: Scene) -> Column:
    return np.array(["-", "unknown", "+"])[scene.direction + 1]


_APPROACH = Sides(
    below=lambda scene: scene.direction < 0, labels=(Message("approached in +"), Message("approached in -"))
)
_LAG = Sides(below=lambda scene: scene.play(_SLACK_G) > 0, labels=(Message("after ax rose"), Message("after ax fell")))
_AX = Abscissa(name="ax", label=Message("ax (g)"), values=_projection(0))
_TIME = Abscissa(name="time", label=Message("time since the first row (h)"), values=_hours)
_TEMPERATURE = Abscissa(name="temperature", label=Message("temperature above reference (K)"), values=_warmth)
_HEAD = Abscissa(name="angle", label=Message("head angle within the turn (°)"), values=_turn, as_angle=True, bins=361)
_OUTPUT = Abscissa(name="output", label=Message("output (V)"), values=lambda scene: scene.output_v, bins=60)
_REALISATION = Abscissa(
    name="realisation", label=Message("realisation"), values=lambda scene: scene.observations.realisations, levels=True
)

BY_EFFECT: Mapping[str, Abscissa] = {
    "k_xx": _AX,
    "k_yy": Abscissa(name="ay", label=Message("ay (g)"), values=_projection(1)),
    "k_zz": Abscissa(name="az", label=Message("az (g)"), values=_projection(2)),
    "k_xz": Abscissa(name="ax-az", label=Message("ax az (g²)"), values=_product(0, 2)),
    "k_yz": Abscissa(name="ay-az", label=Message("ay az (g²)"), values=_product(1, 2)),
    "k_xxx": _AX,
    "scale_asymmetry": _AX,
    "hysteresis": Abscissa(name="ax-by-side", label=Message("ax (g)"), values=_projection(0), sides=_LAG),
    "bias_temperature": _TEMPERATURE,
    "scale_temperature": Abscissa(
        name="temperature-ax", label=Message("temperature above reference times ax (K g)"), values=_times_ax(_warmth)
    ),
    "bias_drift": _TIME,
    "scale_drift": Abscissa(name="time-ax", label=Message("time times ax (h g)"), values=_times_ax(_hours)),
    "warm_up": _TIME,
    "bias_random_walk": _TIME,
    "realisation_bias": _REALISATION,
    "vibration_rectification": Abscissa(
        name="variance", label=Message("variance within the dwell (mV²)"), values=_variance_mv2
    ),
    "head_eccentricity": _HEAD,
    "head_second_harmonic": _HEAD,
    "graduation": _HEAD,
    "backlash": replace(_HEAD, name="angle-by-side", sides=_APPROACH),
    "axis_tilt": Abscissa(
        name="mount", label=Message("mount"), values=lambda scene: scene.observations.mounts, levels=True
    ),
    "base_tilt_drift": Abscissa(name="time-angle", label=_TIME.label, values=_hours, as_angle=True),
    "seating": Abscissa(
        name="mounting", label=Message("mounting"), values=lambda scene: scene.mounting + 1, levels=True, as_angle=True
    ),
    "settling": Abscissa(
        name="previous",
        label=Message("output of the dwell before minus this one (V)"),
        values=lambda scene: scene.left_over_v,
    ),
    "daq_nonlinearity": _OUTPUT,
    "range_step": _OUTPUT,
    "latency": Abscissa(
        name="velocity",
        label=Message("speed of the head (°/s)"),
        values=lambda scene: scene.observations.velocity_deg_s,
        as_angle=True,
    ),
}
"""By the name of an effect; a misreading shows nothing, its rows are set aside."""

BY_VARIABLE: Mapping[str, Abscissa] = {
    "angle": _HEAD,
    "acceleration": _AX,
    "time": _TIME,
    "temperature": _TEMPERATURE,
    "direction": Abscissa(name="direction", label=Message("direction of approach"), values=_direction, levels=True),
    "realisation": _REALISATION,
    "order": Abscissa(name="place", label=Message("dwells before in the realisation"), values=_place),
}
"""By the variable on which structure without a name depends."""
