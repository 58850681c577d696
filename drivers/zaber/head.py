"""A Zaber rotary stage as a dividing head."""

from collections.abc import Callable
from typing import Final

from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LimitError, NoReplyError, ReferenceLostError
from tumble.drivers.limits import check_limits
from tumble.drivers.protocols import Identity, PositionerStatus
from tumble.drivers.zaber.codec import DeviceMessage, GarbledError, parse_flags
from tumble.drivers.zaber.conversation import ATTEMPTS, Conversation, Link, RejectedError, UnclearError
from tumble.drivers.zaber.warnings import STOPPING, UNREFERENCED
from tumble.messages import Message

TIMEOUT_S: Final = 0.6
"""A device answers within a few milliseconds; a USB converter or a busy computer may add some tenths of a second."""

SPEED_UNITS_PER_HZ: Final = 1.6384
"""`maxspeed` counts 1/1.6384 microsteps per second (ASCII Protocol Manual, "Physical units")."""


class ZaberHead:
    """One axis of a Zaber device. Fits `tumble.drivers.protocols.Positioner` and `Reconnectable`.

    A question is asked up to three times. A command that moves is never just sent again: where its answer is missing or
    garbled, the device is first asked what it is doing. A stall and the like end the move with an error, and the axis
    counts as unreferenced until it has been homed; homing clears the flags.

    Parameters
    ----------
    link
        The way to the device, for example a `tumble.drivers.links.SerialLink`; a `Line` where others share it.
    device
        Number of the device in its chain, from 1.
    axis
        Number of its axis, from 1.
    steps_per_deg
        Microsteps of the device per degree of the head, sign included.
    limits_deg
        Soft limits, lower first.
    speed_deg_s
        Speed of every move; the device is set to it.
    clock
        Says when a status was read.
    """

    def __init__(
        self,
        link: Link,
        *,
        steps_per_deg: float,
        limits_deg: tuple[float, float],
        speed_deg_s: float,
        clock: Clock,
        device: int = 1,
        axis: int = 1,
        timeout_s: float = TIMEOUT_S,
    ) -> None:
        name = Message("Zaber head (device {device}, axis {axis})", device=device, axis=axis)
        self._conversation = Conversation(link, device=device, axis=axis, name=name, timeout_s=timeout_s)
        self._steps_per_deg = steps_per_deg
        self._limits_deg = limits_deg
        self._speed_deg_s = speed_deg_s
        self._clock = clock
        self._under_way = False
        """A move was begun, and its end not yet seen."""

    @property
    def limits_deg(self) -> tuple[float, float]:
        """Soft limits, checked before anything is sent."""
        return self._limits_deg

    @property
    def speed_deg_s(self) -> float:
        """Speed of every move."""
        return self._speed_deg_s

    def identify(self) -> Identity:
        """Ask device and stage who they are, and set them up: checksums in every message, speed.

        Model and serial number of a stage behind a controller follow a stroke: `50081/43211`.
        """
        if {self._get("comm.checksum", axis=False) for _ in range(2)} != {"1"}:  # one answer alone may be garbled
            self._conversation.repeat("set comm.checksum 1", axis=False)
        self._conversation.checksums = True
        speed = round(self._speed_deg_s * abs(self._steps_per_deg) * SPEED_UNITS_PER_HZ)
        self._require("maxspeed", speed)
        models = [self._get("deviceid", axis=False), *self._peripheral("peripheral.id")]
        serials = [self._get("system.serial", axis=False), *self._peripheral("peripheral.serial")]
        firmware = self._get("version", axis=False)
        return Identity(model=f"Zaber {'/'.join(models)}", serial="/".join(serials), firmware=firmware)

    def reconnect(self) -> None:
        """Open the link anew. The device may be another one, with or without checksums. Raises `LinkLostError`."""
        self._conversation.checksums = False
        self._under_way = False
        self._conversation.reopen()

    def home(self) -> None:
        """Clear the warnings and begin to look for the reference; told twice in doubt, which does no harm."""
        self._conversation.repeat("warnings clear")
        self._begin("home", arrived=lambda _: False)

    def start_move(self, angle_deg: float) -> None:
        """Begin to move to the nearest microstep.

        Raises
        ------
        LimitError
            Outside the soft limits or those set in the device.
        ReferenceLostError
            The head is not homed.
        DeviceError
            It is blocked, or does not answer.
        """
        check_limits(self._conversation.name, angle_deg, self._limits_deg)
        if not self.status().referenced:
            raise ReferenceLostError(
                self._conversation.name, Message("does not know its angle"), Message("home it before it moves")
            )
        steps = round(angle_deg * self._steps_per_deg)
        try:
            self._begin(f"move abs {steps}", arrived=lambda status: self._steps(status) == steps)
        except RejectedError as error:
            if error.reason != "BADDATA":
                raise
            raise LimitError(error.device, error.happened, error.remedy) from error

    def status(self) -> PositionerStatus:
        """Ask for position, motion and warnings. Raises `DeviceError` once where a move has ended badly."""
        reply = self._conversation.repeat("get pos")
        status = self._read(reply, self._flags(reply))
        self._under_way = self._under_way and status.moving
        return status

    def stop(self) -> None:
        """Brake; may be sent as often as one likes. It is sent also where nothing can be heard for noise."""
        try:
            self._conversation.repeat("stop")
        except NoReplyError:
            self._conversation.say("stop")
            raise

    def _begin(self, command: str, arrived: Callable[[PositionerStatus], bool]) -> None:
        """Begin a motion. Where it is unclear whether the device heard, it is asked before it is told again."""
        self._under_way = True
        for attempt in range(1, ATTEMPTS + 1):
            try:
                self._conversation.once(command)
                return
            except UnclearError:
                if attempt == ATTEMPTS:
                    raise
                status = self.status()
                if status.moving or arrived(status):
                    return
                self._under_way = True

    def _read(self, reply: DeviceMessage, flags: frozenset[str]) -> PositionerStatus:
        if self._under_way and (met := [flag for flag in STOPPING if flag in flags]):
            self._under_way = False
            happened, remedy = STOPPING[met[0]]
            raise DeviceError(
                self._conversation.name,
                Message("{happened} (flag {flag})", happened=happened, flag=met[0]),
                Message("{remedy}, then resume the run; it homes first", remedy=remedy),
            )
        try:
            angle_deg = int(reply.data) / self._steps_per_deg
        except ValueError as error:
            raise DeviceError(
                self._conversation.name,
                Message("gives {data!r} for its position", data=reply.data),
                Message("check model, axis number and firmware"),
            ) from error
        unreferenced = flags & UNREFERENCED or any(flag.startswith("F") for flag in flags)
        return PositionerStatus(
            angle_deg=angle_deg,
            moving=reply.busy,
            device_time_s=self._clock.monotonic_s(),
            referenced=not unreferenced,
        )

    def _flags(self, reply: DeviceMessage) -> frozenset[str]:
        """All flags; they are asked for only where the one in the reply may hide others that matter."""
        if reply.warning[0] not in "FW":
            return frozenset({reply.warning})
        return frozenset({reply.warning, *self._listed()})

    def _listed(self) -> tuple[str, ...]:
        """The list of flags; one that is not as long as it says is asked for again. Raises `DeviceError`."""
        garbled = GarbledError()
        for _ in range(ATTEMPTS):
            try:
                return parse_flags(self._conversation.repeat("warnings").data)
            except GarbledError as error:
                garbled = error
        raise DeviceError(
            self._conversation.name,
            Message(
                "gave no list of warnings that can be believed in {attempts} attempts ({reason})",
                attempts=ATTEMPTS,
                reason=garbled,
            ),
            Message("check model and firmware, and what else talks on this line"),
        ) from garbled

    def _steps(self, status: PositionerStatus) -> int:
        return round(status.angle_deg * self._steps_per_deg)

    def _get(self, setting: str, *, axis: bool = True) -> str:
        return self._conversation.repeat(f"get {setting}", axis=axis).data

    def _require(self, setting: str, value: int) -> None:
        """Set what is not so already: settings are kept in a memory that wears out."""
        if self._get(setting) != str(value):
            self._conversation.repeat(f"set {setting} {value}")

    def _peripheral(self, setting: str) -> list[str]:
        """What a stage behind a controller says; nothing where stage and controller are one."""
        try:
            return [self._get(setting)]
        except RejectedError as error:
            if error.reason not in ("BADCOMMAND", "BADAXIS"):
                raise
            return []
