"""A block of readings: how the multimeter is set for it, and how it is taken."""

import math
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from drivers.clock import Clock
from drivers.errors import DeviceError, LinkLostError, NoReplyError
from drivers.scpi.codec import CorruptReplyError, parse_number, parse_readings
from drivers.scpi.exchange import ATTEMPTS, Exchange
from drivers.scpi.models import Model

TEMPERATURE_S: Final = 5.0
"""A reading of temperature takes less than this, in real seconds."""
TOLERANCE: Final = 1e-4
"""Relative difference allowed between what was set and what is read back."""
RANGES_V: Final = (0.1, 1.0, 10.0, 100.0, 1000.0)

Setting = tuple[str, float | str]
"""Header and value."""


@dataclass(frozen=True, kw_only=True)
class Measurement:
    """What is measured, and how."""

    function: str
    """As `FUNC?` names it."""
    configure: str
    """The command that presets everything for it."""
    settings: tuple[Setting, ...] = ()
    """What is set after that, in this order."""
    count: int = 1
    duration_s: float = 0.0
    """By the stand's clock, in s."""
    extra_s: float = 0.0
    """How much longer than an ordinary answer the readings may take, in real seconds."""


def voltage(model: Model, line_hz: float, range_v: float | None, count: int, rate_hz: float) -> Measurement:
    """DC voltage, `count` times at `rate_hz`, in the smallest range that holds `range_v`; autorange where that is None.

    Raises `DeviceError` where even the shortest integration time of the model is too long for the rate.
    """
    fitting = [nplc for nplc in model.nplc if nplc / line_hz <= 1.0 / rate_hz * (1.0 + TOLERANCE)]
    if not fitting:
        most_hz = line_hz / model.nplc[0]
        raise DeviceError("multimeter", f"cannot take {rate_hz:g} samples a second", f"ask for {most_hz:g} at most")
    interval_s = 1.0 / rate_hz
    spare_s = max(interval_s - fitting[-1] / line_hz, 0.0)
    pace: tuple[Setting, ...] = (("TRIG:DEL", round(spare_s, 6)),)
    if model.timer:
        pace = (("TRIG:DEL", 0.0), ("SAMP:SOUR", "TIM"), ("SAMP:TIM", round(interval_s, 6)))
    return Measurement(
        function='"VOLT"',
        configure="CONF:VOLT:DC",
        settings=(
            _range(range_v),
            ("VOLT:DC:NPLC", fitting[-1]),
            ("VOLT:DC:ZERO:AUTO", 0.0),
            *pace,
            ("SAMP:COUN", float(count)),
        ),
        count=count,
        duration_s=count / rate_hz,
    )


def _range(range_v: float | None) -> Setting:
    if range_v is None:
        return "VOLT:DC:RANG:AUTO", 1.0
    return "VOLT:DC:RANG", next((known_v for known_v in RANGES_V if known_v >= range_v), RANGES_V[-1])


def temperature(sensor: str) -> Measurement:
    """One reading of temperature with a sensor as `CONF:TEMP` names it."""
    return Measurement(function='"TEMP"', configure=f"CONF:TEMP {sensor}", extra_s=TEMPERATURE_S)


def perform(exchange: Exchange, clock: Clock, measurement: Measurement, transfer_s: float) -> NDArray[np.float64]:
    """Take a block; one that goes wrong is taken anew, as a whole.

    Parameters
    ----------
    transfer_s
        How long the readings may be on their way, in real seconds.

    Raises
    ------
    DeviceError
        It went wrong `ATTEMPTS` times.
    NoReplyError, LinkLostError
        The meter or the way to it is gone.
    """
    happened = ""
    for _ in range(ATTEMPTS):
        try:
            _begin(exchange, measurement)
            clock.sleep(measurement.duration_s)
            return _fetch(exchange, measurement, transfer_s)
        except (NoReplyError, LinkLostError):
            raise
        except DeviceError as error:
            happened = error.happened
    raise DeviceError(
        "multimeter", f"failed to measure {ATTEMPTS} times: {happened}", "look at its display, then resume the run"
    )


def _begin(exchange: Exchange, measurement: Measurement) -> None:
    """Configure, begin, read everything back. Raises `DeviceError` where the meter is not set as it was told."""
    settings = measurement.settings
    assignments = (f"{header} {value if isinstance(value, str) else f'{value:.9g}'}" for header, value in settings)
    queries = ("FUNC?", *(f"{header}?" for header, _ in settings))
    function, *answers = exchange.ask(*queries, commands=("ABOR", "*CLS", measurement.configure, *assignments, "INIT"))
    complaints = [str(entry) for entry in exchange.errors()]
    if function != measurement.function:
        complaints.append(f"it measures {function}")
    for (header, value), answer in zip(settings, answers, strict=True):
        if not _same(value, answer):
            complaints.append(f"{header} is {answer} instead of {value}")
    if complaints:
        raise DeviceError("multimeter", ", ".join(complaints), "check the settings of the stand file")


def _fetch(exchange: Exchange, measurement: Measurement, transfer_s: float) -> NDArray[np.float64]:
    (field,) = exchange.ask("FETC?", extra_s=measurement.extra_s + transfer_s)
    try:
        readings = parse_readings(field)
    except CorruptReplyError as error:
        raise DeviceError("multimeter", f"gave readings that are none ({error})", "check its language") from error
    if len(readings) != measurement.count:
        happened = f"gave {len(readings)} of {measurement.count} readings"
        raise DeviceError("multimeter", happened, "check that nobody else talks to it")
    return readings


def _same(value: float | str, answer: str) -> bool:
    if isinstance(value, str):
        return answer == value
    try:
        return math.isclose(parse_number(answer), value, rel_tol=TOLERANCE, abs_tol=1e-6)
    except CorruptReplyError:
        return False
