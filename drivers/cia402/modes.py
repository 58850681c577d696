"""The mode of operation of a drive: chosen, shown, and what it says of its reference in homing mode."""

import time
from typing import Final

from tumble.drivers.cia402 import objects, states
from tumble.drivers.cia402.node import DriveNode
from tumble.drivers.cia402.states import Mode, State

POLL_S: Final = 0.005
"""Between two questions to a drive, in real time."""
GOING_S: Final = 0.5
"""How long a bit of what was before is given to go."""
UNPOWERED_S: Final = 0.2
"""How long a drive without power is given to show its mode; some show it only once enabled."""


def choose(node: DriveNode, mode: Mode) -> None:
    """Have the drive enter a mode. Raises `DeviceError`."""
    if state(node) is State.ENABLED:
        node.write(objects.CONTROLWORD, states.ENABLE)  # a start bit of before would begin something in the new mode
        if mode is Mode.HOMING:
            _await_no_acknowledgement(node)
    node.write(objects.MODE, mode)


def shows(node: DriveNode, mode: Mode, within_s: float) -> bool:
    """Whether the drive says in time that it is in the mode. Raises `DeviceError`."""
    deadline_s = time.monotonic() + within_s
    while node.read(objects.MODE_DISPLAY) != mode:
        if time.monotonic() > deadline_s:
            return False
        node.check()
        time.sleep(POLL_S)
    return True


def says_homed(node: DriveNode, within_s: float) -> bool:
    """Whether the drive says in homing mode that it is homed.

    One in fault is not asked, and one that shows no mode without power is taken to be not homed. Raises `DeviceError`.
    """
    was = state(node)
    if was is State.FAULT:
        return False
    choose(node, Mode.HOMING)
    if not shows(node, Mode.HOMING, within_s if was is State.ENABLED else UNPOWERED_S):
        return False
    return states.is_homed(node.read(objects.STATUSWORD))


def state(node: DriveNode) -> State | None:
    """State of the power drive system. Raises `DeviceError`."""
    return states.state_of(node.read(objects.STATUSWORD))


def _await_no_acknowledgement(node: DriveNode) -> None:
    """Let the acknowledgement of a set-point go, whose bit says "homed" in homing mode."""
    deadline_s = time.monotonic() + GOING_S
    while node.read(objects.MODE_DISPLAY) == Mode.PROFILE_POSITION and time.monotonic() < deadline_s:
        if not node.read(objects.STATUSWORD) & states.ACKNOWLEDGED:
            return
        time.sleep(POLL_S)
