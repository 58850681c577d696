"""Effects of the three accelerometers; the keys of coefficients that all channels share are x, y, z."""

from collections.abc import Callable, Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.observations import CHANNELS
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.tracing.effect import (
    Effect,
    Form,
    Quantity,
    Reported,
    Variable,
    contrasts,
    plain,
    scan,
    single,
    with_scanned,
)
from tumble.messages import Message

_LEAST_EXCITED = 0.01
"""Of the largest value that a product of projections can have."""
_MODES = 30
_IEEE = "IEEE Std 1293-2018, model equation"
_AXES = {"x": 0, "y": 1, "z": 2}


def each_channel(unit: str) -> Reported:
    """Report one coefficient for each channel, under x, y and z."""

    def report(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
        uncertainty = np.sqrt(np.diag(covariance))
        return {
            name: Quantity(value=float(value), standard_uncertainty=float(u), unit=unit)
            for name, value, u in zip(CHANNELS, coefficients, uncertainty, strict=True)
        }

    return report


def spread_of_each(unit: str) -> Reported:
    """Report the root mean square of the levels of each channel, the coefficients being side by side."""

    def report(_form: Form, coefficients: FloatArray, covariance: FloatArray) -> dict[str, Quantity]:
        levels, unknown = coefficients.reshape(3, -1), np.diag(covariance).reshape(3, -1)
        value = np.sqrt(np.mean(levels**2 + unknown, axis=1))
        return {
            name: Quantity(value=float(each), standard_uncertainty=None, unit=unit)
            for name, each in zip(CHANNELS, value, strict=True)
        }

    return report


def in_each(scene: TriadScene, values: FloatArray | None) -> tuple[Form, ...]:
    """One form with a column for each channel; values of shape (dwells, 3), or none."""
    if values is None:
        return ()
    columns = [scene.in_channel(channel, values[:, channel]) for channel in range(3)]
    return (Form(columns=np.column_stack(columns)),)


def _product(channel: str, axes: str) -> Effect[TriadScene]:
    """A product of projections, in one channel."""
    powers = np.array([axes.count(axis) for axis in CHANNELS])
    name = Message.named(
        f"{channel}.k_{axes}", "nonlinearity k_{axes} of channel {channel}", axes=axes, channel=channel
    )

    def forms(scene: TriadScene) -> Sequence[Form]:
        product = np.prod(scene.gravity_g**powers, axis=1)
        if np.abs(product).max(initial=0.0) <= _LEAST_EXCITED:
            return ()
        return single(scene.in_channel(_AXES[channel], product))

    return Effect(
        name=name,
        belongs_to="unit",
        symbol=f"k a_{' a_'.join(axes)} in channel {channel}",
        source=_IEEE,
        forms=forms,
        report=plain("value", f"V/g^{len(axes)}"),
    )


def _asymmetry(channel: str) -> Effect[TriadScene]:
    place = _AXES[channel]
    return Effect(
        name=Message.named(
            f"{channel}.scale_asymmetry", "scale factor asymmetry of channel {channel}", channel=channel
        ),
        belongs_to="unit",
        symbol=f"k |a_{channel}| in channel {channel}",
        source=_IEEE,
        forms=lambda scene: single(scene.in_channel(place, np.abs(scene.gravity_g[:, place]))),
        report=plain("value", "V/g"),
    )


def _slow(
    name: str, unit: str, depends_on: Variable, source: str, values: Callable[[TriadScene], FloatArray | None]
) -> Effect[TriadScene]:
    """Something that each channel follows with a coefficient of its own."""
    return Effect(
        name=name,
        belongs_to="unit",
        depends_on=depends_on,
        symbol=name,
        source=source,
        forms=lambda scene: in_each(scene, values(scene)),
        report=each_channel(unit),
    )


def _time(scene: TriadScene) -> FloatArray | None:
    hours = scene.dwell_hours
    return None if hours is None or not np.ptp(hours) > 0 else np.repeat(hours[:, None], 3, axis=1)


def _times_felt(values: Callable[[TriadScene], FloatArray | None]) -> Callable[[TriadScene], FloatArray | None]:
    """The same times what each input axis feels."""

    def felt(scene: TriadScene) -> FloatArray | None:
        found = values(scene)
        return None if found is None else found * scene.felt_g

    return felt


def _temperature(scene: TriadScene) -> FloatArray | None:
    temperature_k = scene.temperature_k
    return None if temperature_k is None or not np.ptp(temperature_k) > 0 else temperature_k


def _warm_up(scene: TriadScene, tau_s: float) -> Form:
    """Exponential in time, settled at zero, with an amplitude for each channel."""
    assert scene.dwell_hours is not None
    decay = np.exp(-scene.dwell_hours * 3600.0 / tau_s)
    (form,) = in_each(scene, np.repeat(decay[:, None], 3, axis=1))
    return Form(columns=form.columns, scanned={"tau_s": tau_s})


def _time_constants_s(scene: TriadScene) -> Sequence[float]:
    """From a few dwells to most of the run."""
    hours = scene.dwell_hours
    if hours is None or not hours[-1] > 0:
        return ()
    run_s = float(hours[-1]) * 3600.0
    return tuple(np.geomspace(run_s / 40.0, run_s / 1.5, 10).tolist())


def _realisation_bias(scene: TriadScene) -> Sequence[Form]:
    levels = int(scene.realisation.max(initial=0)) + 1
    if levels < 2:
        return ()
    within = contrasts(levels)[scene.realisation]
    return (Form(columns=np.column_stack([scene.in_channel(channel, within) for channel in range(3)])),)


def _walk(scene: TriadScene) -> Sequence[Form]:
    """Cosines over the run with variances falling as 1/k² (Karhunen-Loève), for each channel by itself.

    The coefficients are scaled so that each has the variance rate² · 1 h, whatever the length of the run.
    """
    hours = scene.dwell_hours
    count = min(_MODES, scene.dwells // 3)
    if hours is None or not np.ptp(hours) > 0 or count < 4:
        return ()
    order = np.arange(1, count + 1)
    run_h = float(np.ptp(hours))
    cosines = np.sqrt(2.0 * run_h) / np.pi * np.cos(np.pi * np.outer((hours - hours[0]) / run_h, order)) / order
    return (Form(columns=np.column_stack([scene.in_channel(channel, cosines) for channel in range(3)])),)


UNIT_EFFECTS: tuple[Effect[TriadScene], ...] = (
    *(_product(channel, axes) for channel in CHANNELS for axes in ("xx", "yy", "zz", "xy", "xz", "yz")),
    *(_product(channel, channel * 3) for channel in CHANNELS),
    *(_asymmetry(channel) for channel in CHANNELS),
    _slow(
        Message.named("bias_temperature", "bias temperature sensitivity"),
        "V/K",
        "temperature",
        "IEEE Std 1293-2018, bias temperature sensitivity",
        _temperature,
    ),
    _slow(
        Message.named("scale_temperature", "scale factor temperature sensitivity"),
        "V/g/K",
        "temperature",
        "IEEE Std 1293-2018, scale factor temperature sensitivity",
        _times_felt(_temperature),
    ),
    _slow(Message.named("bias_drift", "bias drift"), "V/h", "time", "IEEE Std 528, drift", _time),
    _slow(
        Message.named("scale_drift", "scale factor drift"), "V/g/h", "time", "IEEE Std 528, drift", _times_felt(_time)
    ),
    Effect(
        name=Message.named("warm_up", "warm-up"),
        belongs_to="unit",
        depends_on="time",
        symbol="w exp(-t/τ)",
        source="IEEE Std 528, warm-up time",
        forms=scan(_warm_up, _time_constants_s),
        report=with_scanned(each_channel("V"), tau_s="s"),
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
        report=spread_of_each("V"),
        random=True,
    ),
    Effect(
        name=Message.named("bias_random_walk", "random walk of the bias"),
        belongs_to="unit",
        depends_on="time",
        symbol="w(t)",
        source="IEEE Std 952, rate random walk; Karhunen-Loève expansion of the centred Wiener process",
        forms=_walk,
        report=spread_of_each("V/√h"),
        random=True,
    ),
)
