"""A rotary stage on a C-863 Mercury controller of Physik Instrumente, over a serial line, as a dividing head.

Commands and answers are those of its manual MS249E, chapter 8 (PI General Command Set 2.0): lines that end in LF, one
answer a question, none to a command, after which `ERR?` says whether it was obeyed.
"""

import math
import re
from typing import Final, Protocol

from tumble.drivers.clock import Clock
from tumble.drivers.driver import Bench, Driver
from tumble.drivers.errors import DeviceError, LimitError, LinkLostError, NoReplyError
from tumble.drivers.limits import check_limits
from tumble.drivers.protocols import Identity, PositionerStatus
from tumble.drivers.tables import HeadTable, OnSerialLine

DEVICE: Final = "Mercury head"
TIMEOUT_S: Final = 1.0

REFERENCING, MOVING, SERVO, FAILED = 1 << 14, 1 << 13, 1 << 12, 1 << 8
"""Bits of the status register (MS249E, `#4`)."""
STOPPED, OUTSIDE = 10, 7
"""Error codes: stopped by command, which is no error; position out of limits."""
ERRORS: Final = {
    5: ("refuses to move without reference or servo", "resume the run, which homes it first"),
    OUTSIDE: ("finds the angle outside its own limits", "correct limits_deg, or the limits set in the controller"),
    -1024: ("does not follow its set-point", "look for what blocks it, then resume the run, which homes it first"),
    1024: ("does not follow its set-point", "look for what blocks it, then resume the run, which homes it first"),
}


class MercuryTable(OnSerialLine, HeadTable):
    """Keys of the table `[head]`; the others are those of every head on a serial line."""

    axis: str = "1"
    steps_per_deg: float = 1.0
    """The controller counts in degrees already; -1 where it turns the other way."""


class Link(Protocol):
    """What is needed of a `SerialLink`; a test gives a fake one."""

    def write(self, data: bytes) -> None: ...  # noqa: D102
    def read_line(self, terminator: bytes, timeout_s: float) -> bytes: ...  # noqa: D102
    def discard_input(self) -> None: ...  # noqa: D102
    def reopen(self) -> None: ...  # noqa: D102


class MercuryHead:
    """Fits `Positioner` and `Reconnectable`.

    An answer does not say to which question it belongs. Therefore one that is missing or garbled counts as a lost link:
    the port is opened anew, the controller identified, the head homed, and the step repeated.
    """

    def __init__(self, link: Link, table: MercuryTable, clock: Clock) -> None:
        self.limits_deg = table.limits_deg
        self.speed_deg_s = table.speed_deg_s
        self._link, self._clock = link, clock
        self._axis, self._units_per_deg = table.axis, table.steps_per_deg

    def identify(self) -> Identity:
        """Ask the controller who it is, and set the speed, which it forgets without power."""
        _maker, model, serial, firmware = self._ask("*IDN?", r"([^,]+),([^,]+),([^,]+),([^,]+)")
        self._tell(f"VEL {self._axis} {self.speed_deg_s * abs(self._units_per_deg):.6f}")
        return Identity(model=model.strip(), serial=serial.strip(), firmware=firmware.strip())

    def reconnect(self) -> None:
        """Open the port anew."""
        self._link.reopen()

    def home(self) -> None:
        """Switch the servo on and begin to look for the reference switch."""
        self._tell(f"SVO {self._axis} 1")
        self._tell(f"FRF {self._axis}")

    def start_move(self, angle_deg: float) -> None:
        """Begin to move; the limits of the stand file hold before anything is sent."""
        check_limits(DEVICE, angle_deg, self.limits_deg)
        self._tell(f"MOV {self._axis} {angle_deg * self._units_per_deg:.6f}")

    def status(self) -> PositionerStatus:
        """Read everything back. Raises `DeviceError`, once, where the controller tells of an error."""
        (register,) = self._ask("\x04", r"0x([0-9A-Fa-f]{1,8})")
        bits = int(register, 16)
        if bits & FAILED:
            self._raise_error()
        searching = bool(bits & REFERENCING)  # then it knows no position, and is asked for none
        return PositionerStatus(
            angle_deg=math.nan if searching else float(self._value("POS?")) / self._units_per_deg,
            moving=searching or bool(bits & MOVING),
            device_time_s=self._clock.monotonic_s(),
            referenced=not searching and bool(bits & SERVO) and self._value("FRF?") == "1",
        )

    def stop(self) -> None:
        """Brake; the engine reads the standstill back."""
        self._tell(f"HLT {self._axis}")

    def _tell(self, command: str) -> None:
        self._link.write(f"{command}\n".encode("ascii"))
        self._raise_error()

    def _raise_error(self) -> None:
        (digits,) = self._ask("ERR?", r"(-?\d{1,5})")
        if (code := int(digits)) in (0, STOPPED):
            return
        happened, remedy = ERRORS.get(code, ("reports an error", "look the code up in its manual"))
        raise (LimitError if code == OUTSIDE else DeviceError)(DEVICE, f"{happened} (error {code})", remedy)

    def _value(self, question: str) -> str:
        (value,) = self._ask(f"{question} {self._axis}", rf"{self._axis}=([-+]?\d+\.?\d*(?:[Ee][-+]?\d+)?)")
        return value

    def _ask(self, question: str, form: str) -> tuple[str, ...]:
        self._link.discard_input()
        self._link.write(question.encode("ascii") + (b"\n" if len(question) > 1 else b""))
        try:
            line = self._link.read_line(b"\n", TIMEOUT_S).decode("ascii", "replace").rstrip()
        except NoReplyError as error:
            raise LinkLostError(error.device, error.happened, error.remedy) from error
        if (answer := re.fullmatch(form, line)) is None:
            raise LinkLostError(DEVICE, f"answers {line!r} to {question!r}", "check cable, baud rate and axis")
        return answer.groups()


def connect(table: MercuryTable, bench: Bench) -> MercuryHead:
    """Open the port; nothing is sent yet."""
    return MercuryHead(bench.links.serial(table, DEVICE), table, bench.clock)


MERCURY = Driver(table=MercuryTable, connect=connect)
