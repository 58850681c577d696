"""An emulated voltmeter with a scanner: 34970A and DAQ970A class, wired to outputs and thermometers of a world.

Sources: 34970A User's Guide (34970-90003), 5 "Remote Interface Reference"; DAQ970A Programming Guide.
"""

import re
from collections.abc import Mapping
from functools import partial
from typing import Final

from tumble.drivers.tables import DaqTable
from tumble.emulators.faults import Faults
from tumble.emulators.scpi.command import Command, Reply
from tumble.emulators.scpi.configuration import LINE_HZ, TEMPERATURE_S
from tumble.emulators.scpi.kinds import write_real
from tumble.emulators.scpi.language import ScpiError, Tree, number, word
from tumble.emulators.scpi.meter import Multimeter
from tumble.emulators.scpi.sweeps import Sweep, Sweeping
from tumble.emulators.world import SharedWorld

MODEL: Final = "DAQ970A"
_LIST: Final = re.compile(r"\(@\d{3}(?::\d{3})?(?:,\d{3}(?::\d{3})?)*\)")
_SOURCES: Final = ("IMMediate", "BUS", "EXTernal", "TIMer")
_DEFAULTS: Final = {"range_v": 10.0, "nplc": 1.0}


def scanner_of(shared: SharedWorld, table: DaqTable, faults: Faults) -> "EmulatedScanner":
    """The scanner of a stand file; one that is only simulated has its outputs at 101 and thermometers at 111 and on."""
    scan = getattr(table, "scan", None) or {name: 101 + place for place, name in enumerate(table.channels)}
    own = getattr(table, "thermometers", None)
    thermometers = {name: 111 + place for place, name in enumerate(scan)} if own is None else own
    world = shared.wired_to(channels=tuple(scan))
    outputs = {number: name for name, number in scan.items()}
    return EmulatedScanner(world, faults, outputs, {number: name for name, number in thermometers.items()})


