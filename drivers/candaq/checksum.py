"""The checksum that a frame of a CAN DAQ may carry."""

from binascii import crc_hqx
from typing import Final, Literal

from cantools.database.can import Message as DbcMessage
from cantools.database.can import Signal

from tumble.messages import Message

_START: Final = 0xFFFF
_BITS: Final = 16


class Checksum:
    """CRC-16/CCITT-FALSE (polynomial 1021h, start FFFFh) of a frame's identifier and of its other bytes.

    The identifier counts as two bytes or, extended, four, low byte first. It sees up to three wrong bits; where it is
    the frame's end, high byte first, also every burst of 16 bits.

    Raises
    ------
    ValueError
        The signal is not 16 bits wide, or does not begin at a byte.
    """

    def __init__(self, message: DbcMessage, signal: Signal) -> None:
        first = 0 if signal.byte_order == "little_endian" else 7
        if signal.length != _BITS or signal.start % 8 != first:
            raise ValueError(
                Message(
                    "signal {signal} of message {message} is not two whole bytes",
                    signal=signal.name,
                    message=message.name,
                )
            )
        self._at = signal.start // 8
        self._order: Literal["little", "big"] = "little" if signal.byte_order == "little_endian" else "big"
        self._identifier = message.frame_id.to_bytes(4 if message.is_extended_frame else 2, "little")

    def put_into(self, data: bytes) -> bytes:
        """The frame's bytes with the checksum in its place."""
        return data[: self._at] + self._of(data).to_bytes(2, self._order) + data[self._at + 2 :]

    def fits(self, data: bytes) -> bool:
        """Whether the bytes of a frame are as they were sent."""
        return int.from_bytes(data[self._at : self._at + 2], self._order) == self._of(data)

    def _of(self, data: bytes) -> int:
        return crc_hqx(self._identifier + data[: self._at] + data[self._at + 2 :], _START)
