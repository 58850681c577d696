"""A rotary stage that speaks Zaber ASCII, over the head of a simulated world.

It answers as the firmware 7 manual says, as far as a stage that is only homed, moved and stopped is asked: settings,
motion, warnings, rejections, checksums, broadcasts, alerts. Messages with a wrong checksum are ignored, as are those to
other devices. Moves to a place need a reference; outside `limit.min` and `limit.max` they are rejected.
"""

from collections.abc import Callable, Sequence
from typing import Final

from tumble.drivers.zaber.codec import (
    BROADCAST,
    DeviceMessage,
    GarbledError,
    Kind,
    Request,
    encode_message,
    parse_request,
)
from tumble.emulators.faults import Faults
from tumble.emulators.world import SharedWorld
from tumble.emulators.zaber_axis import RejectError, ZaberAxis

DEVICE_ID: Final = 99_001
"""None of Zaber's."""

_READ_ONLY: Final[dict[str, int | str]] = {
    "deviceid": DEVICE_ID,
    "version": "7.38",
    "version.build": 1,
    "system.axiscount": 1,
    "system.access": 1,
    "comm.packet.size.max": 80,
    "comm.word.size.max": 50,
    "comm.command.packets.max": 1,
}


class EmulatedZaber:
    """A stage with one axis, number 1 in its chain. What it is set to outlives clients and the loss of its power.

    Parameters
    ----------
    shared
        The world whose head it turns.
    steps_per_deg
        Microsteps per degree of that head, sign included.
    faults
        What goes wrong in the device: `stall`, `overshoot`, `moving_for_ever`, `power_loss`, `swapped`.
    serial
        Its serial number; a swapped unit has the next one.
    """

    def __init__(
        self, shared: SharedWorld, *, steps_per_deg: float, faults: Faults | None = None, serial: int = 51_234
    ) -> None:
        self._faults = faults or Faults()
        self._shared = shared
        self.axis = ZaberAxis(shared, steps_per_deg, self._faults)
        self.serial = serial
        self._settings = {"comm.checksum": 0, "comm.alert": 0, "comm.address": 1}
        self._commands: dict[str, Callable[[Sequence[str]], str]] = {
            "get": self._get,
            "set": self._set,
            "home": self.axis.home,
            "move": self.axis.go,
            "stop": self.axis.stop,
            "estop": self.axis.stop,
            "warnings": self.axis.warnings,
            "system": self._system,
        }

    def session(self) -> "ZaberSession":
        """A conversation with one more client."""
        return ZaberSession(self)

    def hear(self, line: bytes) -> bytes:
        """Answer one line; silence where it is not for this device, or garbled."""
        with self._shared.lock:
            self._live()
            try:
                request = parse_request(line)
            except GarbledError:
                return b""
            if request.device not in (BROADCAST, self._settings["comm.address"]):
                return b""
            return self.encode(self._answer(request))

    def alert(self, arrivals_known: int) -> tuple[bytes, int]:
        """What a client that knows of so many arrivals is to be told unasked, and of how many it knows then."""
        with self._shared.lock:
            self._live()
            arrivals = self.axis.arrivals
            if arrivals == arrivals_known or not self._settings["comm.alert"]:
                return b"", arrivals
            message = DeviceMessage(kind=Kind.ALERT, device=self._address, axis=1, warning=self.axis.flag)
            return self.encode(message), arrivals

    def encode(self, message: DeviceMessage) -> bytes:
        """The message with a checksum where it is set so."""
        return encode_message(message, checksum=bool(self._settings["comm.checksum"]))

    @property
    def _address(self) -> int:
        return self._settings["comm.address"]

    def _live(self) -> None:
        """Let happen what happens without a command: motion, and faults."""
        swapped = self._faults.take("swapped")
        if swapped:
            self.serial += 1
        if swapped or self._faults.take("power_loss"):
            self.axis.lose_power()
        self.axis.look()

    def _answer(self, request: Request) -> DeviceMessage:
        word, *arguments = request.command.split() or [""]
        accepted = True
        try:
            if request.axis > 1:
                raise RejectError("BADAXIS")
            if request.axis and arguments and arguments[0] in self._device_settings():
                raise RejectError("DEVICEONLY")
            data = self._obey(word, arguments)
        except RejectError as rejected:
            accepted, data = False, str(rejected)
        return DeviceMessage(
            kind=Kind.REPLY,
            device=self._address,
            axis=request.axis,
            message_id=request.message_id,
            accepted=accepted,
            busy=self.axis.busy,
            warning=self.axis.flag,
            data=data,
        )

    def _obey(self, word: str, arguments: Sequence[str]) -> str:
        if not word:
            return "0"
        command = self._commands.get(word)
        if command is None:
            raise RejectError("BADCOMMAND")
        return command(arguments)

    def _get(self, arguments: Sequence[str]) -> str:
        if len(arguments) != 1:
            raise RejectError("BADCOMMAND")
        values = self._device_settings() | self.axis.settings()
        if arguments[0] not in values:
            raise RejectError("BADCOMMAND")
        return str(values[arguments[0]])

    def _device_settings(self) -> dict[str, int | str]:
        """Settings of the whole device, which no axis answers for."""
        return {**_READ_ONLY, **self._settings, "system.serial": self.serial}

    def _set(self, arguments: Sequence[str]) -> str:
        if len(arguments) != 2:
            raise RejectError("BADCOMMAND")
        name, text = arguments
        if name in ("comm.checksum", "comm.alert"):
            if text not in ("0", "1"):
                raise RejectError("BADDATA")
            self._settings[name] = int(text)
        elif name == "maxspeed":
            self.axis.set_speed(text)
        else:
            raise RejectError("BADCOMMAND")
        return "0"

    def _system(self, arguments: Sequence[str]) -> str:
        if list(arguments) != ["reset"]:
            raise RejectError("BADCOMMAND")
        self.axis.lose_power()
        return "0"


class ZaberSession:
    """What one client hears. Fits `tumble.emulators.serving.Session`."""

    def __init__(self, device: EmulatedZaber) -> None:
        self._device = device
        _, self._arrivals = device.alert(0)

    def received(self, data: bytes) -> bytes:
        """Answer one line."""
        return self._device.hear(data)

    def due(self) -> bytes:
        """An alert where the axis has come to rest since the last look."""
        alert, self._arrivals = self._device.alert(self._arrivals)
        return alert
