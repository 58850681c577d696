"""A dividing head without a motor: a person sets it, reads its eyepiece and says what is read."""

from typing import Protocol

from tumble.drivers.clock import Clock
from tumble.drivers.limits import check_limits
from tumble.drivers.protocols import Identity, PositionerStatus
from tumble.messages import Message


class Eyepiece(Protocol):
    """The person at the head."""

    def show(self, setting_deg: float) -> None:
        """Ask for a setting and its reading; returns at once."""
        ...

    def reading_deg(self) -> float | None:
        """What was read, in degrees of the setting's revolution; None as long as nothing was said. Never waits."""
        ...

    def withdraw(self) -> None:
        """Take the request back."""
        ...


class ManualHead:
    """Fits `tumble.drivers.protocols.Positioner`. Its moves take as long as a person takes.

    It stands where the person last read it, at zero before the first reading. A setting that is asked for again while
    the head still stands there is not shown again.

    Parameters
    ----------
    eyepiece
        The person.
    clock
        The computer's clock; the head has none.
    limits_deg
        Settings that may be asked for.
    speed_deg_s
        Angle by time that a person needs for it, for planning.
    serial
        What is engraved on it.
    """

    def __init__(
        self,
        eyepiece: Eyepiece,
        clock: Clock,
        *,
        limits_deg: tuple[float, float],
        speed_deg_s: float,
        serial: str = "",
    ) -> None:
        self._eyepiece = eyepiece
        self._clock = clock
        self._limits_deg = limits_deg
        self._speed_deg_s = speed_deg_s
        self._serial = serial
        self._reading_deg = 0.0
        self._setting_deg: float | None = None
        self._awaited = False

    @property
    def limits_deg(self) -> tuple[float, float]:
        """Settings that may be asked for."""
        return self._limits_deg

    @property
    def speed_deg_s(self) -> float:
        """Speed of a person, for planning."""
        return self._speed_deg_s

    def identify(self) -> Identity:
        """Say what the stand file says: nobody else knows."""
        return Identity(model="manual dividing head", serial=self._serial)

    def home(self) -> None:
        """Nothing to do: the circle is its own reference."""

    def start_move(self, angle_deg: float) -> None:
        """Ask for a setting. Raises `LimitError` outside the limits, or for what is no angle."""
        check_limits(Message("manual head"), angle_deg, self._limits_deg)
        if angle_deg == self._setting_deg and not self._awaited:
            return
        self._setting_deg, self._awaited = angle_deg, True
        self._eyepiece.show(angle_deg)

    def status(self) -> PositionerStatus:
        """Where it was read; moving for as long as a reading is awaited."""
        if self._awaited and (reading_deg := self._eyepiece.reading_deg()) is not None:
            self._reading_deg, self._awaited = reading_deg, False
        return PositionerStatus(
            angle_deg=self._reading_deg,
            moving=self._awaited,
            device_time_s=self._clock.monotonic_s(),
            by_hand=True,
        )

    def stop(self) -> None:
        """Ask for nothing any more."""
        if self._awaited:
            self._eyepiece.withdraw()
            self._setting_deg, self._awaited = None, False
