"""Structure without a name in a triad, by channel and by the variable on which it depends."""

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from tumble.calibrations.core.arrays import FloatArray
from tumble.calibrations.methods.triad.observations import CHANNELS
from tumble.calibrations.methods.triad.scene import TriadScene
from tumble.calibrations.tracing.effect import Form, Structure, Variable, plain
from tumble.messages import Message

_HIGHEST_ORDER = 6
_TURNS = 20.0


def _in_channels(scene: TriadScene, values: FloatArray, **where: float) -> Iterator[Form]:
    """One form for each channel; values of shape (dwells,) or (dwells, 3)."""
    for channel in range(3):
        own = values if values.ndim == 1 else values[:, channel]
        yield Form(columns=scene.in_channel(channel, own)[:, None], scanned={"channel": float(channel), **where})


def _bends(scene: TriadScene) -> Iterator[Form]:
    felt = np.clip(scene.felt_g, -1.0, 1.0)
    for order in (4, 5, 6):
        yield from _in_channels(scene, np.cos(order * np.arccos(felt)), order=order)
    for power in (1.5, 2.5):
        yield from _in_channels(scene, np.sign(felt) * np.abs(felt) ** power, order=power)


def _courses(scene: TriadScene) -> Iterator[Form]:
    """An error of an axis with several periods a turn."""
    for axis, angle_deg, volts in (
        (0.0, scene.observations.outer_deg, scene.outer_v),
        (1.0, scene.observations.inner_deg, scene.inner_v),
    ):
        distinct = len(np.unique(np.round(angle_deg % 360.0, 1)))
        for order in range(3, min(_HIGHEST_ORDER, (distinct - 1) // 2) + 1):
            phase = np.repeat(np.deg2rad(order * angle_deg), 3)
            waves = np.column_stack([np.sin(phase), np.cos(phase)])
            yield Form(columns=volts[:, None] * waves, scanned={"axis": axis, "order": float(order)})


def _hours(scene: TriadScene) -> Iterator[FloatArray]:
    if scene.dwell_hours is not None and np.ptp(scene.dwell_hours) > 0:
        yield scene.dwell_hours


def _time_shapes(scene: TriadScene) -> Iterator[Form]:
    for hours in _hours(scene):
        part = hours / hours[-1]
        for power in (2, 3):
            yield from _in_channels(scene, part**power, power=power)
        for at in np.linspace(0.05, 0.95, 37).tolist():
            yield from _in_channels(scene, (part > at).astype(float), step_s=at * float(hours[-1]) * 3600.0)


def _time_waves(scene: TriadScene) -> Iterator[Form]:
    """Waves up to the Nyquist limit of the dwells."""
    for hours in _hours(scene):
        for turns in np.arange(1.0, min(_TURNS, scene.dwells / 2), 0.25).tolist():
            phase = 2 * np.pi * turns * hours / hours[-1]
            for channel in range(3):
                waves = scene.in_channel(channel, np.column_stack([np.sin(phase), np.cos(phase)]))
                period_s = float(hours[-1]) * 3600.0 / turns
                yield Form(columns=waves, scanned={"channel": float(channel), "period_s": period_s})


def _temperature_shapes(scene: TriadScene) -> Iterator[Form]:
    temperature_k = scene.temperature_k
    if temperature_k is not None and np.ptp(temperature_k) > 0:
        relative = (temperature_k - temperature_k.mean(axis=0)) / np.ptp(temperature_k)
        for power in (2, 3):
            yield from _in_channels(scene, relative**power, power=power)


def _directions(scene: TriadScene) -> Iterator[Form]:
    for axis, direction in ((0.0, scene.outer_direction), (1.0, scene.inner_direction)):
        back = (direction < 0).astype(float)
        if back.any() and not back.all():
            yield from _in_channels(scene, back, axis=axis)


def _realisations(scene: TriadScene) -> Iterator[Form]:
    for number in range(int(scene.realisation.max(initial=0)) + 1):
        inside = (scene.realisation == number).astype(float)
        if inside.any() and not inside.all():
            yield from _in_channels(scene, inside[:, None] * scene.felt_g, realisation=number + 1)


def _structure(
    depends_on: Variable,
    kind: str,
    forms: Callable[[TriadScene], Iterator[Form]],
    describe: Callable[[Form], str],
) -> Structure[TriadScene]:
    def listed(scene: TriadScene) -> Sequence[Form]:
        return tuple(forms(scene))

    return Structure(
        name=f"?{depends_on} {kind}",
        belongs_to="unit",
        symbol="",
        source="",
        forms=listed,
        report=plain("amplitude", "V"),
        depends_on=depends_on,
        describe=describe,
    )


def _channel_of(form: Form) -> str:
    return CHANNELS[int(form.scanned["channel"])]


def _axis_of(form: Form) -> str:
    return Message("outer") if form.scanned["axis"] == 0.0 else Message("inner")


STRUCTURES: tuple[Structure[TriadScene], ...] = (
    _structure(
        "acceleration",
        "bend",
        _bends,
        lambda form: Message("a bend of the response of channel {channel} to its own axis", channel=_channel_of(form)),
    ),
    _structure(
        "angle",
        "course",
        _courses,
        lambda form: Message(
            "an error of the {axis} axis with {order:g} periods a turn",
            axis=_axis_of(form),
            order=form.scanned["order"],
        ),
    ),
    _structure(
        "time",
        "course",
        _time_shapes,
        lambda form: (
            Message(
                "a step of channel {channel} some {step_s:.0f} s after the first row",
                channel=_channel_of(form),
                step_s=form.scanned["step_s"],
            )
            if "step_s" in form.scanned
            else Message("a drift of channel {channel} that bends", channel=_channel_of(form))
        ),
    ),
    _structure(
        "time",
        "wave",
        _time_waves,
        lambda form: Message(
            "a wave of channel {channel} in time with a period of {period_s:.0f} s",
            channel=_channel_of(form),
            period_s=form.scanned["period_s"],
        ),
    ),
    _structure(
        "temperature",
        "bend",
        _temperature_shapes,
        lambda form: Message("a bend of channel {channel} against temperature", channel=_channel_of(form)),
    ),
    _structure(
        "direction",
        "of approach",
        _directions,
        lambda form: Message(
            "another bias of channel {channel} after moves in - direction of the {axis} axis",
            channel=_channel_of(form),
            axis=_axis_of(form),
        ),
    ),
    _structure(
        "realisation",
        "alone",
        _realisations,
        lambda form: Message(
            "channel {channel} responds differently in realisation {realisation:g}",
            channel=_channel_of(form),
            realisation=form.scanned["realisation"],
        ),
    ),
)
