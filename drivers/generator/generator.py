"""A function generator as an exciter. Everything that it is told is read back, and its error queue is emptied."""

import math
from collections.abc import Mapping, Sequence
from typing import Final, Protocol

from tumble.drivers.errors import DeviceError, LimitError
from tumble.drivers.excitation import REST, Excitation, Random, Sines, Tone
from tumble.drivers.exciter_table import check_excitation
from tumble.drivers.generator import settings
from tumble.drivers.generator.models import model_of
from tumble.drivers.generator.table import SINGLE, GeneratorTable, OutputTable
from tumble.drivers.generator.waveform import Waveform, waveform_of
from tumble.drivers.protocols import ExciterStatus, Identity
from tumble.drivers.scpi.exchange import CompoundExchange, Link
from tumble.drivers.tables import EXCITER, TITLES
from tumble.messages import Message

DEVICE: Final = TITLES[EXCITER]
_OVERLOAD: Final = 1
"""Bit of the questionable data register (STAT:QUES)."""
_LOADING_S: Final = 20.0
"""How much longer than usual a waveform may be on its way."""


class ReopenableLink(Link, Protocol):
    """A link that can be opened anew."""

    def reopen(self) -> None:
        """Open it anew. Raises `LinkLostError` while nobody is there."""
        ...


