"""What can be set at the multimeter, within which bounds, and how it is written in an answer."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from emulators.scpi.language import ScpiError, number, quoted, word

Value = float | str
"""A number, also for switches (0 and 1), or a word."""


class Kind(Protocol):
    """How the values of a setting are read and written."""

    @property
    def default(self) -> Value:
        """Value after `*RST`."""
        ...

    def read(self, text: str) -> Value:
        """Value of a parameter. Raises `ScpiError`."""
        ...

    def write(self, value: Value) -> str:
        """The value as an answer."""
        ...


@dataclass(frozen=True, kw_only=True)
class Quantity:
    """A number with bounds; with `steps` it is rounded up to the next of them. Fits `Kind`."""

    low: float
    high: float
    default: float
    unit: str = ""
    steps: tuple[float, ...] = ()
    unlimited: bool = False
    """Whether INF is allowed."""

    def read(self, text: str) -> float:
        """A number, MIN, MAX, DEF, or INF where it is allowed."""
        names = {"MINimum": self.low, "MAXimum": self.high, "DEFault": self.default}
        if self.unlimited:
            names["INFinity"] = math.inf
        if text[:1].isalpha():
            meant = word(text, tuple(names))
            return next(value for name, value in names.items() if name.startswith(meant))
        value = number(text, self.unit)
        if not self.low <= value <= self.high:
            raise ScpiError(-222)
        return next((step for step in self.steps if step >= value * (1.0 - 1e-9)), value)

    def write(self, value: Value) -> str:
        """As the instrument writes a reading."""
        return write_real(float(value))


@dataclass(frozen=True, kw_only=True)
class Count(Quantity):
    """A whole number. Fits `Kind`."""

    def read(self, text: str) -> float:
        """A number, rounded."""
        value = super().read(text)
        return float(round(value)) if math.isfinite(value) else value

    def write(self, value: Value) -> str:
        """Without a decimal point, as NR1."""
        return f"{int(value):+d}" if math.isfinite(float(value)) else write_real(float(value))


@dataclass(frozen=True, kw_only=True)
class Switch:
    """On or off; ONCE does its work and leaves it off. Fits `Kind`."""

    default: float

    def read(self, text: str) -> float:
        """ON, OFF, ONCE or a number, of which all but 0 mean on."""
        if text[:1].isalpha():
            return float(word(text, ("ON", "OFF", "ONCE")) == "ON")
        return float(round(number(text)) != 0)

    def write(self, value: Value) -> str:
        """As 0 or 1."""
        return str(int(value))


@dataclass(frozen=True, kw_only=True)
class Choice:
    """One of several words. Fits `Kind`."""

    choices: tuple[str, ...]
    default: str

    def read(self, text: str) -> str:
        """The word in its short form."""
        return word(text, self.choices)

    def write(self, value: Value) -> str:
        """The short form."""
        return str(value)


@dataclass(frozen=True, kw_only=True)
class Text:
    """Any text in quotation marks. Fits `Kind`."""

    default: str = ""

    def read(self, text: str) -> str:
        """What stands between the marks."""
        return quoted(text)

    def write(self, value: Value) -> str:
        """In quotation marks."""
        return f'"{value}"'


@dataclass(frozen=True, kw_only=True)
class Setting:
    """Something that can be set and asked."""

    header: str
    kind: Kind
    also: Mapping[str, float] = field(default_factory=dict)
    """Other settings that change with it."""


@dataclass(frozen=True, kw_only=True)
class Model:
    """What differs from one model to the next: data sheets, DC voltage."""

    maker: str
    firmware: str
    nplc: tuple[float, ...]
    """Integration times in power-line cycles that can be chosen."""
    resolution: tuple[float, ...]
    """Resolution at each of them, as a fraction of the range."""
    voltage_function: str = "VOLT"
    """How it names DC voltage when asked for its function."""


_TRUEVOLT = "A.02.17-02.40-02.17-00.52-04-02"
_KEYSIGHT, _AGILENT = "Keysight Technologies", "Agilent Technologies"
_SLOW = (0.02, 0.06, 0.2, 1.0, 10.0, 100.0)

MODELS: Mapping[str, Model] = {
    "34461A": Model(
        maker=_KEYSIGHT,
        firmware=_TRUEVOLT,
        nplc=(0.02, 0.2, 1.0, 10.0, 100.0),
        resolution=(1e-4, 1e-5, 3e-6, 1e-6, 3e-7),
    ),
    "34465A": Model(maker=_KEYSIGHT, firmware=_TRUEVOLT, nplc=_SLOW, resolution=(3e-6, 1.5e-6, 7e-7, 3e-7, 1e-7, 3e-8)),
    "34410A": Model(
        maker=_AGILENT,
        firmware="2.35-2.35-0.09-46-09",
        nplc=(0.006, 0.02, 0.06, 0.2, 1.0, 2.0, 10.0, 100.0),
        resolution=(6e-6, 3e-6, 1.5e-6, 7e-7, 3e-7, 2e-7, 1e-7, 3e-8),
    ),
    "MODEL DMM6500": Model(
        maker="KEITHLEY INSTRUMENTS",
        firmware="1.7.12b",
        nplc=(0.0005, 0.001, 0.01, 0.1, 1.0, 10.0, 15.0),
        resolution=(1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 2e-7),
        voltage_function="VOLT:DC",
    ),
}

_SENSE = "[SENSe]:VOLTage[:DC]"
RANGES_V = (0.1, 1.0, 10.0, 100.0, 1000.0)


def settings_of(model: Model) -> dict[str, Setting]:
    """Every setting of a model by a short name."""
    nplc = Quantity(low=model.nplc[0], high=model.nplc[-1], default=10.0, steps=model.nplc)
    volts = Quantity(low=RANGES_V[0], high=RANGES_V[-1], default=10.0, unit="V", steps=RANGES_V)
    seconds = Quantity(low=0.0, high=3600.0, default=0.0, unit="S")
    on, off = Switch(default=1.0), Switch(default=0.0)
    return {
        "nplc": Setting(header=f"{_SENSE}:NPLCycles", kind=nplc, also={"aperture_on": 0.0}),
        "aperture_s": Setting(
            header=f"{_SENSE}:APERture",
            kind=Quantity(low=2e-5, high=2.0, default=0.2, unit="S"),
            also={"aperture_on": 1.0},
        ),
        "aperture_on": Setting(header=f"{_SENSE}:APERture:ENABled", kind=off),
        "range_v": Setting(header=f"{_SENSE}:RANGe[:UPPer]", kind=volts, also={"autorange": 0.0}),
        "autorange": Setting(header=f"{_SENSE}:RANGe:AUTO", kind=on),
        "autozero": Setting(header=f"{_SENSE}:ZERO:AUTO", kind=on),
        "trigger_source": Setting(
            header="TRIGger:SOURce",
            kind=Choice(choices=("IMMediate", "BUS", "EXTernal", "INTernal"), default="IMM"),
        ),
        "trigger_count": Setting(header="TRIGger:COUNt", kind=Count(low=1.0, high=1e6, default=1.0, unlimited=True)),
        "delay_s": Setting(header="TRIGger:DELay", kind=seconds, also={"auto_delay": 0.0}),
        "auto_delay": Setting(header="TRIGger:DELay:AUTO", kind=on),
        "slope": Setting(header="TRIGger:SLOPe", kind=Choice(choices=("POSitive", "NEGative"), default="NEG")),
        "samples": Setting(header="SAMPle:COUNt", kind=Count(low=1.0, high=1e6, default=1.0)),
        "pretrigger": Setting(header="SAMPle:COUNt:PRETrigger", kind=Count(low=0.0, high=49999.0, default=0.0)),
        "sample_source": Setting(header="SAMPle:SOURce", kind=Choice(choices=("IMMediate", "TIMer"), default="IMM")),
        "timer_s": Setting(header="SAMPle:TIMer", kind=seconds),
        "display": Setting(header="DISPlay[:STATe]", kind=on),
        "display_text": Setting(header="DISPlay:TEXT[:DATA]", kind=Text()),
        "language": Setting(header="*LANG", kind=Choice(choices=("SCPI", "TSP"), default="SCPI")),
    }


def write_real(value: float) -> str:
    """A number as these instruments write it: infinity and NaN as in SCPI-1999, volume 1, 7.2.1.5."""
    if math.isnan(value):
        value = 9.91e37
    elif math.isinf(value):
        value = math.copysign(9.9e37, value)
    return f"{value:+.8E}"
