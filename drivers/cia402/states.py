"""The words of a CiA 402 drive: statusword, controlword and the power state machine (CiA 402-2, 5 to 7)."""

from enum import Enum, IntEnum
from typing import Final


class State(Enum):
    """State of the power drive system."""

    NOT_READY = "not ready to switch on"
    SWITCH_ON_DISABLED = "switch on disabled"
    READY = "ready to switch on"
    SWITCHED_ON = "switched on"
    ENABLED = "operation enabled"
    QUICK_STOP = "quick stop active"
    FAULT_REACTION = "fault reaction active"
    FAULT = "fault"


class Mode(IntEnum):
    """Mode of operation (objects 6060h and 6061h)."""

    PROFILE_POSITION = 1
    HOMING = 6


TARGET_REACHED: Final = 1 << 10
"""Bit of the statusword: at the target, homed, or standing after a stop."""
ACKNOWLEDGED: Final = 1 << 12
"""Bit of the statusword in profile position: the new set-point was taken."""
HOMING_ATTAINED: Final = 1 << 12
"""The same bit in homing mode."""
MOTION_ERROR: Final = 1 << 13
"""Following error in profile position, homing error in homing mode."""

DISABLE_VOLTAGE: Final = 0x0000
QUICK_STOP: Final = 0x0002
SHUTDOWN: Final = 0x0006
SWITCH_ON: Final = 0x0007
ENABLE: Final = 0x000F
START: Final = 1 << 4
"""Bit of the controlword: new set-point, or start of homing, at its rising edge."""
AT_ONCE: Final = 1 << 5
"""Bit of the controlword: a new set-point takes the place of the one under way."""
FAULT_RESET: Final = 1 << 7
HALT: Final = 1 << 8

STATUS: Final = {
    State.NOT_READY: (0x4F, 0x00),
    State.SWITCH_ON_DISABLED: (0x4F, 0x40),
    State.READY: (0x6F, 0x21),
    State.SWITCHED_ON: (0x6F, 0x23),
    State.ENABLED: (0x6F, 0x27),
    State.QUICK_STOP: (0x6F, 0x07),
    State.FAULT_REACTION: (0x4F, 0x0F),
    State.FAULT: (0x4F, 0x08),
}
"""Mask and value of the statusword in each state."""

TOWARDS_ENABLED: Final = {
    State.SWITCH_ON_DISABLED: SHUTDOWN,
    State.READY: SWITCH_ON,
    State.SWITCHED_ON: ENABLE,
    State.QUICK_STOP: ENABLE,
}
"""Controlword that takes a drive one state nearer to `ENABLED`; from the other states only time or a reset does."""


def state_of(statusword: int) -> State | None:
    """State that a statusword tells; None where it is none of them."""
    for state, (mask, value) in STATUS.items():
        if statusword & mask == value:
            return state
    return None


def is_powered(statusword: int) -> bool:
    """Whether the drive can move its axis."""
    return state_of(statusword) in (State.ENABLED, State.QUICK_STOP, State.FAULT_REACTION)


def is_moving(statusword: int) -> bool:
    """Whether the drive says that it is on its way: under power and neither at its target nor at rest after a stop."""
    return is_powered(statusword) and not statusword & TARGET_REACHED


def is_homed(statusword: int) -> bool:
    """Whether homing is done; only in homing mode does the statusword say so."""
    both = HOMING_ATTAINED | TARGET_REACHED
    return statusword & both == both
