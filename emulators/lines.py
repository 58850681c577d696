"""An emulated instrument that tells what it sees of a world in lines of text."""

from collections.abc import Iterator, Mapping
from random import Random
from typing import Final

from tumble.drivers.lines.declaration import LinesTable
from tumble.emulators.faults import Faults
from tumble.emulators.pace import Pace
from tumble.emulators.wire import spoilt
from tumble.emulators.world import SharedWorld

MODEL: Final = "tumble emulated platform"
FIRMWARE: Final = "1.0"
SMALLER_UNIT: Final = 3600.0
"""By which a rate is greater in °/h than in °/s."""
_SPOILT: Final = ("cut", "double", "garble", "wrong_checksum")


class EmulatedLines:
    """The instrument; what every client hears of it is a `LinesSession`.

    Parameters
    ----------
    world
        Where it is wired.
    table
        What its lines look like, what it is asked, and its rate.
    faults
        What goes wrong in it, a line at a time: `nan`, `overload`, `frames_lost`, `stale`, `other_unit`, `power_loss`
        (it is silent for `lasts_s`, by the clock of the world), and what may happen on a wire.
    """

    def __init__(self, world: SharedWorld, table: LinesTable, faults: Faults) -> None:
        self.world, self.table = world, table
        self._faults = faults
        self._form = table.form
        self._serial = 90001
        self._count = -1
        self._values: Mapping[str, float] = {}
        self._silent_until_s = 0.0
        self._random = Random(1)

    def identity(self) -> bytes:
        """The line in which it says who it is."""
        if self._faults.take("swapped"):
            self._serial += 1
        return f"{self.table.identity_start}{MODEL},{self._serial},{FIRMWARE}\r\n".encode()

    def lines(self, samples: int) -> bytes:
        """So many lines from now on, spoilt as the faults say."""
        with self.world.lock:
            block = self.world.daq.take(samples, self.table.rate_hz)
            now_s = self.world.clock.monotonic_s()
        columns = {name: values.tolist() for name, values in block.channels.items()}
        rows = [{name: values[row] for name, values in columns.items()} for row in range(samples)]
        degc = block.temperature_degc or 0.0
        return b"".join(line for row in rows for line in self._line(row, degc, now_s))

    def _line(self, values: dict[str, float], degc: float, now_s: float) -> Iterator[bytes]:
        if fault := self._faults.take("power_loss"):
            self._silent_until_s = now_s + fault.lasts_s
        if now_s < self._silent_until_s:
            return
        fault = self._faults.take("nan", "overload", "frames_lost", "stale", "other_unit", *_SPOILT)
        kind = fault.kind if fault else ""
        if kind != "stale" or not self._values:
            self._count = (self._count + 1) % self.table.counter_modulus
            self._values = values
        told = {
            "nan": dict.fromkeys(values, float("nan")),
            "overload": dict.fromkeys(values, 9.9e37),
            "other_unit": {name: value * SMALLER_UNIT for name, value in values.items()},
        }.get(kind, self._values)
        if kind != "frames_lost":
            line = self._form.write(told, degc, self._count)
            yield spoilt(line, kind, self._random) if kind in _SPOILT else line


class LinesSession:
    """What one client hears. Fits `tumble.emulators.serving.Session`."""

    def __init__(self, instrument: EmulatedLines) -> None:
        self._instrument = instrument
        self._pace = Pace(instrument.world.clock, instrument.table.rate_hz)

    def received(self, data: bytes) -> bytes:
        """Answer a request: for a line, or for who it is."""
        table, text = self._instrument.table, data.decode("ascii", "replace").strip()
        if table.identity_request and text == table.identity_request:
            return self._instrument.identity()
        return self._instrument.lines(1) if table.request and text == table.request else b""

    def due(self) -> bytes:
        """The lines that it sends by itself, if it does."""
        samples = self._pace.due()
        return self._instrument.lines(samples) if samples and not self._instrument.table.request else b""