class EmulatedScanner(Multimeter):
    """Answers SCPI messages with what outputs and thermometers of the world say, by the number of the channel.

    Parameters
    ----------
    world
        Where it is wired.
    faults
        What shall go wrong in it, as in `Multimeter`.
    outputs
        Name of the output at each channel of the scanner.
    thermometers
        Of which output the thermometer at a channel is.
    """

    def __init__(
        self, world: SharedWorld, faults: Faults, outputs: Mapping[int, str], thermometers: Mapping[int, str]
    ) -> None:
        super().__init__(world, faults, model=MODEL, serial="MY58000001")
        self._wired = {**outputs, **thermometers}
        self._triggering: Sweeping = Sweeping(world, faults, outputs, thermometers)
        self._functions: dict[int, str] = {}
        self._values: dict[str, dict[int, float]] = {}
        self._trigger: dict[str, float | str] = {}
        self._reset()
        self._commands = Tree(self._common() | self._system() | self._scanning())

    def _scanning(self) -> dict[str, Command]:
        sense = "[SENSe]:VOLTage[:DC]"
        table = {
            "CONFigure:VOLTage[:DC]": Command(act=partial(self._configure, "VOLT"), least=1, most=3),
            "CONFigure:TEMPerature": Command(act=partial(self._configure, "TEMP"), least=1, most=5),
            "[SENSe]:FUNCtion?": Command(act=self._function, most=1),
            "ROUTe:SCAN": Command(act=self._choose, least=1, most=1),
            "ROUTe:SCAN?": Command(act=self._scan_list),
            "ROUTe:SCAN:SIZE?": Command(act=lambda: f"{len(self._triggering.scan):+d}"),
            "TRIGger:SOURce": Command(act=self._set_source, least=1, most=1),
            "TRIGger:SOURce?": Command(act=lambda: str(self._trigger["source"])),
            "INITiate": Command(act=self._begin),
            "ABORt": Command(act=self._triggering.abort),
            "FETCh?": Command(act=lambda: self._fetch),
            "READ?": Command(act=self._read),
        }
        for name, header in (("timer_s", "TRIGger:TIMer"), ("count", "TRIGger:COUNt")):
            table[header] = Command(act=partial(self._set_trigger, name), least=1, most=1)
            table[f"{header}?"] = Command(act=partial(self._ask_trigger, name))
        for name, header in (("range_v", f"{sense}:RANGe"), ("nplc", f"{sense}:NPLCycles")):
            table[header] = Command(act=partial(self._set, name), least=1, most=2)
            table[f"{header}?"] = Command(act=partial(self._ask, name), most=1)
        return table

    def _configure(self, function: str, *parameters: str) -> None:
        """Preset channels, which become the scan list."""
        channels = self._channels(parameters[-1])
        self._triggering.forget()
        for channel in channels:
            self._functions[channel] = function
            for name, default in _DEFAULTS.items():
                self._values[name][channel] = default
        self._triggering.scan = channels
        self._trigger = {"source": "IMM", "timer_s": 10.0, "count": 1.0}

    def _channels(self, text: str) -> tuple[int, ...]:
        """The channels of a list; all must be there. Raises `ScpiError`."""
        if not _LIST.fullmatch(text):
            raise ScpiError(-102)
        found: list[int] = []
        for part in text[2:-1].split(","):
            first, _, last = part.partition(":")
            found += range(int(first), int(last or first) + 1)
        if any(channel not in self._wired for channel in found):
            raise ScpiError(-222)
        return tuple(found)

    def _meant(self, listed: tuple[str, ...]) -> tuple[int, ...]:
        return self._channels(listed[0]) if listed else self._triggering.scan

    def _function(self, *listed: str) -> str:
        return ",".join(f'"{self._functions.get(channel, "VOLT")}"' for channel in self._meant(listed))

    def _choose(self, listed: str) -> None:
        self._triggering.forget()
        self._triggering.scan = self._channels(listed)

    def _scan_list(self) -> str:
        text = f"(@{','.join(map(str, self._triggering.scan))})"
        return f"#{len(str(len(text)))}{len(text)}{text}"

    def _set(self, name: str, value: str, *listed: str) -> None:
        for channel in self._meant(listed):
            self._values[name][channel] = number(value, "V" if name == "range_v" else "")

    def _ask(self, name: str, *listed: str) -> str:
        own = self._values[name]
        return ",".join(write_real(own.get(channel, _DEFAULTS[name])) for channel in self._meant(listed))

    def _set_source(self, text: str) -> None:
        self._trigger["source"] = word(text, _SOURCES)

    def _set_trigger(self, name: str, text: str) -> None:
        self._trigger[name] = number(text, "S" if name == "timer_s" else "")

    def _ask_trigger(self, name: str) -> str:
        return write_real(float(self._trigger[name]))

    def _begin(self) -> None:
        """Sweep over the scan list; a sweep takes at least as long as its readings."""
        takes_s = sum(map(self._reading_s, self._triggering.scan))
        timed = self._trigger["source"] == "TIM"
        interval_s = max(float(self._trigger["timer_s"]), takes_s) if timed else takes_s
        limits_v = {channel: self._values["range_v"].get(channel, 10.0) for channel in self._triggering.scan}
        self._triggering.sweep(Sweep(int(float(self._trigger["count"])), interval_s, self._functions, limits_v))

    def _reading_s(self, channel: int) -> float:
        """With autozero every reading is followed by one of zero."""
        if self._functions.get(channel) == "TEMP":
            return TEMPERATURE_S
        return 2.0 * self._values["nplc"].get(channel, 1.0) / LINE_HZ

    def _read(self) -> Reply:
        self._triggering.abort()
        self._begin()
        return self._fetch

    def _reset(self) -> None:
        super()._reset()
        self._functions = {}
        self._values = {name: {} for name in _DEFAULTS}
        self._trigger = {"source": "IMM", "timer_s": 10.0, "count": 1.0}
