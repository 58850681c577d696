"""What a function generator is told and asked, channel by channel (33500-90901, "SCPI Programming Reference")."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

from tumble.drivers.errors import DeviceError
from tumble.drivers.excitation import Excitation, Random, Sines, Tone
from tumble.drivers.generator.models import LEAST_V_PP
from tumble.drivers.generator.table import OutputTable
from tumble.drivers.generator.waveform import Waveform
from tumble.drivers.scpi.codec import CorruptReplyError, parse_number
from tumble.drivers.tables import EXCITER, TITLES
from tumble.messages import Message

WAVEFORM_NAME: Final = "TUMBLE"


@dataclass(frozen=True, kw_only=True)
class Channel:
    """What a channel says of itself."""

    on: bool
    wave: str
    """`SIN`, `ARB`, …"""
    frequency_hz: float
    amplitude_v_pp: float
    phase_deg: float


def queries(channel: int) -> tuple[str, ...]:
    """What is asked of a channel."""
    source = f"SOUR{channel}"
    return (f"OUTP{channel}?", f"{source}:FUNC?", f"{source}:FREQ?", f"{source}:VOLT?", f"{source}:PHAS?")


def channel_of(answers: Sequence[str]) -> Channel:
    """The answers. Raises `DeviceError` where one is no number."""
    on, wave, hz, v_pp, phase_deg = answers
    return Channel(
        on=number(on) != 0.0,
        wave=wave.strip('"'),
        frequency_hz=number(hz),
        amplitude_v_pp=number(v_pp),
        phase_deg=number(phase_deg),
    )


def off(channels: Sequence[int]) -> list[str]:
    """Amplitudes at their least, then outputs off."""
    return [f"SOUR{channel}:VOLT MIN" for channel in channels] + [f"OUTP{channel} OFF" for channel in channels]


def load(output: OutputTable) -> list[str]:
    """What is behind the output, and how its amplitude is told."""
    ohm = "INF" if output.load_ohm is None else f"{output.load_ohm:g}"
    channel = output.channel
    return [f"OUTP{channel}:LOAD {ohm}", f"SOUR{channel}:VOLT:UNIT VPP", f"SOUR{channel}:VOLT:OFFS 0"]


def sine(tone: Tone, channel: int) -> list[str]:
    """Wave, frequency and phase."""
    return [
        f"SOUR{channel}:FUNC SIN",
        f"SOUR{channel}:FREQ {tone.frequency_hz:.9g}",
        f"SOUR{channel}:PHAS {tone.phase_deg or 0.0:.6g}",
    ]


def arbitrary(waveform: Waveform, channel: int) -> list[str]:
    """The waveform that was loaded, and its pace."""
    return [
        f'SOUR{channel}:FUNC:ARB "{WAVEFORM_NAME}"',
        f"SOUR{channel}:FUNC:ARB:SRAT {waveform.rate_hz:.9g}",
        f"SOUR{channel}:FUNC ARB",
    ]


def loading(waveform: Waveform, channel: int) -> list[str]:
    """Load it in place of any other."""
    codes = ",".join(map(str, waveform.codes))
    return [f"SOUR{channel}:DATA:VOL:CLE", f"SOUR{channel}:DATA:ARB:DAC {WAVEFORM_NAME},{codes}"]


def amplitude(channel: int, peak_v: float) -> str:
    """Amplitude for a peak; none is less than the least."""
    return f"SOUR{channel}:VOLT {max(2.0 * peak_v, LEAST_V_PP):.6g}"


def number(answer: str) -> float:
    """A number that was answered. Raises `DeviceError` where it is none."""
    try:
        return parse_number(answer)
    except CorruptReplyError as error:
        raise DeviceError(
            TITLES[EXCITER],
            Message("answers what is no number ({error})", error=error),
            Message("check that it speaks SCPI as a 33522B does"),
        ) from error


def same_but_for_level(first: Excitation, second: Excitation) -> bool:
    """Whether two excitations differ by nothing but their level."""
    return _shape_of(first) == _shape_of(second) != ()


def _shape_of(excitation: Excitation) -> tuple[object, ...]:
    match excitation:
        case Sines(tones=tones):
            return tuple((tone.shaker, tone.frequency_hz, tone.phase_deg) for tone in tones)
        case Random(frequencies_hz=points_hz, density_g2_hz=density):
            return (*points_hz, *(f"{each / density[0]:.6g}" for each in density))
        case _:
            return ()
