"""What the parameters of an accelerometer are called where people read them; see the glossary."""

from collections.abc import Mapping
from typing import Final

from tumble.calibrations.core.view import Quantity
from tumble.messages import Message

QUANTITIES: Final[Mapping[str, Quantity]] = {
    "u0": Quantity(symbol="u_0", words=Message("bias")),
    "kx": Quantity(symbol="k_x", words=Message("scale factor")),
    "ky": Quantity(symbol="k_y", words=Message("cross-axis sensitivity along y")),
    "kz": Quantity(symbol="k_z", words=Message("cross-axis sensitivity along z")),
    "kxy": Quantity(symbol="k_xy", words=Message("cross-coupling of x and y")),
    "alpha0": Quantity(symbol="α_0", words=Message("mounting error")),
}
