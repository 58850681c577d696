"""A SCPI multimeter as the DAQ of a stand."""

import math
from dataclasses import dataclass
from typing import Final, Protocol

import numpy as np
from numpy.typing import NDArray

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Identity, SampleBlock
from tumble.drivers.scpi.acquaintance import DEVICE, Acquaintance, acquaint
from tumble.drivers.scpi.exchange import Link
from tumble.drivers.scpi.measurement import Measurement, temperature, voltage
from tumble.drivers.scpi.taking import perform, perform_singly
from tumble.messages import Message

MOST_AT_ONCE: Final = 10_000
"""Readings that are fetched in one answer, at most."""
READING_BITS: Final = 2 * 16 * 10
"""A reading on a serial line: 16 characters of ten bits, asked for twice."""


class ReopenableLink(Link, Protocol):
    """The way to the multimeter; `tumble.drivers.links.SerialLink` is one."""

    def reopen(self) -> None:
        """Open it anew. Raises `LinkLostError`."""
        ...


class ScpiMultimeter:
    """DC voltage, and temperature where a sensor is connected. Fits `Sampler` and `Reconnectable` of the
    protocols.

    Which multimeters there are, and how each wants to be told: `tumble.drivers.scpi.models` and `dialects`. What
    a meter can is found out when it is identified; what it cannot stands in the remarks of its identity.

    Before every block the meter is configured anew and everything is read back. The integration time is the longest
    that the rate allows; a timer, or the trigger delay where there is none, fills up the interval. Autozero is off
    within a block: zero is measured once, when the block is configured. A block that went wrong is taken anew, never
    pieced together. With the common core readings are taken one by one, as the meter is set by itself.

    What the wire can do to an answer, and which of it is noticed: `tumble.drivers.scpi.codec` and `plain`.

    Parameters
    ----------
    link
        An open `SerialLink`.
    clock
        The stand's clock, for the time that a block takes.
    range_v
        The smallest range of the meter that holds this is taken; autorange where it is None.
    temperature_sensor
        Parameters of `CONF:TEMP` (`FRTD`, `THER`, `FRTD,(@101)` …); None where there is no sensor.
    temperature_age_s
        A block is given the last temperature if it is not older than this; otherwise one is measured behind the block.
    baud_rate
        Of the link, for how long an answer may take.
    common
        Whether it is used by the SCPI that all have, whatever it is; otherwise it must be known by name.
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
        common: bool = False,
        timeout_s: float = 1.0,
    ) -> None:
        self._link = link
        self._clock = clock
        self._range_v = range_v
        self._temperature_sensor = temperature_sensor
        self._temperature_age_s = temperature_age_s
        self._reading_s = READING_BITS / baud_rate
        self._common = common
        self._timeout_s = timeout_s
        self._known: Acquaintance | None = None
        self._blocks = 0
        self._temperature_degc = math.nan
        self._temperature_time_s = -math.inf

    def identify(self) -> Identity:
        """Ask for maker, model, serial number and firmware, and find out what it can. Raises `DeviceError`."""
        self._known = acquaint(self._link, self._clock, self._timeout_s, self._range_v, common=self._common)
        if self._temperature_sensor is not None:
            temperature(self._known.model.dialect, self._temperature_sensor)
        return self._known.identity

    def reconnect(self) -> None:
        """Open the link anew; the meter is to be identified again. Raises `LinkLostError` while it is away."""
        self._link.reopen()
        self._known = None
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
            happened = Message("{samples} samples at {rate_hz:g} Hz cannot be taken", samples=samples, rate_hz=rate_hz)
            raise DeviceError(DEVICE, happened, Message("ask for at least one sample at a positive rate"))
        began_s = self._clock.monotonic_s()
        taken = self._taken(self._acquaintance(), samples, rate_hz)
        return SampleBlock(
            voltage_v=taken.voltage_v,
            rate_hz=taken.rate_hz,
            device_time_s=began_s,
            temperature_degc=self._measured_degc(),
        )

    def _acquaintance(self) -> Acquaintance:
        if self._known is None:
            self.identify()
        assert self._known
        return self._known

    def _taken(self, known: Acquaintance, samples: int, rate_hz: float) -> "_Taken":
        model = known.model
        if model.dialect.singly:
            block = voltage(model, known.line_hz, self._range_v, 1, rate_hz)
            return _Taken(*perform_singly(known.exchange, self._clock, block, samples, rate_hz))
        most = min(model.memory, MOST_AT_ONCE)
        counts = [min(most, samples - taken) for taken in range(0, samples, most)]
        return _Taken(np.concatenate([self._block(known, count, rate_hz) for count in counts]), rate_hz)

    def _block(self, known: Acquaintance, count: int, rate_hz: float) -> NDArray[np.float64]:
        """A block that fits into the meter's memory.

        Where errors cannot be asked for, a beginning that was not heard would leave the readings of the block before:
        every other block is longer by one reading, so that they are told by their number.
        """
        self._blocks += 1
        spare = 0 if known.exchange.has_error_queue else self._blocks % 2
        wanted = max(count + spare, known.model.least)
        block = voltage(known.model, known.line_hz, self._range_v, wanted, rate_hz)
        return self._perform(known, block)[:count]

    def _perform(self, known: Acquaintance, measurement: Measurement) -> NDArray[np.float64]:
        transfer_s = measurement.count * self._reading_s
        return perform(known.exchange, self._clock, measurement, transfer_s)

    def _measured_degc(self) -> float | None:
        """Temperature, measured now unless it was of late."""
        if self._temperature_sensor is None:
            return None
        if self._clock.monotonic_s() - self._temperature_time_s > self._temperature_age_s:
            known = self._acquaintance()
            measurement = temperature(known.model.dialect, self._temperature_sensor)
            (self._temperature_degc,) = self._perform(known, measurement).tolist()
            self._temperature_time_s = self._clock.monotonic_s()
        return self._temperature_degc


@dataclass(frozen=True)
class _Taken:
    voltage_v: NDArray[np.float64]
    rate_hz: float
