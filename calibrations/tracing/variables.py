"""The variables on which effects depend, and the blocks of a table that each of them makes, in words."""

from collections.abc import Mapping
from typing import Final

from tumble.calibrations.tracing.effect import Variable
from tumble.messages import Message

VARIABLE_WORDS: Final[Mapping[str, Message]] = {
    "angle": Message("angle"),
    "acceleration": Message("acceleration"),
    "amplitude": Message("amplitude"),
    "frequency": Message("frequency"),
    "time": Message("time"),
    "temperature": Message("temperature"),
    "direction": Message("direction"),
    "realisation": Message("realisation"),
    "order": Message("order"),
}
"""What a reader calls a variable on which something depends."""


def counted_blocks(variable: Variable, count: int) -> Message:
    """So many blocks of a variable, by what these are called: `7 settings`."""
    match variable:
        case "angle" | "acceleration" | "amplitude" | "frequency" | "direction":
            return Message.counted("{count} setting", "{count} settings", count=count)
        case "time":
            return Message.counted("{count} stretch of time", "{count} stretches of time", count=count)
        case "order":
            return Message.counted("{count} dwell", "{count} dwells", count=count)
        case "temperature":
            return Message.counted("{count} visit of a temperature", "{count} visits of a temperature", count=count)
        case "realisation":
            return Message.counted("{count} realisation", "{count} realisations", count=count)
