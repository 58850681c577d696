"""A rotary stage that speaks Zaber ASCII, over one axis of a simulated world or several, and chains of such stages.

It answers as the firmware 7 manual says, as far as a stage that is only homed, moved and stopped is asked: settings,
motion, warnings, rejections, checksums, broadcasts, alerts. Messages with a wrong checksum are ignored, as are those to
other devices. Moves to a place need a reference; outside `limit.min` and `limit.max` they are rejected.
"""

from collections.abc import Sequence
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
from tumble.emulators.faults import Faults, JointFaults
from tumble.emulators.world import SharedWorld
from tumble.emulators.zaber_axis import RejectError, ZaberAxis, most_severe
from tumble.emulators.zaber_line import ZaberChain

DEVICE_ID: Final = 99_001
"""None of Zaber's."""

_READ_ONLY: Final[dict[str, int | str]] = {
    "deviceid": DEVICE_ID,
    "version": "7.38",
    "version.build": 1,
    "system.access": 1,
    "comm.packet.size.max": 80,
    "comm.word.size.max": 50,
    "comm.command.packets.max": 1,
}


_OF_AXIS: Final = {"home": "home", "move": "go", "stop": "stop", "estop": "stop", "warnings": "warnings"}
"""What an axis does at each command."""


class EmulatedZaber:
    """A stage with one axis or several. What it is set to outlives clients and the loss of its power.

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
    address
        Its number in its chain, from 1.
    further
        Its axes from the second on.
    """

    def __init__(
        self,
        shared: SharedWorld,
        *,
        steps_per_deg: float,
        faults: Faults | None = None,
        serial: int = 51_234,
        address: int = 1,
        further: Sequence[ZaberAxis] = (),
    ) -> None:
        self._faults = faults or Faults()
        self._shared = shared
        self.axis = ZaberAxis(shared, steps_per_deg, self._faults)
        self._of_device = JointFaults([self._faults, *(axis.faults for axis in further)])
        self.axes = (self.axis, *further)
        """In the order of their numbers."""
        self.serial = serial
        self._settings = {"comm.checksum": 0, "comm.alert": 0, "comm.address": address}

    def session(self) -> ZaberChain:
        """A conversation with one more client of a line that has no other stage."""
        return ZaberChain([self])

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
            arrivals = sum(axis.arrivals for axis in self.axes)
            if arrivals == arrivals_known or not self._settings["comm.alert"]:
                return b"", arrivals
            number, axis = max(enumerate(self.axes, start=1), key=lambda entry: entry[1].arrived_s)
            message = DeviceMessage(kind=Kind.ALERT, device=self._address, axis=number, warning=axis.flag)
            return self.encode(message), arrivals

    def encode(self, message: DeviceMessage) -> bytes:
        """The message with a checksum where it is set so."""
        return encode_message(message, checksum=bool(self._settings["comm.checksum"]))

    @property
    def _address(self) -> int:
        return self._settings["comm.address"]

    def _live(self) -> None:
        """Let happen what happens without a command: motion, and faults."""
        swapped = self._of_device.take("swapped")
        if swapped:
            self.serial += 1
        powerless = swapped or self._of_device.take("power_loss")
        for axis in self.axes:
            if powerless:
                axis.lose_power()
            axis.look()

    def _answer(self, request: Request) -> DeviceMessage:
        word, *arguments = request.command.split() or [""]
        accepted = True
        try:
            if request.axis > len(self.axes):
                raise RejectError("BADAXIS")
            if request.axis and arguments and arguments[0] in self._device_settings():
                raise RejectError("DEVICEONLY")
            data = self._obey(word, arguments, self._meant(request))
        except RejectError as rejected:
            accepted, data = False, str(rejected)
        return DeviceMessage(
            kind=Kind.REPLY,
            device=self._address,
            axis=request.axis,
            message_id=request.message_id,
            accepted=accepted,
            busy=any(axis.busy for axis in self._meant(request)),
            warning=most_severe([axis.flag for axis in self._meant(request)]),
            data=data,
        )

    def _meant(self, request: Request) -> Sequence[ZaberAxis]:
        """The axis of a request; all where it is to all, or to one that there is not."""
        one = self.axes[request.axis - 1 : request.axis] if request.axis else ()
        return one or self.axes

    def _obey(self, word: str, arguments: Sequence[str], axes: Sequence[ZaberAxis]) -> str:
        if not word:
            return "0"
        of_device = {"get": self._get, "set": self._set}
        if word in of_device:
            return of_device[word](arguments, axes)
        if word == "system":
            return self._system(arguments)
        name = _OF_AXIS.get(word)
        if name is None:
            raise RejectError("BADCOMMAND")
        answers: list[str] = [getattr(axis, name)(arguments) for axis in axes]
        return answers[0]

    def _get(self, arguments: Sequence[str], axes: Sequence[ZaberAxis]) -> str:
        if len(arguments) != 1:
            raise RejectError("BADCOMMAND")
        (name,), of_device = arguments, self._device_settings()
        if name in of_device:
            return str(of_device[name])
        if name not in axes[0].settings():
            raise RejectError("BADCOMMAND")
        return " ".join(str(axis.settings()[name]) for axis in axes)

    def _device_settings(self) -> dict[str, int | str]:
        """Settings of the whole device, which no axis answers for."""
        known = {**_READ_ONLY, **self._settings, "system.axiscount": len(self.axes)}
        return {**known, "system.serial": self.serial}

    def _set(self, arguments: Sequence[str], axes: Sequence[ZaberAxis]) -> str:
        if len(arguments) != 2:
            raise RejectError("BADCOMMAND")
        name, text = arguments
        if name in ("comm.checksum", "comm.alert"):
            if text not in ("0", "1"):
                raise RejectError("BADDATA")
            self._settings[name] = int(text)
        elif name == "maxspeed":
            for axis in axes:
                axis.set_speed(text)
        else:
            raise RejectError("BADCOMMAND")
        return "0"

    def _system(self, arguments: Sequence[str]) -> str:
        if list(arguments) != ["reset"]:
            raise RejectError("BADCOMMAND")
        for axis in self.axes:
            axis.lose_power()
        return "0"
