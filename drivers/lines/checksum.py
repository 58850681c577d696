"""Checksums at the end of a line of text, in hexadecimal digits."""

from binascii import crc_hqx
from collections.abc import Callable, Mapping
from functools import reduce
from operator import xor
from typing import Final, Literal, TypeAlias

ChecksumName: TypeAlias = Literal["none", "xor", "sum", "crc16"]

CHECKSUMS: Final[Mapping[str, Callable[[bytes], str]]] = {
    "xor": lambda text: f"{reduce(xor, text, 0):02X}",
    "sum": lambda text: f"{sum(text) % 256:02X}",
    "crc16": lambda text: f"{crc_hqx(text, 0xFFFF):04X}",
}
"""`xor` of all bytes is that of NMEA 0183; `sum` is modulo 256; `crc16` is CRC-16/CCITT-FALSE."""
