"""An output of a function generator: its settings, and the commands that set and ask them."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import partial
from typing import Final

from tumble.emulators.scpi.command import Command
from tumble.emulators.scpi.kinds import write_real
from tumble.emulators.scpi.language import ScpiError, number, quoted, word

_SHAPES: Final = ("SINusoid", "SQUare", "RAMP", "PULSe", "NOISe", "DC", "ARBitrary")
_LEAST_V_PP, _MOST_V_PP = 0.002, 20.0
"""Into an open circuit."""
_MOST_HZ: Final = 30e6
_OWN_OHM: Final = 50.0
INFINITE_OHM: Final = 9.9e37
_DAC: Final = 32_767.0


@dataclass(kw_only=True)
class Output:
    """One of the two."""

    on: bool = False
    shape: str = "SIN"
    frequency_hz: float = 1000.0
    amplitude_v_pp: float = 0.1
    offset_v: float = 0.0
    phase_deg: float = 0.0
    load_ohm: float = _OWN_OHM
    waveform: str = ""
    rate_hz: float = 40_000.0
    waveforms: dict[str, tuple[float, ...]] = field(default_factory=dict)
    """Loaded ones by name, within ±1."""

    @property
    def divided(self) -> float:
        """Part of the open-circuit voltage that the load gets."""
        return self.load_ohm / (self.load_ohm + _OWN_OHM)

    def reset(self) -> None:
        """As when it is switched on."""
        vars(self).update(vars(Output()))


def commands_of(channel: int, output: Output, refused: Callable[[], object]) -> dict[str, Command]:
    """Commands of a channel; without a number they mean the first. A setting that is `refused` stays as it was."""
    table: dict[str, Command] = {}
    for source in _headers("SOURce", channel, optional=True):
        table |= _settings(source, output, refused)
        table[f"{source}:DATA:VOLatile:CLEar"] = Command(act=output.waveforms.clear)
        for header, full in ((f"{source}:DATA:ARBitrary", 1.0), (f"{source}:DATA:ARBitrary:DAC", _DAC)):
            table[header] = Command(act=partial(_load, output, full), least=9, most=65_537)
    for header in _headers("OUTPut", channel, optional=False):
        table[f"{header}[:STATe]"] = Command(act=partial(_switch, output), least=1, most=1)
        table[f"{header}[:STATe]?"] = Command(act=lambda: f"{output.on:d}")
        table[f"{header}:LOAD"] = Command(act=partial(_set_load, output), least=1, most=1)
        table[f"{header}:LOAD?"] = Command(act=lambda: write_real(output.load_ohm))
    return table


def _headers(name: str, channel: int, *, optional: bool) -> Iterator[str]:
    yield f"{name}{channel}"
    if channel == 1:
        yield f"[{name}]" if optional else name


def _settings(source: str, output: Output, refused: Callable[[], object]) -> dict[str, Command]:
    numbers = {
        "FREQuency": ("frequency_hz", "HZ", lambda: (1e-6, _MOST_HZ)),
        "VOLTage": ("amplitude_v_pp", "VPP", lambda: (_LEAST_V_PP * output.divided, _MOST_V_PP * output.divided)),
        "VOLTage:OFFSet": ("offset_v", "V", lambda: (-10.0 * output.divided, 10.0 * output.divided)),
        "PHASe": ("phase_deg", "DEG", lambda: (-360.0, 360.0)),
        "FUNCtion:ARBitrary:SRATe": ("rate_hz", "SA/S", lambda: (1e-6, 250e6)),
    }
    table: dict[str, Command] = {}
    for header, (name, unit, bounds) in numbers.items():
        table[f"{source}:{header}"] = Command(act=partial(_set, output, name, unit, bounds, refused), least=1, most=1)
        table[f"{source}:{header}?"] = Command(act=partial(_ask, output, name, bounds), most=1)
    table[f"{source}:FUNCtion"] = Command(act=partial(_set_shape, output), least=1, most=1)
    table[f"{source}:FUNCtion?"] = Command(act=lambda: output.shape)
    table[f"{source}:VOLTage:UNIT"] = Command(act=lambda text: word(text, ("VPP",)) and None, least=1, most=1)
    table[f"{source}:VOLTage:UNIT?"] = Command(act=lambda: "VPP")
    table[f"{source}:FUNCtion:ARBitrary"] = Command(act=partial(_choose, output), least=1, most=1)
    table[f"{source}:FUNCtion:ARBitrary?"] = Command(act=lambda: f'"{output.waveform}"')
    return table


def _set(
    output: Output,
    name: str,
    unit: str,
    bounds: Callable[[], tuple[float, float]],
    refused: Callable[[], object],
    text: str,
) -> None:
    least, most = bounds()
    named = {"MIN": least, "MINIMUM": least, "MAX": most, "MAXIMUM": most}
    value = named[text.upper()] if text.upper() in named else number(text, unit)
    if not least <= value <= most:
        raise ScpiError(-222)
    if not refused():
        setattr(output, name, value)


def _ask(output: Output, name: str, bounds: Callable[[], tuple[float, float]], which: str = "") -> str:
    if not which:
        return write_real(getattr(output, name))
    return write_real(bounds()[word(which, ("MINimum", "MAXimum")) == "MAX"])


def _set_shape(output: Output, text: str) -> None:
    output.shape = word(text, _SHAPES)


def _switch(output: Output, text: str) -> None:
    output.on = word(text, ("ON", "OFF", "1", "0")) in ("ON", "1") if not text.isdigit() else text != "0"


def _set_load(output: Output, text: str) -> None:
    output.load_ohm = INFINITE_OHM if text.upper() in ("INF", "INFINITY") else number(text, "OHM")


def _load(output: Output, full: float, name: str, *values: str) -> None:
    """Take a waveform. Raises `ScpiError` for a value beyond full scale."""
    points = tuple(number(value) / full for value in values)
    if any(abs(point) > 1.0 for point in points):
        raise ScpiError(-222)
    output.waveforms[name.upper()] = points


def _choose(output: Output, text: str) -> None:
    name = quoted(text).upper()
    if name not in output.waveforms:
        raise ScpiError(-224)
    output.waveform = name
