"""A block of readings: what the multimeter is told for it, in its dialect."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

from tumble.drivers.errors import DeviceError
from tumble.drivers.scpi.dialects import Dialect
from tumble.drivers.scpi.models import Model
from tumble.messages import Message

TEMPERATURE_S: Final = 5.0
"""A reading of temperature takes less than this, in real seconds."""
READ: Final = "READ?"
"""Begins a block and asks for its readings, which cannot be asked for again."""
TOLERANCE: Final = 1e-4
"""Relative difference allowed between what was set and what is read back."""

Setting = tuple[str, float | str]
"""Header and value."""


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """What is measured, and how."""

    function: str
    """Asks what is measured."""
    functions: tuple[str, ...]
    """Right answers to that, without quotation marks."""
    configure: tuple[str, ...]
    """The commands that preset everything for it."""
    settings: tuple[Setting, ...] = ()
    """What is set after that, in this order."""
    arm: tuple[str, ...] = ()
    """Commands after that."""
    begin: tuple[str, ...] = ("INIT",)
    """Commands that begin it; none where asking for the readings does."""
    fetch: str = "FETC?"
    count: int = 1
    duration_s: float = 0.0
    """By the stand's clock, in s."""
    extra_s: float = 0.0
    """How much longer than an ordinary answer the readings may take, in real seconds."""
    channels: str = ""
    """Channel list of a scanner, `(@101,102)`."""
    by_channel: frozenset[str] = frozenset()
    """Headers of the settings that each of these has for itself."""

    @property
    def preparation(self) -> tuple[str, ...]:
        """All commands before it begins."""
        listed = dict.fromkeys(self.by_channel, f",{self.channels}")
        assignments = (f"{header} {written(value)}{listed.get(header, '')}" for header, value in self.settings)
        return (*self.configure, *assignments, *self.arm)

    @property
    def questions(self) -> tuple[str, ...]:
        """What is asked to read everything back: the function, where it can be asked, then the settings."""
        listed = dict.fromkeys(self.by_channel, f" {self.channels}")
        asked = (f"{header}?{listed.get(header, '')}" for header, _ in self.settings)
        return (*filter(None, (self.function,)), *asked)


def voltage(model: Model, line_hz: float, range_v: float | None, count: int, rate_hz: float) -> Measurement:
    """DC voltage, `count` times at `rate_hz`, in the smallest range that holds `range_v`; autorange where that is None.

    Raises `DeviceError` where the model cannot be as fast, for instance because even its shortest integration time is
    too long.
    """
    dialect, values = model.dialect, _values(model, line_hz, range_v, count, rate_hz)
    ranging = dialect.autorange if range_v is None else dialect.fixed_range
    settings = tuple(setting(text, values) for text in (ranging, *dialect.settings) if text)
    return Measurement(
        function=dialect.function,
        functions=dialect.functions,
        configure=(*dialect.prepare, *(_filled(text, values) for text in dialect.configure)),
        settings=settings,
        arm=tuple(_filled(text, values) for text in dialect.arm),
        begin=dialect.begin if dialect.keeps else (),
        fetch=_filled(dialect.fetch, values) if dialect.keeps else READ,
        count=count,
        duration_s=count / rate_hz,
    )


def temperature(dialect: Dialect, sensor: str) -> Measurement:
    """One reading of temperature with a sensor as `CONF:TEMP` names it.

    Raises `DeviceError` where it is not known how the multimeter measures it.
    """
    if not dialect.temperature:
        raise DeviceError(
            Message("multimeter"),
            Message("is not known to measure temperature ({dialect} dialect)", dialect=dialect.name),
            Message("leave temperature_sensor out of the stand file"),
        )
    command, *settings = dialect.temperature
    return Measurement(
        function=dialect.function,
        functions=("TEMP",),
        configure=(*dialect.prepare, command.format(sensor=sensor)),
        settings=tuple(setting(text, {}) for text in settings),
        begin=dialect.begin if dialect.keeps else (),
        fetch=dialect.fetch if dialect.keeps else READ,
        extra_s=TEMPERATURE_S,
    )


def setting(text: str, values: Mapping[str, float | str]) -> Setting:
    """A setting of a dialect, with the values that are in force."""
    header, _, value = text.partition(" ")
    if value.startswith("{"):
        return header, values[value[1:-1]]
    try:
        return header, float(value)
    except ValueError:
        return header, value


def written(value: float | str) -> str:
    """The value as a parameter."""
    return value if isinstance(value, str) else f"{value:.9g}"


def _filled(text: str, values: Mapping[str, float | str]) -> str:
    return text.format_map({name: written(value) for name, value in values.items()})


def _values(model: Model, line_hz: float, range_v: float | None, count: int, rate_hz: float) -> dict[str, float | str]:
    """What may stand in braces."""
    interval_s = 1.0 / rate_hz
    fitting = [nplc for nplc in model.nplc if nplc / line_hz <= interval_s * (1.0 + TOLERANCE)]
    most_hz = model.most_hz or (line_hz / model.nplc[0] if model.nplc else rate_hz)
    if rate_hz > most_hz * (1.0 + TOLERANCE) or (model.nplc and not fitting):
        raise DeviceError(
            Message("multimeter"),
            Message("cannot take {rate_hz:g} samples a second", rate_hz=rate_hz),
            Message("ask for {most_hz:g} at most", most_hz=most_hz),
        )
    nplc = fitting[-1] if fitting else 0.0
    return {
        "expected_v": "DEF" if range_v is None else range_v,
        "range_v": next((known_v for known_v in model.ranges_v if known_v >= (range_v or 0.0)), model.ranges_v[-1]),
        "nplc": nplc,
        "interval_s": round(interval_s, 6),
        "spare_s": round(max(interval_s - nplc / line_hz, 0.0), 6),
        "count": float(count),
    }