class FunctionGenerator:
    """Fits `tumble.drivers.protocols.Exciter` and `Reconnectable`.

    Its amplitude is brought to the least that it has before the output is switched off, and is set before it is
    switched on. Of two outputs the phases are aligned when they are switched on.

    Parameters
    ----------
    link
        An open `SerialLink`.
    table
        The stand file's table: outputs, limits, ramp.
    """

    def __init__(self, link: ReopenableLink, table: GeneratorTable) -> None:
        self._link, self._table = link, table
        self._outputs: Mapping[str, OutputTable] = {str(axis): output for axis, output in table.outputs.items()}
        self._channels = [output.channel for output in self._outputs.values()]
        self._exchange = CompoundExchange(link, DEVICE, table.timeout_s)
        self._waveform: tuple[Random, Waveform] | None = None
        self._told: Excitation = REST

    @property
    def ramp_s(self) -> float:
        """As the stand file says."""
        return self._table.ramp_s

    def identify(self) -> Identity:
        """Ask for maker, model, serial number and firmware. Raises `DeviceError`."""
        identity = self._exchange.identify()
        model = model_of(identity)
        if beyond := [channel for channel in self._channels if channel > model.channels]:
            raise DeviceError(
                DEVICE,
                Message("has no channel {channel}: it is a {model}", channel=beyond[0], model=model.name),
                Message("correct outputs of the stand file"),
            )
        self._exchange.errors()
        return identity

    def reconnect(self) -> None:
        """Open the link anew; what it does is to be asked. Raises `LinkLostError` while it is away."""
        self._link.reopen()
        self._told = REST

    def drive(self, excitation: Excitation) -> None:
        """Drive so from now on. Raises `LimitError`, `DeviceError`."""
        check_excitation(self._table, excitation)
        outputs = self._needed(excitation)
        if excitation == REST:
            self.make_safe()
        elif settings.same_but_for_level(self._told, excitation):
            self._tell(self._levels(excitation, outputs))
        else:
            self._begin(excitation, outputs)
        self._told = excitation

    def status(self) -> ExciterStatus:
        """Read outputs, waves, frequencies, amplitudes and phases back. Raises `DeviceError`."""
        asked = [settings.queries(channel) for channel in self._channels]
        overload, *answers = self._exchange.ask("STAT:QUES:COND?", *(query for each in asked for query in each))
        groups = [answers[len(asked[0]) * number :][: len(asked[0])] for number in range(len(asked))]
        read = dict(zip(self._outputs, map(settings.channel_of, groups), strict=True))
        on = {axis: channel for axis, channel in read.items() if channel.on}
        return ExciterStatus(
            excitation=self._excitation_of(on),
            on=bool(on),
            overload=bool(int(settings.number(overload)) & _OVERLOAD),
        )

    def make_safe(self) -> None:
        """Amplitude at its least, outputs off. Raises `DeviceError`."""
        self._tell(settings.off(self._channels))
        self._told = REST

    def _begin(self, excitation: Excitation, outputs: Mapping[str, OutputTable]) -> None:
        """Set everything while the outputs are off, then switch on those that are needed."""
        shapes = [
            command for tone in _tones(excitation) for command in settings.sine(tone, outputs[tone.shaker].channel)
        ]
        if isinstance(excitation, Random):
            waveform, channel = self._shaped(excitation), outputs[SINGLE].channel
            self._tell([*settings.off(self._channels), *settings.loading(waveform, channel)], _LOADING_S)
            shapes = settings.arbitrary(waveform, channel)
        loads = [command for output in self._outputs.values() for command in settings.load(output)]
        switched = [f"OUTP{output.channel} ON" for output in outputs.values()]
        aligned = ["PHAS:SYNC"] if len(outputs) > 1 else []
        levels = self._levels(excitation, outputs)
        self._tell([*settings.off(self._channels), *loads, *shapes, *levels, *switched, *aligned])

    def _levels(self, excitation: Excitation, outputs: Mapping[str, OutputTable]) -> list[str]:
        peaks_g = {tone.shaker: tone.level_g for tone in _tones(excitation)}
        if isinstance(excitation, Random):
            peaks_g = {SINGLE: excitation.rms_g / self._shaped(excitation).rms}
        return [
            settings.amplitude(outputs[shaker].channel, outputs[shaker].peak_v(peak_g))
            for shaker, peak_g in peaks_g.items()
        ]

    def _needed(self, excitation: Excitation) -> dict[str, OutputTable]:
        """The outputs of an excitation, by shaker. Raises `LimitError` where there is no such one."""
        shakers = [SINGLE] if isinstance(excitation, Random) else [tone.shaker for tone in _tones(excitation)]
        found = {shaker: output for shaker in shakers if (output := self._table.output_of(shaker)) is not None}
        if missing := [shaker for shaker in shakers if shaker not in found]:
            raise LimitError(
                DEVICE,
                Message("has no shaker along {axis}", axis=missing[0] or "x"),
                Message("name it under outputs of the stand file, or change the programme"),
            )
        return found

    def _shaped(self, excitation: Random) -> Waveform:
        """The waveform of a density of any level; the last one is kept."""
        if self._waveform is None or not settings.same_but_for_level(self._waveform[0], excitation):
            self._waveform = (excitation, waveform_of(excitation))
        return self._waveform[1]

    def _tell(self, commands: Sequence[str], extra_s: float = 0.0) -> None:
        """Have commands carried out. Raises `DeviceError` where it complains."""
        self._exchange.ask("*OPC?", commands=commands, extra_s=extra_s)
        if errors := self._exchange.errors():
            raise DeviceError(
                DEVICE,
                Message("refuses what it was told: {errors}", errors=", ".join(map(str, errors))),
                Message("compare outputs and limits of the stand file with its manual, then resume the run"),
            )

    def _excitation_of(self, on: Mapping[str, settings.Channel]) -> Excitation:
        """What outputs that are on do."""
        if not on:
            return REST
        axis, first = next(iter(on.items()))
        if first.wave == "ARB" and self._waveform is not None:
            shape, waveform = self._waveform
            return shape.scaled(self._peak_g(axis, first) * waveform.rms / shape.rms_g)
        named = isinstance(self._told, Sines) and bool(self._told.tones[0].shaker)
        tones = [self._tone(axis, channel, named=named) for axis, channel in on.items()]
        return Sines(tones=tuple(sorted(tones, key=lambda tone: tone.shaker)))

    def _tone(self, axis: str, channel: settings.Channel, *, named: bool) -> Tone:
        return Tone(
            shaker=axis if named else SINGLE,
            level_g=self._peak_g(axis, channel) if channel.wave == "SIN" else math.inf,
            frequency_hz=channel.frequency_hz,
            phase_deg=channel.phase_deg if named else None,
        )

    def _peak_g(self, axis: str, channel: settings.Channel) -> float:
        return channel.amplitude_v_pp / 2.0 * self._outputs[axis].g_per_v


def _tones(excitation: Excitation) -> tuple[Tone, ...]:
    return excitation.tones if isinstance(excitation, Sines) else ()
