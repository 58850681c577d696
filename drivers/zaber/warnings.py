"""Warning flags and rejections of Zaber devices in words (Zaber, ASCII Protocol Manual, firmware 7).

Flags that begin with F stop the axis, W ask for attention, N are notes. A reply carries only the most severe one; the
order here is that of severity.
"""

from types import MappingProxyType
from typing import Final

from tumble.messages import Message

UNREFERENCED: Final = frozenset({"WR", "WH"})
"""The axis does not know where it is: no reference position, or not homed since it was switched on."""

STOPPING: Final = MappingProxyType(
    {
        "FF": (Message("reports a critical system error"), Message("have it serviced")),
        "FN": (
            Message("does not know the stage plugged into it"),
            Message("plug in a stage that the controller supports"),
        ),
        "FZ": (Message("has no active stage"), Message("activate the stage at the controller")),
        "FH": (
            Message("was switched off by its emergency stop"),
            Message("release the emergency stop when the stand is safe"),
        ),
        "FV": (Message("has its drive disabled by a wrong supply voltage"), Message("check the power supply")),
        "FO": (Message("has its drive disabled"), Message("enable the drive")),
        "FC": (Message("draws too much current at switch-on"), Message("have it serviced")),
        "FM": (Message("has its drive disabled by a hot motor"), Message("let it cool and check the load")),
        "FD": (Message("has its drive disabled"), Message("check supply, temperature and current")),
        "FQ": (Message("reports an encoder error: its angle cannot be trusted"), Message("have the encoder serviced")),
        "FI": (Message("missed the index of its encoder"), Message("have the encoder serviced")),
        "FA": (Message("cannot synchronise its encoder"), Message("have the encoder serviced")),
        "FR": (Message("has its drive disabled by overload"), Message("check the load")),
        "FS": (Message("stalled and stopped"), Message("remove what blocks it")),
        "FB": (Message("left the bounds of a streamed motion"), Message("let no other program move it")),
        "FP": (Message("left the path of a streamed motion"), Message("let no other program move it")),
        "FE": (Message("ran into a limit"), Message("check limits and home sensor")),
        "FT": (Message("twisted its cable too far"), Message("unwind the cable by hand")),
        "WL": (
            Message("met a limit sensor where none should be"),
            Message("look for what blocks it and check the home sensor"),
        ),
        "WS": (Message("stalled and recovered by itself"), Message("look for what blocks it")),
        "WM": (Message("was displaced while it stood still"), Message("look for what pushed it")),
        "NC": (Message("is being turned by its knob"), Message("leave the knob alone while a run is on")),
    }
)
"""What happened and what to do, for every flag that spoils a move."""

_REJECTIONS: Final = MappingProxyType(
    {
        "AGAIN": (Message("is not ready for the command"), Message("try again")),
        "BADAXIS": (Message("has no such axis"), Message("check the axis number in the stand file")),
        "BADCOMMAND": (Message("does not know the command"), Message("check model and firmware")),
        "BADDATA": (
            Message("finds the value out of range"),
            Message("check steps_per_deg and the limits set in the device"),
        ),
        "BADMESSAGEID": (Message("does not understand the message id"), Message("check the firmware")),
        "DEVICEONLY": (
            Message("takes the command for the whole device only"),
            Message("check the axis number in the stand file"),
        ),
        "DRIVERDISABLED": (
            Message("has its drive disabled"),
            Message("look for the cause at the device and enable the drive"),
        ),
        "FULL": (Message("has no room for the command"), Message("try again")),
        "INACTIVE": (Message("has no active stage"), Message("activate the stage at the controller")),
        "LOCKSTEP": (Message("has the axis tied to another"), Message("untie it at the controller")),
        "NOACCESS": (Message("does not allow the command"), Message("check the access level of the device")),
        "PARKED": (Message("is parked"), Message("unpark it")),
        "STATUSBUSY": (Message("is moving"), Message("stop it first")),
    }
)


def rejection(reason: str) -> tuple[str, str]:
    """What a rejection means and what to do."""
    return _REJECTIONS.get(
        reason,
        (
            Message("rejects the command ({reason})", reason=reason),
            Message("look the reason up in the device's manual"),
        ),
    )
