"""Whether an exciter does what it was told: by what it says of itself, and by what the references say."""

import math
from collections.abc import Iterable, Mapping
from typing import Final

from tumble.drivers.errors import DeviceError, LinkLostError
from tumble.drivers.excitation import REST, Excitation, Random, Rest, Rotation, Sines, Tone
from tumble.drivers.protocols import Block, ExciterStatus, FloatArray
from tumble.messages import Message

TOLERANCE: Final = 2e-3
"""Of a level, relative; of a frequency a hundredth of it: instruments round what they are told."""
_NOTHING_G: Final = 1e-6


def drives(status: ExciterStatus, told: Excitation) -> bool:
    """Whether it drives as it was told."""
    if not status.on:
        return False
    match told, status.excitation:
        case Sines(tones=wanted), Sines(tones=tones):
            return len(wanted) == len(tones) and all(map(_same_tone, wanted, tones))
        case Random(), Random():
            return _close(told.rms_g, status.excitation.rms_g)
        case Rotation(), Rotation(main_rad_s=main_rad_s, sub_rad_s=sub_rad_s):
            return _close(told.main_rad_s, main_rad_s) and _close(told.sub_rad_s, sub_rad_s)
        case Rest(), Rest():
            return True
    return False


def _same_tone(told: Tone, back: Tone) -> bool:
    apart_deg = ((told.phase_deg or 0.0) - (back.phase_deg or 0.0) + 180.0) % 360.0 - 180.0
    same_hz = math.isclose(told.frequency_hz, back.frequency_hz, rel_tol=TOLERANCE / 100.0)
    return told.shaker == back.shaker and same_hz and abs(apart_deg) < 0.1 and _close(told.level_g, back.level_g)


def _close(told: float, back: float) -> bool:
    return math.isclose(told, back, rel_tol=TOLERANCE, abs_tol=_NOTHING_G)


def check_driven(title: str, told: Excitation, status: ExciterStatus) -> None:
    """Make sure that it does what it was told. Raises `DeviceError`; where it has lost its drive, `LinkLostError`."""
    if status.overload:
        raise DeviceError(
            title,
            Message("reports an overload"),
            Message("look at its amplifier, or ask for a lower level; then resume the run"),
        )
    if told != REST and not status.on:
        raise LinkLostError(
            title, Message("no longer drives"), Message("check its power and its cable, then resume the run")
        )
    if status.on if told == REST else not drives(status, told):
        raise DeviceError(
            title,
            Message("was told {told} and says {back}", told=told.text, back=status.excitation.text),
            Message("look whether it is set to be told by remote control, then resume the run"),
        )


def check_readings(title: str, most: Mapping[str, float], blocks: Iterable[Block]) -> None:
    """Make sure that no channel reads more than it may. Raises `DeviceError`."""
    for channel, values in _channels(blocks):
        peak = float(abs(values).max())
        if peak > most.get(channel, math.inf):
            raise DeviceError(
                title,
                Message(
                    "{channel} reads {peak:.4g}, beyond {most:.4g}", channel=channel, peak=peak, most=most[channel]
                ),
                Message("look at the fixture and the level, or at reference_limit_g; then resume the run"),
            )


def check_quiet(title: str, quiet: Mapping[str, float], blocks: Iterable[Block]) -> None:
    """Make sure that no channel scatters more than it may at rest. Raises `DeviceError`."""
    for channel, values in _channels(blocks):
        if float(values.std()) > quiet.get(channel, math.inf):
            raise DeviceError(
                title,
                Message("says that it rests, and {channel} still shakes", channel=channel),
                Message("switch its amplifier off by hand before anybody touches the unit"),
            )


def _channels(blocks: Iterable[Block]) -> Iterable[tuple[str, FloatArray]]:
    return ((name, values) for block in blocks for name, values in block.channels.items())
