"""Effects of the unit under test."""

from collections.abc import Mapping, Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.dividing_head.effects.scene import Scene
from tumble.calibrations.tracing.effect import Effect, Form, contrasts, plain, scan, single, spread, with_scanned
from tumble.messages import Message

_LEAST_EXCITED = 0.01
"""Of the largest value that a product of projections can have."""
_IEEE = "IEEE Std 1293-2018, model equation"


def _product(name: Message, unit: str, powers: tuple[int, int, int], symbol: str) -> Effect[Scene]:
    """A product of powers of the projections ax, ay, az."""
    return Effect(
        name=name,
        belongs_to="unit",
        symbol=symbol,
        source=_IEEE,
        forms=lambda scene: single(_excited(np.prod(scene.gravity_g ** np.array(powers), axis=1))),
        report=plain(name, unit),
    )


def _excited(product: FloatArray) -> FloatArray | None:
    """A product of projections, or nothing where no row is turned so that it matters."""
    return product if np.abs(product).max() > _LEAST_EXCITED else None


def _plays(scene: Scene) -> Sequence[Form]:
    """Plays on ax: lower after ax rose, higher after it fell, by half the gap once the slack is taken up.

    The elementary operator of Prandtl and Ishlinskii (Visintin, Differential Models of Hysteresis, III.2), of which any
    hysteresis is a sum; of every reach, the state lost or kept while the unit is mounted anew. None where ax only ever
    went one way.
    """
    steps = np.diff(scene.ax_g)
    if not (steps > 0).any() or not (steps < 0).any():
        return ()
    keys = ("reach_g", "kept_g") if scene.mounting[-1] else ("reach_g",)
    return tuple(_play(scene, {key: reach_g}) for key in keys for reach_g in _REACHES_G)


def _play(scene: Scene, scanned: Mapping[str, float]) -> Form:
    """A play of one reach, begun anew in every mount (`reach_g`) or kept (`kept_g`)."""
    ((key, reach_g),) = scanned.items()
    stand = scene.play(reach_g) if key == "reach_g" else scene.play_kept(reach_g)
    return Form(columns=stand[:, None], scanned=scanned)


_REACHES_G = (0.005, 0.012, 0.02, 0.03, 0.045, 0.07, 0.1, 0.14, 0.2, 0.28, 0.4)
"""From next to no slack to most of the range."""


def _warm_up(scene: Scene, tau_s: float) -> Form:
    """Exponential in time, settled at zero."""
    assert scene.hours is not None
    return Form(columns=np.exp(-scene.hours * 3600.0 / tau_s)[:, None], scanned={"tau_s": tau_s})


def _time_constants_s(scene: Scene) -> Sequence[float]:
    """From a few dwells to most of the run."""
    if scene.hours is None or scene.hours[-1] <= 0:
        return ()
    run_s = float(scene.hours[-1]) * 3600.0
    return tuple(np.geomspace(run_s / 60.0, run_s / 1.5, 12).tolist())


def _realisation_bias(scene: Scene) -> Sequence[Form]:
    levels = int(scene.realisation.max(initial=0)) + 1
    return (Form(columns=contrasts(levels)[scene.realisation]),) if levels > 1 else ()


UNIT_EFFECTS: tuple[Effect[Scene], ...] = (
    _product(Message.named("k_xx", "second-order nonlinearity k_xx"), "V/g^2", (2, 0, 0), "k_xx ax²"),
    _product(Message.named("k_yy", "second-order nonlinearity k_yy"), "V/g^2", (0, 2, 0), "k_yy ay²"),
    _product(Message.named("k_zz", "second-order nonlinearity k_zz"), "V/g^2", (0, 0, 2), "k_zz az²"),
    _product(Message.named("k_xz", "cross-coupling k_xz"), "V/g^2", (1, 0, 1), "k_xz ax az"),
    _product(Message.named("k_yz", "cross-coupling k_yz"), "V/g^2", (0, 1, 1), "k_yz ay az"),
    _product(Message.named("k_xxx", "third-order nonlinearity k_xxx"), "V/g^3", (3, 0, 0), "k_xxx ax³"),
    Effect(
        name=Message.named("scale_asymmetry", "scale factor asymmetry"),
        belongs_to="unit",
        symbol="k_a |ax|",
        source=_IEEE,
        forms=lambda scene: single(np.abs(scene.ax_g)),
        report=plain("scale_asymmetry", "V/g"),
    ),
    Effect(
        name=Message.named("hysteresis", "hysteresis"),
        belongs_to="unit",
        symbol="h play(ax)",
        source="IEEE Std 528, hysteresis error",
        forms=_plays,
        again=_play,
        report=plain("hysteresis", "V"),
        additive=True,
    ),
    Effect(
        name=Message.named("bias_temperature", "bias temperature sensitivity"),
        belongs_to="unit",
        depends_on="temperature",
        symbol="k_T (T - T0)",
        source="IEEE Std 1293-2018, bias temperature sensitivity",
        forms=lambda scene: single(scene.temperature_k),
        report=plain("bias_temperature", "V/K"),
    ),
    Effect(
        name=Message.named("scale_temperature", "scale factor temperature sensitivity"),
        belongs_to="unit",
        depends_on="temperature",
        symbol="k_xT (T - T0) ax",
        source="IEEE Std 1293-2018, scale factor temperature sensitivity",
        forms=lambda scene: single(None if scene.temperature_k is None else scene.temperature_k * scene.ax_g),
        report=plain("scale_temperature", "V/g/K"),
    ),
    Effect(
        name=Message.named("bias_drift", "bias drift"),
        belongs_to="unit",
        depends_on="time",
        symbol="d t",
        source="IEEE Std 528, drift",
        forms=lambda scene: single(scene.hours),
        report=plain("bias_drift", "V/h"),
    ),
    Effect(
        name=Message.named("scale_drift", "scale factor drift"),
        belongs_to="unit",
        depends_on="time",
        symbol="d_x t ax",
        source="IEEE Std 528, drift",
        forms=lambda scene: single(None if scene.hours is None else scene.hours * scene.ax_g),
        report=plain("scale_drift", "V/g/h"),
    ),
    Effect(
        name=Message.named("warm_up", "warm-up"),
        belongs_to="unit",
        depends_on="time",
        symbol="w exp(-t/τ)",
        source="IEEE Std 528, warm-up time",
        forms=scan(_warm_up, _time_constants_s),
        report=with_scanned(plain("amplitude", "V"), tau_s="s"),
        at=_warm_up,
        additive=True,
    ),
    Effect(
        name=Message.named("realisation_bias", "turn-on to turn-on bias"),
        belongs_to="unit",
        depends_on="realisation",
        symbol="b_r",
        source="IEEE Std 528, turn-on to turn-on bias",
        forms=_realisation_bias,
        report=spread("realisation_bias", "V"),
        random=True,
    ),
    Effect(
        name=Message.named("vibration_rectification", "vibration rectification"),
        belongs_to="unit",
        symbol="k_v s²",
        source="IEEE Std 836 and 1293, rectification error",
        forms=lambda scene: single(scene.variance_v2),
        report=plain("vibration_rectification", "V/V^2"),
    ),
)
