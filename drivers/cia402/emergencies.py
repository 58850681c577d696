"""Error codes of drives in words: emergencies after CiA 301 and CiA 402-2, SDO aborts as `canopen` names them."""

from typing import Final

from canopen import SdoAbortedError

CODES: Final = {
    0x2310: "continuous overcurrent",
    0x2320: "short circuit or earth leakage",
    0x3110: "mains overvoltage",
    0x3120: "mains undervoltage",
    0x3210: "overvoltage in the DC link",
    0x3220: "undervoltage in the DC link",
    0x4210: "excess temperature of the device",
    0x4310: "excess temperature of the drive",
    0x5113: "supply of the logic too low",
    0x5530: "non-volatile memory failed",
    0x6010: "software reset by the watchdog",
    0x6320: "parameter error",
    0x7121: "motor blocked",
    0x7300: "sensor failed",
    0x7305: "incremental encoder failed",
    0x7500: "communication failed",
    0x8110: "CAN overrun, messages lost",
    0x8120: "CAN in error passive mode",
    0x8130: "heartbeat or life guard error",
    0x8140: "recovered from bus-off",
    0x8210: "PDO not processed because of its length",
    0x8400: "velocity speed controller failed",
    0x8611: "following error: the axis did not keep up with its set-point",
    0x8612: "reference limit reached",
}

GROUPS: Final = {
    0x1000: "generic error",
    0x2000: "current",
    0x3000: "voltage",
    0x4000: "temperature",
    0x5000: "device hardware",
    0x6000: "device software",
    0x7000: "additional modules",
    0x8000: "monitoring",
    0x9000: "external error",
    0xF000: "additional functions or specific to the device",
}


def emergency_words(code: int) -> str:
    """An emergency code in words, with its number: of the code itself, or of the group to which it belongs."""
    words = CODES.get(code) or GROUPS.get(code & 0xF000, "unknown error")
    return f"{words} (code {code:04X}h)"


def abort_words(code: int) -> str:
    """An SDO abort code in words, with its number."""
    words = SdoAbortedError.CODES.get(code, "unknown reason")
    return f"{words[:1].lower()}{words[1:]} (SDO abort {code:08X}h)"
