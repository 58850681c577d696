"""SDO abort codes in words (CiA 301, 7.2.4.3.17, as the library canopen says them)."""

from types import MappingProxyType
from typing import Final

from tumble.messages import Message

ABORTS: Final = MappingProxyType(
    {
        0x05030000: Message("SDO toggle bit error"),
        0x05040000: Message("timeout of transfer communication detected"),
        0x05040001: Message("unknown SDO command specified"),
        0x05040002: Message("invalid block size"),
        0x05040003: Message("invalid sequence number"),
        0x05040004: Message("CRC error"),
        0x05040005: Message("out of memory"),
        0x06010000: Message("unsupported access to an object"),
        0x06010001: Message("attempt to read a write only object"),
        0x06010002: Message("attempt to write a read only object"),
        0x06020000: Message("object does not exist"),
        0x06040041: Message("object cannot be mapped to the PDO"),
        0x06040042: Message("PDO length exceeded"),
        0x06040043: Message("general parameter incompatibility reason"),
        0x06040047: Message("general internal incompatibility in the device"),
        0x06060000: Message("access failed due to a hardware error"),
        0x06070010: Message("data type and length code do not match"),
        0x06070012: Message("data type does not match, length of service parameter too high"),
        0x06070013: Message("data type does not match, length of service parameter too low"),
        0x06090011: Message("subindex does not exist"),
        0x06090030: Message("value range of parameter exceeded"),
        0x06090031: Message("value of parameter written too high"),
        0x06090032: Message("value of parameter written too low"),
        0x06090036: Message("maximum value is less than minimum value"),
        0x060A0023: Message("resource not available"),
        0x08000000: Message("general error"),
        0x08000020: Message("data cannot be transferred or stored to the application"),
        0x08000021: Message("data can not be transferred or stored to the application because of local control"),
        0x08000022: Message(
            "data can not be transferred or stored to the application because of the present device state"
        ),
        0x08000023: Message("object dictionary dynamic generation fails or no object dictionary is present"),
        0x08000024: Message("no data available"),
    }
)
