"""What an emulated CiA 402 drive does with its objects; the bus it is on is no concern of this."""

import threading
from collections import deque
from typing import Final

from canopen import SdoAbortedError

from tumble.drivers.cia402 import objects, states
from tumble.drivers.cia402.states import Mode, State
from tumble.emulators.cia402_axis import Axis
from tumble.emulators.cia402_habits import Habits
from tumble.emulators.cia402_stage import PowerStage

FOLLOWING_ERROR: Final = 0x8611
OVERHEATED: Final = 0x4310
ERROR_REGISTER: Final = 1 << 5 | 1
"""Error register in a fault: specific to the profile, and generic."""

VENDOR, PRODUCT, REVISION, SERIAL = 1, 0x402, 0x10000, 402001
NAME: Final = "tumble CiA 402 drive"
SOFTWARE: Final = "1.0"

_REMOTE: Final = 1 << 9
_VOLTAGE: Final = 1 << 4
_BRAKES_AND_LETS_GO: Final = 2
_STAYS_STOPPED: Final = 5
"""Quick stop option codes from here on keep the state after the stop."""
_OUT_OF_RANGE: Final = 0x06090030
_NOT_NOW: Final = 0x08000022


class Drive:
    """The objects of a drive and its two state machines; may be asked from several threads.

    A set-point is taken at once, also where the master would have it wait for the end of the move under way.
    """

    def __init__(self, axis: Axis) -> None:
        self.axis = axis
        self.emergencies: deque[int] = deque()
        """Emergency codes to be told, oldest first; 0 takes the last one back."""
        self.serial = SERIAL
        self.habits = Habits()
        self._lock = threading.RLock()
        self.restart()

    def restart(self) -> None:
        """Begin as after switching on."""
        with self._lock:
            self._stage = PowerStage()
            self._word = self._mode = self._target = self._error_code = 0
            self._taken = False
            self._quick_stop_option = _BRAKES_AND_LETS_GO

    def update(self) -> None:
        """Let time do its part: arrive, get stuck, come to rest after a quick stop."""
        with self._lock:
            if self.axis.update() and self._stage.state is State.ENABLED:
                self.fail(FOLLOWING_ERROR)
            if self._stage.state is State.QUICK_STOP and self._quick_stop_option < _STAYS_STOPPED:
                self._stage.state = State.SWITCH_ON_DISABLED

    def fail(self, code: int) -> None:
        """Stand still, go into fault and tell of it."""
        with self._lock:
            self.axis.stop()
            self._stage.fail()
            self._error_code = code
            self.emergencies.append(code)

    def value(self, index: int, subindex: int) -> int | str | None:
        """Value of an object; None for one that is merely stored."""
        with self._lock:
            self.habits.check_read(index, subindex)
            if index == objects.POSITION_LIMITS and subindex:
                return self.axis.limits_counts[subindex - 1]
            if index == objects.IDENTITY and subindex:
                return (VENDOR, PRODUCT, REVISION, self.serial)[subindex - 1]
            values: dict[int, int | str] = {
                objects.DEVICE_NAME: NAME,
                objects.SOFTWARE_VERSION: SOFTWARE,
                objects.ERROR_REGISTER: ERROR_REGISTER if self._error_code else 0,
                objects.ERROR_CODE: self._error_code,
                objects.STATUSWORD: self.habits.said(self._statusword()) if index == objects.STATUSWORD else 0,
                objects.MODE_DISPLAY: self.habits.shown(self._mode, self._stage.state is State.ENABLED),
                objects.POSITION: self.axis.counts,
                objects.VELOCITY: self.axis.counts_per_s,
            }
            return values.get(index)

    def set_value(self, index: int, value: int) -> None:
        """Heed what was written into an object. Raises `SdoAbortedError` for what it refuses."""
        with self._lock:
            self.habits.check_write(index)
            if index == objects.CONTROLWORD:
                self._control(value)
            elif index == objects.TARGET_POSITION:
                self._aim(value)
            elif index == objects.MODE:
                self._choose(value)
            elif index == objects.QUICK_STOP_OPTION:
                self._quick_stop_option = value

    def _statusword(self) -> int:
        word = states.STATUS[self._stage.state][1] | _REMOTE | _VOLTAGE
        if self.axis.arrived:
            word |= states.TARGET_REACHED
        if self._mode == Mode.HOMING and self.axis.homed:
            word |= states.HOMING_ATTAINED
        if self._mode == Mode.PROFILE_POSITION and self._taken:
            word |= states.ACKNOWLEDGED
        if self._error_code == FOLLOWING_ERROR:
            word |= states.MOTION_ERROR
        return word

    def _choose(self, mode: int) -> None:
        if mode not in (0, *Mode):
            raise SdoAbortedError(_OUT_OF_RANGE)
        if mode != self._mode and not self.axis.arrived:
            raise SdoAbortedError(_NOT_NOW)
        self._mode = mode

    def _aim(self, counts: int) -> None:
        low, high = self.axis.limits_counts
        if not low <= counts <= high:
            raise SdoAbortedError(_OUT_OF_RANGE)
        self._target = counts

    def _control(self, word: int) -> None:
        before = self._statusword()
        rising, self._word = word & ~self._word, word
        was_faulty = self._stage.state is State.FAULT
        self._stage.command(word, rising)
        if was_faulty and self._stage.state is not State.FAULT:
            self._recover()
        if self._stage.state is not State.ENABLED:
            self.axis.stop()
            self._taken = False
            return
        self._taken = bool(word & states.START) and (self._taken or bool(rising & states.START))
        if word & states.HALT:
            self.axis.stop()
        elif rising & states.START:
            self.habits.begin(before)
            self._start()

    def _start(self) -> None:
        if self._mode == Mode.HOMING:
            self.axis.home()
        elif self._mode == Mode.PROFILE_POSITION:
            self.axis.move_to(self._target)

    def _recover(self) -> None:
        self._error_code = 0
        self.axis.blocked = False
        self.emergencies.append(0)
