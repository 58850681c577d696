"""Words for lists and probabilities."""

import math
from collections.abc import Sequence
from typing import Literal

from tumble.calibrations.core.quantities import format_probability
from tumble.messages import Message


def equals(p_value: float) -> str:
    """`= 0.41` or `< 0.0001`, to follow a p."""
    text = format_probability(p_value)
    return text if text.startswith("<") else f"= {text}"


def series(names: Sequence[str], last: Literal["and", "or"] = "and") -> str:
    """`x, y and z`; empty where there is none."""
    if len(names) < 2:
        return names[0] if names else ""
    first = Message.joined(", ", names[:-1])
    if last == "or":
        return Message("{first} or {last}", first=first, last=names[-1])
    return Message("{first} and {last}", first=first, last=names[-1])


def deviations(separation: float) -> str:
    """How far explanations are apart that differ by so much in -2 ln L, as `4.8 standard deviations`."""
    return Message("{number:.1f} standard deviations", number=max(separation, 0.0) ** 0.5)


def significant_digits(value: float, expanded: float) -> int:
    """Digits of a value whose last unit is no less than the expanded uncertainty; 0 where that is over half of it."""
    if value == 0 or not expanded > 0:
        return 0
    ratio = expanded / abs(value)
    return 0 if ratio > _SIGN_ONLY else math.ceil(-math.log10(ratio))


_SIGN_ONLY = 0.5
"""An expanded uncertainty beyond this part of the value leaves nothing but its sign."""
