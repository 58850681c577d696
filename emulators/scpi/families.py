"""What other families of meters do that the Truevolt series does not."""

from collections.abc import Callable

import numpy as np

from tumble.drivers.simulated.geometry import FloatArray
from tumble.emulators.scpi.command import Command, Reply
from tumble.emulators.scpi.configuration import Configuration
from tumble.emulators.scpi.kinds import write_real
from tumble.emulators.scpi.language import ScpiError, number, quoted
from tumble.emulators.scpi.models import Model
from tumble.emulators.scpi.status import Status
from tumble.emulators.scpi.triggering import Measurement, Triggering

BUFFER: str = "defbuffer1"


def written(readings: FloatArray) -> str:
    """Readings separated by commas."""
    return ",".join(map(write_real, readings.tolist()))


class Families:
    """Commands of the families, and what becomes of a measurement there.

    - Keithley 2000: readings go into a buffer enabled for the next block (User's Manual, 3 "Buffer operations").
    - DMM6500: a loop is loaded into its trigger model, and fills a buffer (Reference Manual, `TRIG:LOAD "SimpleLoop"`).
    - Siglent: `R?` gives readings out as a block, and they are gone (SDM Series Programming Guide, 1.12).
    """

    def __init__(self, model: Model, configuration: Configuration, triggering: Triggering, status: Status) -> None:
        self._model = model
        self._configuration = configuration
        self._triggering = triggering
        self._status = status
        self._loop: tuple[int, float] | None = None
        self._stored: FloatArray | None = None

    def commands(self) -> dict[str, Command]:
        """Those of the model's family."""
        tables: dict[str, Callable[[], dict[str, Command]]] = {
            "keithley 2000": self._keithley_2000,
            "dmm6500": self._dmm6500,
            "siglent": self._siglent,
        }
        return tables[self._model.family]() if self._model.family in tables else {}

    def measurement(self) -> Measurement:
        """What is to be measured now."""
        wanted = self._configuration.measurement
        if self._loop is None:
            return wanted
        count, pause_s = self._loop
        return Measurement(
            count=count,
            interval_s=wanted.interval_s + pause_s,
            source="IMM",
            temperature=wanted.temperature,
            limit_v=wanted.limit_v,
        )

    def measured(self) -> None:
        """Store what was measured where a buffer waits for it."""
        if self._configuration.word("feed_control") == "NEXT":
            self._stored = self._triggering.fetch()[: int(self._configuration.number("points"))]
            self._configuration.assign("feed_control", "NEV")
            self._status.buffer_full = True

    def _keithley_2000(self) -> dict[str, Command]:
        return {
            "TRACe:CLEar": Command(act=self._clear),
            "TRACe:DATA?": Command(act=lambda: self._everything),
            "TRACe:FREE?": Command(act=lambda: "16384,0"),
            "STATus:PRESet": Command(act=lambda: None),
            "STATus:QUEue:CLEar": Command(act=self._status.clear),
            "[SENSe]:DATA:FRESh?": Command(act=lambda: lambda: write_real(float(self._triggering.fetch()[-1]))),
        }

    def _dmm6500(self) -> dict[str, Command]:
        return {
            "TRACe:CLEar": Command(act=self._clear, most=1),
            "TRACe:DATA?": Command(act=self._part, least=2, most=4),
            "TRACe:ACTual?": Command(act=lambda *_: str(len(self._held())), most=1),
            "TRIGger:LOAD": Command(act=self._load, least=2, most=4),
        }

    def _siglent(self) -> dict[str, Command]:
        return {"R?": Command(act=self._block, most=1), "DATA:REMove?": Command(act=self._block, least=1, most=1)}

    def _clear(self, *_buffer: str) -> None:
        self._stored = None
        self._triggering.forget()

    def _everything(self) -> str:
        if self._stored is None:
            raise ScpiError(-230)
        return written(self._stored)

    def _load(self, name: str, count: str, pause_s: str = "0", buffer: str = f'"{BUFFER}"') -> None:
        if quoted(name).upper() != "SIMPLELOOP" or quoted(buffer).lower() != BUFFER:
            raise ScpiError(-224)
        self._loop = round(number(count)), number(pause_s, "S")

    def _part(self, first: str, last: str, buffer: str = f'"{BUFFER}"', element: str = "READ") -> Reply:
        if quoted(buffer).lower() != BUFFER or element.upper() not in ("READ", "READING"):
            raise ScpiError(-224)
        held = self._held()
        begin, end = round(number(first)), round(number(last))
        if not 1 <= begin <= end <= len(held):
            raise ScpiError(-222)
        return written(held[begin - 1 : end])

    def _held(self) -> FloatArray:
        try:
            return np.empty(0) if self._triggering.busy else self._triggering.fetch()
        except ScpiError:
            return np.empty(0)

    def _block(self, most: str = "10000") -> str:
        text = written(self._triggering.take_out(round(number(most))))
        digits = str(len(text))
        return f"#{len(digits)}{digits}{text}"
