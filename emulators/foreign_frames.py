"""Frames on a bus that nobody asked for and nobody can use, under the identifiers of a device."""

import can


def foreign_frames(can_id: int) -> list[can.Message]:
    """Cut, too long, garbled, extended, remote and error frames that begin like those of a device."""
    return [
        can.Message(arbitration_id=can_id, is_extended_id=False, data=b""),
        can.Message(arbitration_id=can_id, is_extended_id=False, data=b"\x01\x02\x03"),
        can.Message(arbitration_id=can_id, is_extended_id=False, data=b"\xff" * 8),
        can.Message(arbitration_id=can_id, is_extended_id=True, data=b"\x00" * 8),
        can.Message(arbitration_id=can_id, is_extended_id=False, is_fd=True, data=bytes(12)),
        can.Message(arbitration_id=can_id, is_extended_id=False, is_remote_frame=True),
        can.Message(arbitration_id=0x04, is_error_frame=True, is_extended_id=True),
    ]
