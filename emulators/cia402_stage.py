"""The power state machine of an emulated CiA 402 drive."""

from typing import Final

from tumble.drivers.cia402.states import FAULT_RESET, State

_ENABLE_ANY: Final = {State.READY: State.ENABLED, State.SWITCHED_ON: State.ENABLED, State.QUICK_STOP: State.ENABLED}
_SWITCH_ON_ANY: Final = {State.READY: State.SWITCHED_ON, State.ENABLED: State.SWITCHED_ON}
_SHUTDOWN_ANY: Final = {
    State.SWITCH_ON_DISABLED: State.READY,
    State.SWITCHED_ON: State.READY,
    State.ENABLED: State.READY,
}
_QUICK_STOP_ANY: Final = {
    State.READY: State.SWITCH_ON_DISABLED,
    State.SWITCHED_ON: State.SWITCH_ON_DISABLED,
    State.ENABLED: State.QUICK_STOP,
}
_DISABLE_ANY: Final = {
    State.READY: State.SWITCH_ON_DISABLED,
    State.SWITCHED_ON: State.SWITCH_ON_DISABLED,
    State.ENABLED: State.SWITCH_ON_DISABLED,
    State.QUICK_STOP: State.SWITCH_ON_DISABLED,
}

_COMMANDS: Final = (
    (0x0F, 0x0F, _ENABLE_ANY),
    (0x0F, 0x07, _SWITCH_ON_ANY),
    (0x07, 0x06, _SHUTDOWN_ANY),
    (0x06, 0x02, _QUICK_STOP_ANY),
    (0x02, 0x00, _DISABLE_ANY),
)
"""Mask and value of the controlword, and where the command leads from each state (CiA 402-2, tables of commands)."""


class PowerStage:
    """Where the drive stands, and what the controlword makes of that."""

    def __init__(self) -> None:
        self.state = State.SWITCH_ON_DISABLED

    def command(self, word: int, rising: int) -> None:
        """Take a controlword and those of its bits that have just risen."""
        if self.state is State.FAULT:
            if rising & FAULT_RESET:
                self.state = State.SWITCH_ON_DISABLED
            return
        for mask, value, leads_to in _COMMANDS:
            if word & mask == value:
                self.state = leads_to.get(self.state, self.state)
                return

    def fail(self) -> None:
        """Go into fault; the reaction to it, which is to stand still, takes no time here."""
        self.state = State.FAULT
