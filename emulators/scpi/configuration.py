"""How the multimeter is set at the moment."""

from functools import partial
from typing import Final

from tumble.emulators.scpi.command import Command
from tumble.emulators.scpi.kinds import Setting, Value, write_real
from tumble.emulators.scpi.language import ScpiError, number, quoted, spellings
from tumble.emulators.scpi.models import Model
from tumble.emulators.scpi.settings import settings_of
from tumble.emulators.scpi.triggering import Measurement

LINE_HZ: Final = 50.0
TEMPERATURE_S: Final = 0.2
"""Time that a reading of temperature takes: 10 power-line cycles."""

_KEPT: Final = ("display", "display_text", "language", "command_set")
"""What `CONFigure` leaves as it is."""


class Configuration:
    """The values of all settings, and what follows from them."""

    def __init__(self, model: Model) -> None:
        self._model = model
        self._settings = settings_of(model)
        self._values: dict[str, Value] = {}
        self._function = ""
        self.reset()

    def commands(self) -> dict[str, Command]:
        """Commands and queries for everything that can be set."""
        table = {
            "CONFigure?": Command(act=self._summary),
            "DISPlay:TEXT:CLEar": Command(act=lambda: self._values.update(display_text="")),
            "[SENSe]:FUNCtion[:ON]?": Command(act=lambda: f'"{self._function}"'),
            "[SENSe]:VOLTage[:DC]:RESolution": Command(act=self._resolve, least=1, most=1),
            "[SENSe]:VOLTage[:DC]:RESolution?": Command(act=lambda: write_real(self._resolution_v)),
        }
        for name, setting in self._settings.items():
            table[setting.header] = Command(act=partial(self._set, name, setting), least=1, most=1)
            table[f"{setting.header}?"] = Command(act=partial(self._ask, name, setting), most=1)
        return table

    def reset(self) -> None:
        """Set everything as it is after `*RST`."""
        self._values = {name: setting.kind.default for name, setting in self._settings.items()}
        self._function = self._model.voltage_function

    def configure_voltage(self, range_v: str = "DEF", resolution_v: str = "DEF") -> None:
        """Preset everything for DC voltage; a range that is given is kept. Raises `ScpiError`."""
        self._preset(self._model.voltage_function)
        if range_v.upper() not in ("DEF", "AUTO"):
            self._set("range_v", self._settings["range_v"], range_v)
        if resolution_v.upper() != "DEF":
            self._resolve(resolution_v)

    def configure_temperature(self, *_sensor: str) -> None:
        """Preset everything for temperature; whatever the sensor is, the world has one thermometer."""
        self._preset("TEMP")

    def choose(self, function: str) -> None:
        """Choose what to measure, and leave the rest as it is. Raises `ScpiError`."""
        name = quoted(function).upper()
        if name in spellings("VOLTage[:DC]"):
            self._function = self._model.voltage_function
        elif name in spellings("TEMPerature"):
            self._function = "TEMP"
        else:
            raise ScpiError(-224)

    def word(self, name: str) -> str:
        """A setting that is a word; empty where the model has none of that name."""
        return str(self._values.get(name, ""))

    def assign(self, name: str, value: Value) -> None:
        """Let a setting change by itself."""
        self._values[name] = value

    def number(self, name: str) -> float:
        """A setting that is a number."""
        return float(self._values[name])

    @property
    def measurement(self) -> Measurement:
        """What would be measured now."""
        readings = self.number("samples") * self.number("trigger_count")
        return Measurement(
            count=int(min(readings, self._model.memory)),
            interval_s=self._interval_s,
            source=str(self._values["trigger_source"]),
            temperature=self._function == "TEMP",
            limit_v=self._limit_v,
        )

    @property
    def _limit_v(self) -> float:
        return 1000.0 if self._values["autorange"] else self.number("range_v")

    @property
    def _reading_s(self) -> float:
        """How long one reading takes; with autozero each is followed by one of zero."""
        if self._function == "TEMP":
            return TEMPERATURE_S
        in_seconds = self._values["aperture_on"]
        aperture_s = self.number("aperture_s") if in_seconds else self.number("nplc") / LINE_HZ
        return aperture_s * (2.0 if self._values["autozero"] else 1.0)

    @property
    def _interval_s(self) -> float:
        if "TIM" in (self._values["sample_source"], self._values["trigger_source"]):
            return max(self.number("timer_s"), self._reading_s)
        return self._reading_s + (0.0 if self._values["auto_delay"] else self.number("delay_s"))

    @property
    def _resolution_v(self) -> float:
        by_nplc = zip(self._model.nplc, self._model.resolution, strict=True)
        fraction = next(fraction for nplc, fraction in by_nplc if nplc >= self.number("nplc"))
        return fraction * self.number("range_v")

    def _resolve(self, text: str) -> None:
        """Take the shortest integration time that resolves so much. Raises `ScpiError`."""
        finest, coarsest = self._model.resolution[-1], self._model.resolution[0]
        names = {"MIN": finest, "MAX": coarsest, "DEF": 1e-6}
        fraction = names.get(text.upper()) or number(text, "V") / self.number("range_v")
        by_nplc = zip(self._model.nplc, self._model.resolution, strict=True)
        fitting = [nplc for nplc, resolution in by_nplc if resolution <= fraction * (1.0 + 1e-9)]
        if not fitting:
            raise ScpiError(-222)
        self._values.update(nplc=fitting[0], aperture_on=0.0)

    def _preset(self, function: str) -> None:
        kept: dict[str, Value] = {name: self._values[name] for name in _KEPT if name in self._values}
        self.reset()
        self._values |= kept
        self._function = function

    def _set(self, name: str, setting: Setting, text: str) -> None:
        self._values.update({name: setting.kind.read(text), **setting.also})

    def _ask(self, name: str, setting: Setting, extreme: str = "") -> str:
        if name == "timer_s" and extreme.upper().startswith("MIN"):
            return write_real(self._reading_s)
        return setting.kind.write(setting.kind.read(extreme) if extreme else self._values[name])

    def _summary(self) -> str:
        if self._function == "TEMP" or self._model.family == "keithley 2000":
            return f'"{self._function}"'
        return f'"{self._function} {write_real(self.number("range_v"))},{write_real(self._resolution_v)}"'
