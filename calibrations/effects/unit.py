"""Effects of the unit under test."""

from collections.abc import Sequence

import numpy as np

from calibrations.effects.effect import Effect, Form, contrasts, plain, single, spread, with_scanned
from calibrations.effects.scene import Scene

_IEEE = "IEEE Std 1293-2018, model equation"


def _product(name: str, unit: str, powers: tuple[int, int, int], symbol: str) -> Effect:
    """A product of powers of the projections ax, ay, az."""
    return Effect(
        name=name,
        belongs_to="unit",
        symbol=symbol,
        source=_IEEE,
        forms=lambda scene: single(np.prod(scene.gravity_g ** np.array(powers), axis=1)),
        report=plain(name, unit),
    )


def _hysteresis(scene: Scene) -> Sequence[Form]:
    """Lower after ax rose, higher after it fell: a gap of even width, and one that closes towards the poles."""
    if not scene.rising.any():
        return ()
    lens = np.sqrt(np.clip(1.0 - scene.ax_g**2, 0.0, None))
    return (
        Form(columns=-scene.rising[:, None], scanned={"closing": 0.0}),
        Form(columns=(-scene.rising * lens)[:, None], scanned={"closing": 1.0}),
    )


def _warm_up(scene: Scene) -> Sequence[Form]:
    """Exponential in time, settled at zero; time constants from a few dwells to the whole run."""
    if scene.hours is None or scene.hours[-1] <= 0:
        return ()
    run_s = float(scene.hours[-1]) * 3600.0
    return tuple(
        Form(columns=np.exp(-scene.hours * 3600.0 / tau_s)[:, None], scanned={"tau_s": tau_s})
        for tau_s in np.geomspace(run_s / 60.0, run_s / 1.5, 12).tolist()
    )


def _realisation_bias(scene: Scene) -> Sequence[Form]:
    levels = int(scene.realisation.max(initial=0)) + 1
    return (Form(columns=contrasts(levels)[scene.realisation]),) if levels > 1 else ()


UNIT_EFFECTS = (
    _product("k_xx", "V/g^2", (2, 0, 0), "k_xx ax²"),
    _product("k_yy", "V/g^2", (0, 2, 0), "k_yy ay²"),
    _product("k_zz", "V/g^2", (0, 0, 2), "k_zz az²"),
    _product("k_xz", "V/g^2", (1, 0, 1), "k_xz ax az"),
    _product("k_yz", "V/g^2", (0, 1, 1), "k_yz ay az"),
    _product("k_xxx", "V/g^3", (3, 0, 0), "k_xxx ax³"),
    Effect(
        name="scale_asymmetry",
        belongs_to="unit",
        symbol="k_a |ax|",
        source=_IEEE,
        forms=lambda scene: single(np.abs(scene.ax_g)),
        report=plain("scale_asymmetry", "V/g"),
    ),
    Effect(
        name="hysteresis",
        belongs_to="unit",
        symbol="-h sign(ax rising)",
        source="IEEE Std 528, hysteresis error",
        forms=_hysteresis,
        report=plain("hysteresis", "V"),
    ),
    Effect(
        name="bias_temperature",
        belongs_to="unit",
        symbol="k_T (T - T0)",
        source="IEEE Std 1293-2018, bias temperature sensitivity",
        forms=lambda scene: single(scene.temperature_k),
        report=plain("bias_temperature", "V/K"),
    ),
    Effect(
        name="scale_temperature",
        belongs_to="unit",
        symbol="k_xT (T - T0) ax",
        source="IEEE Std 1293-2018, scale factor temperature sensitivity",
        forms=lambda scene: single(None if scene.temperature_k is None else scene.temperature_k * scene.ax_g),
        report=plain("scale_temperature", "V/K/g"),
    ),
    Effect(
        name="bias_drift",
        belongs_to="unit",
        symbol="d t",
        source="IEEE Std 528, drift",
        forms=lambda scene: single(scene.hours),
        report=plain("bias_drift", "V/h"),
    ),
    Effect(
        name="scale_drift",
        belongs_to="unit",
        symbol="d_x t ax",
        source="IEEE Std 528, drift",
        forms=lambda scene: single(None if scene.hours is None else scene.hours * scene.ax_g),
        report=plain("scale_drift", "V/g/h"),
    ),
    Effect(
        name="warm_up",
        belongs_to="unit",
        symbol="w exp(-t/τ)",
        source="IEEE Std 528, warm-up time",
        forms=_warm_up,
        report=with_scanned(plain("amplitude", "V"), tau_s="s"),
    ),
    Effect(
        name="realisation_bias",
        belongs_to="unit",
        symbol="b_r",
        source="IEEE Std 528, turn-on to turn-on bias",
        forms=_realisation_bias,
        report=spread("realisation_bias", "V"),
    ),
    Effect(
        name="vibration_rectification",
        belongs_to="unit",
        symbol="k_v s²",
        source="IEEE Std 836 and 1293, rectification error",
        forms=lambda scene: single(scene.variance_v2),
        report=plain("vibration_rectification", "V/V^2"),
    ),
)
