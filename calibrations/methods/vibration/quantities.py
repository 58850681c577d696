"""What the coefficients of vibration rectification are called where people read them."""

from typing import Final

from tumble.calibrations.core.view import Quantity
from tumble.messages import Message

QUANTITIES: Final = {
    "k_ii": Quantity(symbol="K_ii", words=Message("rectification along the input axis")),
    "k_oo": Quantity(symbol="K_oo", words=Message("rectification along the output axis")),
    "k_pp": Quantity(symbol="K_pp", words=Message("rectification along the pendulous axis")),
    "k_io": Quantity(symbol="K_io", words=Message("cross rectification of input and output axis")),
    "k_ip": Quantity(symbol="K_ip", words=Message("cross rectification of input and pendulous axis")),
}
"""By the name of the parameter."""
