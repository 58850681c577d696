"""Effects of shakers, of the double centrifuge, and of how long a dwell is averaged."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.vibration.effects.curved import CROSS
from tumble.calibrations.methods.vibration.scene import VibrationScene, durations_s, mean_square
from tumble.calibrations.tracing.effect import Effect, Form, plain, scan, single, with_scanned
from tumble.messages import Message

STANDARD_GRAVITY_M_S2: Final = 9.80665
_UG: Final = 1e6


def partial_period_ug(
    peak_g: FloatArray, phase_rad: FloatArray, frequency_hz: FloatArray, dwell_s: FloatArray
) -> FloatArray:
    """Mean over a dwell of a sine that does not end where it began, in µg."""
    turned = 2.0 * np.pi * frequency_hz * dwell_s
    whole = np.where(turned > 0.0, turned, 1.0)
    return np.asarray(
        np.where(turned > 0.0, _UG * peak_g * (np.cos(phase_rad) - np.cos(phase_rad + turned)) / whole, 0.0)
    )


def arm_ug(main_rad_s: FloatArray, sub_rad_s: FloatArray) -> FloatArray:
    """What a millimetre off the second axis of a double centrifuge, along the input axis, adds: r (Ω + ω2)²/g."""
    return np.asarray(1e3 * (main_rad_s + sub_rad_s) ** 2 / STANDARD_GRAVITY_M_S2)


def _seen(values: FloatArray) -> Sequence[Form]:
    return single(values) if np.ptp(values) > 0 else ()


def _lean(scene: VibrationScene) -> Sequence[Form]:
    """The table leans under load, in its own frame: along the input axis by the direction of the drive."""
    return _seen(scene.observations.along("drive_")[:, 0] * scene.power_g2 * scene.shaken)


def _partial(scene: VibrationScene) -> Sequence[Form]:
    rows = scene.observations
    if rows.dwell_s is None or rows.fi_hz is None:
        return ()
    phase_rad = np.deg2rad(rows.filled("phase_i_deg"))
    return _seen(partial_period_ug(scene.peak_g[:, 0], phase_rad, rows.filled("fi_hz"), rows.filled("dwell_s")))


def _spin(scene: VibrationScene) -> Sequence[Form]:
    rows = scene.observations
    return _seen(arm_ug(rows.filled("main_rad_s"), rows.filled("sub_rad_s")) * scene.centrifuged)


def warmth(scene: VibrationScene, tau_s: float) -> Form:
    """Mean over each dwell of x with τ ẋ = drive - x, the drive being its mean square, and nothing between dwells."""
    history = scene.history
    assert history.time_s is not None, "it is only asked where there are times"
    order = np.argsort(history.time_s, kind="stable")
    middle_s, long_s = history.time_s[order], durations_s(history)[order]
    drive_g2, mean_g2 = mean_square(history)[order], np.zeros(len(order))
    kept = np.exp(-long_s / tau_s)
    share = tau_s / long_s * (1.0 - kept)
    now_g2, ended_s = 0.0, float(middle_s[0] - long_s[0] / 2.0)
    for place, (middle, duration, drive) in enumerate(zip(middle_s, long_s, drive_g2, strict=True)):
        now_g2 *= np.exp(-max(middle - duration / 2.0 - ended_s, 0.0) / tau_s)
        mean_g2[place] = drive + (now_g2 - drive) * share[place]
        now_g2 = drive + (now_g2 - drive) * kept[place]
        ended_s = middle + duration / 2.0
    by_row = dict(zip(history.row[order].tolist(), mean_g2.tolist(), strict=True))
    column = np.array([by_row[row] for row in scene.observations.row.tolist()])
    return Form(columns=column[:, None], scanned={"tau_s": tau_s})


def _time_constants_s(scene: VibrationScene) -> Sequence[float]:
    """From a part of a dwell to a part of the run: what is faster is K_ii, what is slower drift."""
    if scene.hours is None or not scene.power_g2.any():
        return ()
    shortest, longest = float(np.median(scene.dwell_s)) / 5.0, 3600.0 * float(np.ptp(scene.hours)) / 4.0
    if longest <= 2.0 * shortest:
        return ()
    return tuple(np.geomspace(shortest, longest, int(np.ceil(np.log(longest / shortest) / np.log(1.35))) + 1).tolist())


STAND_EFFECTS: Final[tuple[Effect[VibrationScene], ...]] = (
    Effect(
        name=Message.named("shaker_cross", "sideways motion of the shaker"),
        belongs_to="stand",
        symbol="Σ K_xy ½ level² (q_x q_y - s_x s_y), q = s + ρ l",
        source="ISO 5347-8, transverse motion of a vibration generator",
        forms=CROSS.forms,
        report=plain("ratio", ""),
    ),
    Effect(
        name=Message.named("table_lean", "lean of the shaker table"),
        belongs_to="stand",
        symbol="c s_i ½ level²",
        source="a table that leans under load",
        forms=_lean,
        report=plain("table_lean", "µg/g²"),
    ),
    Effect(
        name=Message.named("drive_pickup", "pick-up of the drive"),
        belongs_to="stand",
        symbol="c level",
        source="magnetic or electrical pick-up",
        forms=lambda scene: _seen(scene.level_g * scene.shaken),
        report=plain("drive_pickup", "µg/g"),
    ),
    Effect(
        name=Message.named("thermal_shift", "warming by vibration"),
        belongs_to="stand",
        depends_on="time",
        symbol="A x, τ ẋ = ½ level² - x",
        source="heat of the shaker and of the unit",
        forms=scan(warmth, _time_constants_s),
        report=with_scanned(plain("amplitude", "µg/g²"), tau_s="s"),
        at=warmth,
        additive=True,
    ),
    Effect(
        name=Message.named("spin", "arm on the double centrifuge"),
        belongs_to="stand",
        depends_on="frequency",
        symbol="r (Ω + ω2)²/g",
        source="IEEE Std 836-2009, annex F",
        forms=_spin,
        report=plain("spin", "mm"),
    ),
    Effect(
        name=Message.named("partial_periods", "dwells of no whole number of periods"),
        belongs_to="daq",
        depends_on="order",
        symbol="c a_i [cos φ - cos(φ + 2πfT)]/(2πfT)",
        source="mean of a cut sine",
        forms=_partial,
        report=plain("partial_periods", "fraction"),
    ),
)
