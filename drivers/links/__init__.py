"""The way to an instrument: lines of bytes over a serial port, or over whatever pyserial reaches by a URL.

- `SerialLink`: write a command, read a line; a lost port and a missing answer are different errors.
"""

from tumble.drivers.links.serial_link import SerialLink

__all__ = ["SerialLink"]
