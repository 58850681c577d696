"""What the parameters of a gyrocompass are called where people read them."""

from typing import Final

from tumble.calibrations.core.view import Quantity
from tumble.messages import Message

QUANTITIES: Final = {
    "alpha0": Quantity(
        symbol="α_0", words=Message("azimuth of the platform at pickoff zero, counterclockwise from north")
    ),
    "drift": Quantity(symbol="ω", words=Message("drift of the levelling axis")),
}
"""By the name of the parameter."""
