"""Structure without a name in a head that is measured against a reference."""

from collections.abc import Callable, Mapping, Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.head_reference.scene import HeadScene
from tumble.calibrations.tracing.effect import Form, Forms, Structure, Variable, plain
from tumble.messages import Message

_WIDTHS_DEG = (5.0, 12.0, 25.0)
_FEWEST_ANGLES = 8
"""At fewer angles a bump or a step is any one of them."""


def _column(values: FloatArray, **where: float) -> Form:
    return Form(columns=values[:, None], scanned=where)


def _centres_deg(step_deg: float) -> list[float]:
    return [float(centre) for centre in np.arange(0.0, 360.0, step_deg)]


def _bells(scene: HeadScene) -> Sequence[Form]:
    """An error near one angle of the head, where there is one."""
    if scene.distinct_angles < _FEWEST_ANGLES:
        return ()
    at = np.unique(np.round(scene.seen_deg % 360.0, 3))
    away = {deg: (scene.seen_deg - deg + 180.0) % 360.0 - 180.0 for deg in _centres_deg(5.0)}
    return [
        _column(np.exp(-0.5 * (away_deg / width) ** 2), centre_deg=centre, width_deg=width)
        for width in _WIDTHS_DEG
        for centre, away_deg in away.items()
        if np.abs((at - centre + 180.0) % 360.0 - 180.0).min() < width
    ]


def _edges(scene: HeadScene) -> Sequence[Form]:
    """An error that steps at one angle, the same in both directions."""
    if scene.distinct_angles < _FEWEST_ANGLES:
        return ()
    inside = [deg for deg in _centres_deg(2.5) if scene.seen_deg.min() + 5 < deg < scene.seen_deg.max() - 5]
    return [_column(0.5 * np.tanh((scene.seen_deg - deg) / 2.0), edge_deg=deg) for deg in inside]


def _time_steps(scene: HeadScene) -> Sequence[Form]:
    if scene.hours is None or not np.ptp(scene.hours):
        return ()
    places_h = scene.hours.min() + np.linspace(0.02, 0.98, 49) * np.ptp(scene.hours)
    return [_column((scene.hours > at_h).astype(float), step_s=float(at_h) * 3600.0) for at_h in places_h]


def _time_bends(scene: HeadScene) -> Sequence[Form]:
    if scene.hours is None or not np.ptp(scene.hours):
        return ()
    part = (scene.hours - scene.hours.min()) / np.ptp(scene.hours)
    return [_column(part**power, power=float(power)) for power in (2, 3)]


def _structure(
    depends_on: Variable, kind: str, forms: Forms[HeadScene], describe: Callable[[Mapping[str, float]], str]
) -> Structure[HeadScene]:
    return Structure(
        name=f"?{depends_on} {kind}",
        belongs_to="stand",
        symbol="",
        source="",
        forms=forms,
        report=plain("amplitude", "deg"),
        depends_on=depends_on,
        describe=lambda form: describe(form.scanned),
    )


HEAD_STRUCTURES: tuple[Structure[HeadScene], ...] = (
    _structure(
        "angle",
        "bell",
        _bells,
        lambda at: Message(
            "a bump of the head's error near {centre_deg:g}°, some {width_deg:g}° wide",
            centre_deg=at["centre_deg"],
            width_deg=2 * at["width_deg"],
        ),
    ),
    _structure(
        "angle",
        "edge",
        _edges,
        lambda at: Message("a step of the head's error near {edge_deg:g}°, from either side", edge_deg=at["edge_deg"]),
    ),
    _structure(
        "time",
        "step",
        _time_steps,
        lambda at: Message("a step some {step_s:.1f} s after the first row", step_s=at["step_s"]),
    ),
    _structure(
        "time",
        "bend",
        _time_bends,
        lambda at: Message("a drift that bends, like the power {power:g} of the time", power=at["power"]),
    ),
)
