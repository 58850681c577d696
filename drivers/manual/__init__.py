"""A dividing head that a person turns and reads.

- `head.ManualHead`: fits `tumble.drivers.protocols.Positioner`; the person is behind the protocol `Eyepiece`.
- `reading`: angles as people write them.
"""

from tumble.drivers.manual.head import Eyepiece, ManualHead
from tumble.drivers.manual.reading import format_dms, on_the_circle, parse_reading

__all__ = ["Eyepiece", "ManualHead", "format_dms", "on_the_circle", "parse_reading"]
