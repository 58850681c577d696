"""The function generators that are known by name: Keysight 33500B Series and 33600A Series, and the older 33500A.

Sources: 33500B and 33600A Series Operating and Service Guide (33500-90901), "SCPI Programming Reference".
"""

import re
from dataclasses import dataclass
from typing import Final

from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Identity
from tumble.drivers.tables import EXCITER, TITLES
from tumble.messages import Message

_KNOWN: Final = re.compile(r"(33[56]\d{2})[AB]")
LEAST_V_PP: Final = 0.002
"""The smallest amplitude into an open circuit; into 50 ohm half of it."""
MOST_V_PP: Final = 20.0
"""The largest into an open circuit."""
LONGEST_WAVEFORM: Final = 65_536
"""Points of an arbitrary waveform (one million with option MEM, and in a 33600A)."""


@dataclass(frozen=True, kw_only=True)
class Model:
    """A generator."""

    name: str
    channels: int


def model_of(identity: Identity) -> Model:
    """The model by what it says of itself. Raises `DeviceError` where it is none of these."""
    found = _KNOWN.search(identity.model)
    if found is None:
        raise DeviceError(
            TITLES[EXCITER],
            Message("is a {model}, which is no known function generator", model=identity.model),
            Message("connect one of the 33500B or 33600A Series, or write a driver of your own"),
        )
    several = found[1] in {"33510", "33512", "33520", "33522", "33612", "33622"}
    return Model(name=found[0], channels=2 if several else 1)
