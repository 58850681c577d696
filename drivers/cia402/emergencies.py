"""Error codes of drives in words: emergencies after CiA 301 and CiA 402-2, SDO aborts as `canopen` names them."""

from typing import Final

from tumble.drivers.cia402.aborts import ABORTS
from tumble.messages import Message

CODES: Final = {
    0x2310: Message("continuous overcurrent"),
    0x2320: Message("short circuit or earth leakage"),
    0x3110: Message("mains overvoltage"),
    0x3120: Message("mains undervoltage"),
    0x3210: Message("overvoltage in the DC link"),
    0x3220: Message("undervoltage in the DC link"),
    0x4210: Message("excess temperature of the device"),
    0x4310: Message("excess temperature of the drive"),
    0x5113: Message("supply of the logic too low"),
    0x5530: Message("non-volatile memory failed"),
    0x6010: Message("software reset by the watchdog"),
    0x6320: Message("parameter error"),
    0x7121: Message("motor blocked"),
    0x7300: Message("sensor failed"),
    0x7305: Message("incremental encoder failed"),
    0x7500: Message("communication failed"),
    0x8110: Message("CAN overrun, messages lost"),
    0x8120: Message("CAN in error passive mode"),
    0x8130: Message("heartbeat or life guard error"),
    0x8140: Message("recovered from bus-off"),
    0x8210: Message("PDO not processed because of its length"),
    0x8400: Message("velocity speed controller failed"),
    0x8611: Message("following error: the axis did not keep up with its set-point"),
    0x8612: Message("reference limit reached"),
}

GROUPS: Final = {
    0x1000: Message("generic error"),
    0x2000: Message("current"),
    0x3000: Message("voltage"),
    0x4000: Message("temperature"),
    0x5000: Message("device hardware"),
    0x6000: Message("device software"),
    0x7000: Message("additional modules"),
    0x8000: Message("monitoring"),
    0x9000: Message("external error"),
    0xF000: Message("additional functions or specific to the device"),
}


def emergency_words(code: int) -> str:
    """An emergency code in words, with its number: of the code itself, or of the group to which it belongs."""
    words = CODES.get(code) or GROUPS.get(code & 0xF000, Message("unknown error"))
    return Message("{reason} (code {code:04X}h)", reason=words, code=code)


def abort_words(code: int) -> str:
    """An SDO abort code in words, with its number."""
    reason = ABORTS.get(code) or Message("unknown reason")
    return Message("{reason} (SDO abort {code:08X}h)", reason=reason, code=code)
