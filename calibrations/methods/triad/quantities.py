"""What the parameters of a triad are called where people read them."""

from collections.abc import Iterator
from typing import Final

from tumble.calibrations.core.view import Quantity
from tumble.messages import Message

_AXES: Final = "xyz"


def _quantities() -> Iterator[tuple[str, Quantity]]:
    for axis in _AXES:
        yield f"bias_{axis}", Quantity(symbol=f"b_{axis}", words=Message("bias of channel {channel}", channel=axis))
    for axis in _AXES:
        words = Message("scale factor of channel {channel}", channel=axis)
        yield f"scale_{axis}", Quantity(symbol=f"k_{axis}", words=words)
    for axis in _AXES:
        for other in _AXES.replace(axis, ""):
            words = Message("misalignment of channel {channel} towards {axis}", channel=axis, axis=other)
            yield f"m_{axis}{other}", Quantity(symbol=f"m_{axis}{other}", words=words)
        words = Message("magnitude of the scale factor of channel {channel}", channel=axis)
        yield f"norm_{axis}", Quantity(symbol=f"|k|_{axis}", words=words)
    for pair in ("xy", "xz", "yz"):
        words = Message("non-orthogonality of channels {channel} and {other}", channel=pair[0], other=pair[1])
        yield f"orthogonality_{pair}", Quantity(symbol=f"γ_{pair}", words=words)
    yield "level_x", Quantity(symbol="λ_x", words=Message("level of the stand about its outer axis"))
    yield "level_y", Quantity(symbol="λ_y", words=Message("level of the stand along its outer axis"))


QUANTITIES: Final = dict(_quantities())
"""By the name of the parameter."""
