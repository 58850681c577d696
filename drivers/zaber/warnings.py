"""Warning flags and rejections of Zaber devices in words (Zaber, ASCII Protocol Manual, firmware 7).

Flags that begin with F stop the axis, W ask for attention, N are notes. A reply carries only the most severe one; the
order here is that of severity.
"""

from types import MappingProxyType
from typing import Final

UNREFERENCED: Final = frozenset({"WR", "WH"})
"""The axis does not know where it is: no reference position, or not homed since it was switched on."""

STOPPING: Final = MappingProxyType(
    {
        "FF": ("reports a critical system error", "have it serviced"),
        "FN": ("does not know the stage plugged into it", "plug in a stage that the controller supports"),
        "FZ": ("has no active stage", "activate the stage at the controller"),
        "FH": ("was switched off by its emergency stop", "release the emergency stop when the stand is safe"),
        "FV": ("has its drive disabled by a wrong supply voltage", "check the power supply"),
        "FO": ("has its drive disabled", "enable the drive"),
        "FC": ("draws too much current at switch-on", "have it serviced"),
        "FM": ("has its drive disabled by a hot motor", "let it cool and check the load"),
        "FD": ("has its drive disabled", "check supply, temperature and current"),
        "FQ": ("reports an encoder error: its angle cannot be trusted", "have the encoder serviced"),
        "FI": ("missed the index of its encoder", "have the encoder serviced"),
        "FA": ("cannot synchronise its encoder", "have the encoder serviced"),
        "FR": ("has its drive disabled by overload", "check the load"),
        "FS": ("stalled and stopped", "remove what blocks it"),
        "FB": ("left the bounds of a streamed motion", "let no other program move it"),
        "FP": ("left the path of a streamed motion", "let no other program move it"),
        "FE": ("ran into a limit", "check limits and home sensor"),
        "FT": ("twisted its cable too far", "unwind the cable by hand"),
        "WL": ("met a limit sensor where none should be", "look for what blocks it and check the home sensor"),
        "WS": ("stalled and recovered by itself", "look for what blocks it"),
        "WM": ("was displaced while it stood still", "look for what pushed it"),
        "NC": ("is being turned by its knob", "leave the knob alone while a run is on"),
    }
)
"""What happened and what to do, for every flag that spoils a move."""

_REJECTIONS: Final = MappingProxyType(
    {
        "AGAIN": ("is not ready for the command", "try again"),
        "BADAXIS": ("has no such axis", "check the axis number in the stand file"),
        "BADCOMMAND": ("does not know the command", "check model and firmware"),
        "BADDATA": ("finds the value out of range", "check steps_per_deg and the limits set in the device"),
        "BADMESSAGEID": ("does not understand the message id", "check the firmware"),
        "DEVICEONLY": ("takes the command for the whole device only", "check the axis number in the stand file"),
        "DRIVERDISABLED": ("has its drive disabled", "look for the cause at the device and enable the drive"),
        "FULL": ("has no room for the command", "try again"),
        "INACTIVE": ("has no active stage", "activate the stage at the controller"),
        "LOCKSTEP": ("has the axis tied to another", "untie it at the controller"),
        "NOACCESS": ("does not allow the command", "check the access level of the device"),
        "PARKED": ("is parked", "unpark it"),
        "STATUSBUSY": ("is moving", "stop it first"),
    }
)


def rejection(reason: str) -> tuple[str, str]:
    """What a rejection means and what to do."""
    return _REJECTIONS.get(reason, (f"rejects the command ({reason})", "look the reason up in the device's manual"))
