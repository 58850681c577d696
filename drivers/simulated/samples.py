"""What may be asked of a simulated meter."""

from tumble.drivers.errors import DeviceError
from tumble.messages import Message


def check_samples(meter: Message, samples: int, rate_hz: float) -> None:
    """Refuse what leaves nothing to take.

    Raises
    ------
    DeviceError
        Of `meter`: no sample, or no rate.
    """
    if samples < 1 or not rate_hz > 0.0:
        raise DeviceError(
            meter,
            Message("{samples} samples at {rate_hz:g} Hz cannot be taken", samples=samples, rate_hz=rate_hz),
            Message("ask for at least one sample at a positive rate"),
        )
