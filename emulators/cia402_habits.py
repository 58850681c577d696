"""What real CiA 402 drives do that a tidy one would not; a drive takes a habit on, and keeps it."""

import time
from typing import Final

from canopen import SdoAbortedError

from tumble.drivers.cia402 import objects, states
from tumble.emulators.faults import Fault, Kind

HABITS: Final[tuple[Kind, ...]] = ("old_bits", "flicker", "without_options", "mode_shown_late")

_NO_OBJECT, _NO_SUBINDEX, _NOT_TO_BE_WRITTEN = 0x06020000, 0x06090011, 0x06010000
_MISSING: Final = {
    (objects.DEVICE_NAME, 0): _NO_OBJECT,
    (objects.SOFTWARE_VERSION, 0): _NO_OBJECT,
    (objects.ERROR_CODE, 0): _NO_OBJECT,
    (objects.IDENTITY, objects.SERIAL): _NO_SUBINDEX,
}
_BOTH: Final = states.TARGET_REACHED | states.HOMING_ATTAINED


class Habits:
    """The habits of one drive; none to begin with.

    `old_bits`: for `lasts_s` after the start of an errand, bits 10 and 12 of the statusword are those of before.
    `flicker`: at rest, bit 10 is set only in every other answer. `without_options`: objects that the profile makes
    optional are missing. `mode_shown_late`: the mode is shown only once the drive is enabled.
    """

    def __init__(self) -> None:
        self._has: dict[Kind, float] = {}
        self._old, self._old_until_s = 0, 0.0
        self._odd = False
        self._shown = 0

    def take_on(self, fault: Fault) -> None:
        """Have a habit from now on."""
        self._has[fault.kind] = fault.lasts_s

    def check_read(self, index: int, subindex: int) -> None:
        """Refuse to read what is missing. Raises `SdoAbortedError`."""
        if "without_options" in self._has and (index, subindex) in _MISSING:
            raise SdoAbortedError(_MISSING[index, subindex])

    def check_write(self, index: int) -> None:
        """Refuse to set what cannot be set. Raises `SdoAbortedError`."""
        if "without_options" in self._has and index == objects.QUICK_STOP_OPTION:
            raise SdoAbortedError(_NOT_TO_BE_WRITTEN)

    def begin(self, statusword: int) -> None:
        """An errand begins while the drive says this."""
        if "old_bits" in self._has:
            self._old, self._old_until_s = statusword & _BOTH, time.monotonic() + self._has["old_bits"]

    def said(self, statusword: int) -> int:
        """What the drive says where this would be right."""
        if time.monotonic() < self._old_until_s:
            return statusword & ~_BOTH | self._old
        self._odd = not self._odd and "flicker" in self._has
        return statusword & ~states.TARGET_REACHED if self._odd else statusword

    def shown(self, mode: int, enabled: bool) -> int:
        """The mode that the drive shows."""
        if enabled or "mode_shown_late" not in self._has:
            self._shown = mode
        return self._shown
