"""A multimeter of the 34461A family as the DAQ of a stand."""

import math
from typing import Final, Protocol

import numpy as np

from drivers.clock import Clock
from drivers.errors import DeviceError
from drivers.protocols import Identity, SampleBlock
from drivers.scpi.codec import TERMINATOR, CorruptReplyError, parse_number
from drivers.scpi.exchange import Exchange, Link
from drivers.scpi.measurement import Measurement, perform, temperature, voltage
from drivers.scpi.models import MODELS, SLOWEST, Model

DEVICE: Final = "multimeter"
MOST_AT_ONCE: Final = 10_000
"""Readings that are fetched in one answer, at most."""
READING_BITS: Final = 2 * 16 * 10
"""A reading on a serial line: 16 characters of ten bits, asked for twice."""


class ReopenableLink(Link, Protocol):
    """The way to the multimeter; `drivers.links.SerialLink` is one."""

    def reopen(self) -> None:
        """Open it anew. Raises `LinkLostError`."""
        ...


class ScpiMultimeter:
    """DC voltage, and temperature where a sensor is connected. Fits `drivers.protocols.Daq` and `Reconnectable`.

    Before every block the meter is configured anew and everything is read back. The integration time is the longest
    that the rate allows; a sample timer, or the trigger delay where there is none, fills up the interval. Autozero is
    off within a block: zero is measured once, when the block is configured. `INIT` begins a block and `FETC?` gives its
    readings, as often as one likes; a block that went wrong is taken anew, never pieced together.

    What the wire can do to an answer, and which of it is noticed: `drivers.scpi.codec`.

    Parameters
    ----------
    link
        An open `SerialLink`.
    clock
        The stand's clock, for the time that a block takes.
    range_v
        The smallest of the ranges 0.1, 1, 10, 100 and 1000 V that holds this is taken; autorange where it is None.
    temperature_sensor
        Parameters of `CONF:TEMP` (`FRTD`, `THER`, `FRTD,(@101)` …); None where there is no sensor.
    temperature_age_s
        A block is given the last temperature if it is not older than this; otherwise one is measured behind the block.
    baud_rate
        Of the link, for how long an answer may take.
    timeout_s
        How long a short answer may take, in real seconds.
    """

    def __init__(
        self,
        link: ReopenableLink,
        clock: Clock,
        *,
        range_v: float | None = 10.0,
        temperature_sensor: str | None = None,
        temperature_age_s: float = 10.0,
        baud_rate: int = 115_200,
        timeout_s: float = 1.0,
    ) -> None:
        self._link = link
        self._clock = clock
        self._range_v = range_v
        self._temperature_sensor = temperature_sensor
        self._temperature_age_s = temperature_age_s
        self._reading_s = READING_BITS / baud_rate
        self._exchange = Exchange(link, DEVICE, timeout_s)
        self._model: Model | None = None
        self._line_hz = math.nan
        self._temperature_degc = math.nan
        self._temperature_time_s = -math.inf

    def identify(self) -> Identity:
        """Ask for maker, model, serial number and firmware; errors of the past are forgotten. Raises `DeviceError`."""
        self._link.write(b"SYST:REM" + TERMINATOR)  # an older meter obeys a serial line only after this
        self._exchange.ask(commands=("ABOR", "*CLS"))
        identity = self._exchange.identify()
        self._line_hz = self._asked_line_hz()
        self._model = MODELS.get(identity.model.split()[-1], SLOWEST)
        return identity

    def reconnect(self) -> None:
        """Open the link anew; the meter is to be identified again. Raises `LinkLostError` while it is away."""
        self._link.reopen()
        self._model = None
        self._temperature_time_s = -math.inf

    def acquire(self, samples: int, rate_hz: float) -> SampleBlock:
        """Take `samples` readings at `rate_hz`, beginning now; returns when the last is there.

        What does not fit into the meter's memory, or is more than `MOST_AT_ONCE`, is taken in parts with a moment
        between them. Overloads stay ±9.9e37, and what the meter calls no number is NaN.

        Raises
        ------
        DeviceError
            The meter cannot do it, or failed every time.
        NoReplyError, LinkLostError
            The meter or the way to it is gone.
        """
        if samples < 1 or not rate_hz > 0.0:
            happened = f"{samples} samples at {rate_hz:g} Hz cannot be taken"
            raise DeviceError(DEVICE, happened, "ask for at least one sample at a positive rate")
        if self._model is None:
            self.identify()
        model = self._model or SLOWEST
        began_s = self._clock.monotonic_s()
        most = min(model.memory, MOST_AT_ONCE)
        counts = [min(most, samples - taken) for taken in range(0, samples, most)]
        blocks = [voltage(model, self._line_hz, self._range_v, count, rate_hz) for count in counts]
        return SampleBlock(
            voltage_v=np.concatenate([self._perform(block) for block in blocks]),
            rate_hz=rate_hz,
            device_time_s=began_s,
            temperature_degc=self._measured_degc(),
        )

    def _perform(self, measurement: Measurement) -> np.ndarray[tuple[int], np.dtype[np.float64]]:
        transfer_s = measurement.count * self._reading_s
        return perform(self._exchange, self._clock, measurement, transfer_s)

    def _measured_degc(self) -> float | None:
        """Temperature, measured now unless it was of late."""
        if self._temperature_sensor is None:
            return None
        if self._clock.monotonic_s() - self._temperature_time_s > self._temperature_age_s:
            (self._temperature_degc,) = self._perform(temperature(self._temperature_sensor)).tolist()
            self._temperature_time_s = self._clock.monotonic_s()
        return self._temperature_degc

    def _asked_line_hz(self) -> float:
        (field,) = self._exchange.ask("SYST:LFR?")
        try:
            return parse_number(field)
        except CorruptReplyError as error:
            happened = f"says that its power line has {field} Hz"
            raise DeviceError(DEVICE, happened, "check that it speaks SCPI as a 34461A does") from error
