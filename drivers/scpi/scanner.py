"""A voltmeter with a scanner (34970A and DAQ970A class): several channels, one after the other in every sweep."""

import math
from collections.abc import Mapping, Sequence
from typing import Final

import numpy as np

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import ChannelBlock, FloatArray, Identity
from tumble.drivers.scpi.acquaintance import Acquaintance, acquaint_with_scanner
from tumble.drivers.scpi.measurement import TEMPERATURE_S, TOLERANCE, Measurement, setting
from tumble.drivers.scpi.meter import MOST_AT_ONCE, READING_BITS, ReopenableLink
from tumble.drivers.scpi.taking import perform
from tumble.messages import Message

SWITCHING_S: Final = 1.0 / 60.0
"""From one channel to the next: the 34901A switches 60 channels a second."""
DEVICE: Final = Message("scanner")
_BY_CHANNEL: Final = frozenset({"VOLT:DC:RANG", "VOLT:DC:NPLC"})


class Scanner:
    """DC voltage of several channels, and the temperature of each. Fits `Sampler` and `Reconnectable` of the protocols.

    Before every block it is configured anew and everything is read back. The integration time is the longest that the
    rate allows. Temperatures are taken in a sweep of their own behind a block, unless they were of late.

    Parameters
    ----------
    link
        An open `SerialLink`.
    clock
        The stand's clock.
    scan
        Number of the scanner's channel (`101`: slot 1, channel 1) by the name of what is measured there.
    thermometers
        Number of the channel with the thermometer of each of them, as far as there is one.
    sensor
        Parameters of `CONF:TEMP` before the channel list (`FRTD,85`, `TC,T`).
    range_v
        The smallest range that holds this is taken.
    baud_rate
        Of the link, for how long an answer may take.
    """

    def __init__(
        self,
        link: ReopenableLink,
        clock: Clock,
        *,
        scan: Mapping[str, int],
        thermometers: Mapping[str, int],
        sensor: str = "FRTD,85",
        range_v: float = 10.0,
        baud_rate: int = 115_200,
    ) -> None:
        self._link, self._clock = link, clock
        self._scan, self._thermometers, self._sensor = scan, thermometers, sensor
        self._range_v = range_v
        self._reading_s = READING_BITS / baud_rate
        self._known: Acquaintance | None = None
        self._temperatures_degc: dict[str, float] = {}
        self._temperature_time_s = -math.inf

    def identify(self) -> Identity:
        """Ask for maker, model, serial number and firmware. Raises `DeviceError`."""
        self._known = acquaint_with_scanner(self._link, TIMEOUT_S)
        return self._known.identity

    def reconnect(self) -> None:
        """Open the link anew; it is to be identified again. Raises `LinkLostError` while it is away."""
        self._link.reopen()
        self._known = None
        self._temperature_time_s = -math.inf

    def acquire(self, samples: int, rate_hz: float) -> ChannelBlock:
        """Take `samples` sweeps at `rate_hz`, beginning now; returns when the last is there.

        Raises
        ------
        DeviceError
            It cannot do it, or failed every time.
        NoReplyError, LinkLostError
            It, or the way to it, is gone.
        """
        known = self._known or self._identified()
        began_s = self._clock.monotonic_s()
        most = min(known.model.memory, MOST_AT_ONCE) // len(self._scan)
        counts = [min(most, samples - taken) for taken in range(0, samples, most)]
        sweeps = np.concatenate([self._sweeps(known, count, rate_hz) for count in counts])
        temperatures_degc = self._measured_degc(known)
        mean_degc = sum(temperatures_degc.values()) / len(temperatures_degc) if temperatures_degc else None
        return ChannelBlock(
            channels={name: np.ascontiguousarray(sweeps[:, place]) for place, name in enumerate(self._scan)},
            rate_hz=rate_hz,
            device_time_s=began_s,
            temperature_degc=mean_degc,
            temperatures_degc=temperatures_degc,
        )

    def _identified(self) -> Acquaintance:
        self.identify()
        assert self._known
        return self._known

    def _sweeps(self, known: Acquaintance, count: int, rate_hz: float) -> FloatArray:
        """Sweeps that fit into its memory, shape (count, channels)."""
        measurement = sweeps(known, list(self._scan.values()), self._range_v, count, rate_hz)
        transfer_s = measurement.count * self._reading_s
        return perform(known.exchange, self._clock, measurement, transfer_s).reshape(count, len(self._scan))

    def _measured_degc(self, known: Acquaintance) -> dict[str, float]:
        """Temperatures by channel, measured now unless they were of late."""
        if self._thermometers and self._clock.monotonic_s() - self._temperature_time_s > TEMPERATURE_AGE_S:
            measurement = thermometers(known, list(self._thermometers.values()), self._sensor)
            degc = perform(known.exchange, self._clock, measurement, 0.0).tolist()
            self._temperatures_degc = dict(zip(self._thermometers, degc, strict=True))
            self._temperature_time_s = self._clock.monotonic_s()
        return dict(self._temperatures_degc)


TIMEOUT_S: Final = 1.0
"""How long a short answer may take, in real seconds."""
TEMPERATURE_AGE_S: Final = 10.0
"""A block is given the last temperatures if they are not older than this."""


def channel_list(numbers: Sequence[int]) -> str:
    """`(@101,102)`."""
    return f"(@{','.join(map(str, numbers))})"


def sweeps(known: Acquaintance, numbers: Sequence[int], range_v: float, count: int, rate_hz: float) -> Measurement:
    """`count` sweeps over channels at `rate_hz`. Raises `DeviceError` where it cannot be as fast."""
    model, channels = known.model, channel_list(numbers)
    for_one_s = 1.0 / rate_hz / len(numbers) - SWITCHING_S
    fitting = [nplc for nplc in model.nplc if 2.0 * nplc / known.line_hz <= for_one_s * (1.0 + TOLERANCE)]
    if not fitting:
        most_hz = 1.0 / len(numbers) / (SWITCHING_S + 2.0 * model.nplc[0] / known.line_hz)
        raise DeviceError(
            DEVICE,
            Message.counted(
                "cannot take {count} channel {rate_hz:g} times a second",
                "cannot take {count} channels {rate_hz:g} times a second",
                count=len(numbers),
                rate_hz=rate_hz,
            ),
            Message("ask for {most_hz:.3g} times at most", most_hz=most_hz),
        )
    range_v = next((known_v for known_v in model.ranges_v if known_v >= range_v), model.ranges_v[-1])
    values = {"range_v": range_v, "nplc": fitting[-1], "interval_s": round(1.0 / rate_hz, 6), "count": float(count)}
    dialect = model.dialect
    return Measurement(
        function=f"{dialect.function} {channels}",
        functions=dialect.functions,
        configure=(*dialect.prepare, *(f"{command} {channels}" for command in dialect.configure)),
        settings=tuple(setting(text, values) for text in dialect.settings),
        channels=channels,
        by_channel=_BY_CHANNEL,
        count=count * len(numbers),
        duration_s=count / rate_hz,
    )


def thermometers(known: Acquaintance, numbers: Sequence[int], sensor: str) -> Measurement:
    """One sweep over thermometers."""
    dialect, channels = known.model.dialect, channel_list(numbers)
    command, *settings = dialect.temperature
    return Measurement(
        function=f"{dialect.function} {channels}",
        functions=("TEMP",),
        configure=(*dialect.prepare, f"{command.format(sensor=sensor)},{channels}"),
        settings=tuple(setting(text, {}) for text in settings),
        channels=channels,
        count=len(numbers),
        extra_s=TEMPERATURE_S,
    )
