"""Rotary stages that speak the Zaber ASCII protocol, used as a dividing head.

- `codec`: requests and messages as bytes, with checksums; no input or output.
- `warnings`: what the warning flags and rejections mean.
- `conversation`: one request at a time, answered by the message that belongs to it.
- `head`: `ZaberHead`, fits `tumble.drivers.protocols.Positioner`.
"""

from tumble.drivers.zaber.head import ZaberHead

__all__ = ["ZaberHead"]
