"""Nothing turns while the door of the chamber is open: somebody may reach in."""

from collections.abc import Callable, Mapping
from contextlib import suppress
from typing import Final

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError
from tumble.drivers.protocols import Environment, EnvironmentStatus, Stand
from tumble.messages import Message
from tumble.procedures.losses import Losses

_LOOK_S: Final = 0.5
"""From one look at a door to the next, by the stand's clock."""


def check_environment(title: str, status: EnvironmentStatus) -> None:
    """Make sure that the door is shut and nothing is complained of. Raises `DeviceError`."""
    if status.door_open:
        raise DeviceError(title, Message("its door is open"), Message("shut it, then resume the run"))
    if status.alarm:
        raise DeviceError(
            title, Message("reports a fault of its own"), Message("look at its display, then resume the run")
        )


class Interlock:
    """The doors of a stand, as far as it has any."""

    def __init__(self, stand: Stand, losses: Losses) -> None:
        self._environments: Mapping[str, Environment] = stand.environments
        self._title: Callable[[str], str] = stand.title
        self._clock: Clock = stand.clock
        self._losses = losses
        self._looked_s = -_LOOK_S
        self.used: set[str] = set()
        """Environments that were told a temperature, and are to be left safe."""

    def check(self) -> None:
        """Make sure that everything may turn; called over and over while it does. Raises `DeviceError`."""
        if not self._environments or self._clock.monotonic_s() - self._looked_s < _LOOK_S:
            return
        for name, environment in self._environments.items():
            with self._losses.using(name):
                check_environment(self._title(name), environment.status())
        self._looked_s = self._clock.monotonic_s()

    def begin(self) -> None:
        """Make sure that the doors are shut, and keep them so. Raises `DeviceError`."""
        self.check()
        for name, environment in self._environments.items():
            with self._losses.using(name):
                environment.lock_door(True)

    def leave(self, at_standstill: bool) -> list[str]:
        """Leave every environment safe; its door may be opened where everything stands.

        Returns a sentence for each that could not be left so.
        """
        failures = [failure for name in self._environments if (failure := self._left(name, at_standstill))]
        self.used.clear()
        return failures

    def _left(self, name: str, at_standstill: bool) -> str:
        environment = self._environments[name]
        try:
            if name in self.used:
                environment.make_safe()
        except DeviceError as error:
            return Message(
                "{title}: could not be left in its safe state ({happened}); look at it",
                title=self._title(name),
                happened=error.happened,
            )
        if at_standstill:
            with suppress(DeviceError):  # it stays shut, and can be opened by hand
                environment.lock_door(False)
        return ""
