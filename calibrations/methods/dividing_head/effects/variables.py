"""What the variables on which effects depend are called."""

from collections.abc import Mapping
from typing import Final

from tumble.calibrations.tracing.effect import Variable
from tumble.messages import Message

VARIABLE_NAMES: Final[Mapping[Variable, Message]] = {
    "angle": Message("angle"),
    "acceleration": Message("acceleration"),
    "time": Message("time"),
    "temperature": Message("temperature"),
    "direction": Message("direction"),
    "realisation": Message("realisation"),
    "order": Message("order"),
}
"""By the word of the contract, which is the English name too."""
