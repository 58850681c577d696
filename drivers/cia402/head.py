"""A dividing head turned by a CiA 402 drive in profile position mode."""

import time
from collections.abc import Callable
from typing import Final

from tumble.drivers.cia402 import modes, objects, states
from tumble.drivers.cia402.emergencies import emergency_words
from tumble.drivers.cia402.errand import Errand
from tumble.drivers.cia402.identity import identity_of
from tumble.drivers.cia402.node import DriveNode
from tumble.drivers.cia402.states import Mode, State
from tumble.drivers.clock import Clock
from tumble.drivers.errors import DeviceError, LimitError, NoReplyError, ReferenceLostError
from tumble.drivers.limits import check_limits
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.protocols import Identity, PositionerStatus
from tumble.messages import Message

ANSWER_S: Final = 2.0
"""How long the drive may take to change its state or mode, or to take a set-point, in real seconds."""

_STAY_STOPPED: Final = 6
"""Quick stop option code: brake on the quick stop ramp and stay in `State.QUICK_STOP`."""
_STILL_DEG: Final = 0.005
"""An axis at rest may be read so far beside its place."""
_BEGIN_S: Final = 0.05
"""How long the bits of before are watched for their going when homing begins."""
_MOST_COUNTS: Final = 2**31 - 1


class Cia402Head:
    """A head on CANopen. Fits `Positioner`, `Reconnectable`, `Resettable` and `Remarking`.

    The homing method is the one that is set in the drive. A fault of the drive is never reset on the way: whoever knows
    that its cause is gone calls `reset_fault`, after which the head is to be homed.

    Parameters
    ----------
    link
        The bus; others may share it.
    node_id
        Number of the node, 1 to 127.
    limits_deg
        Soft limits.
    steps_per_deg
        Position units of the drive per degree, sign included.
    speed_deg_s
        Speed of a move.
    clock
        Clock by which the status is dated.
    check
        Called many times a second while an answer is awaited; what it raises breaks the wait off.

    Raises
    ------
    LinkLostError
        No such node answers.
    DeviceError
        The node is no CiA 402 drive, or the cause of its fault is still there.
    """

    def __init__(
        self,
        link: CanLink,
        node_id: int,
        *,
        limits_deg: tuple[float, float],
        steps_per_deg: float,
        speed_deg_s: float,
        clock: Clock,
        check: Callable[[], object] = lambda: None,
    ) -> None:
        self._limits_deg = limits_deg
        self._steps_per_deg = steps_per_deg
        self._speed_deg_s = speed_deg_s
        self._clock = clock
        self._homed = False
        self._told = ""
        self._node = DriveNode(link, node_id, check)
        self._errand = Errand(0, self._still, 0.0, begun=True)
        self.reconnect()

    @property
    def limits_deg(self) -> tuple[float, float]:
        """Soft limits."""
        return self._limits_deg

    @property
    def speed_deg_s(self) -> float:
        """Speed of a move."""
        return self._speed_deg_s

    def reconnect(self) -> None:
        """Open the bus anew, unless another instrument on it has, start the node, and stop a move that is under way.

        Raises
        ------
        LinkLostError
            The bus or the node is not there.
        """
        self._node.connect()
        self._node.booted = False
        self._node.write_where_offered(objects.QUICK_STOP_OPTION, _STAY_STOPPED)  # optional (CiA 402-2)
        if states.is_moving(self._node.read(objects.STATUSWORD)):
            self.stop()
            self._await(Message("come to rest"), states.TARGET_REACHED, states.TARGET_REACHED)
        self._homed = modes.says_homed(self._node, ANSWER_S)
        self._believe()

    def remarks(self) -> tuple[str, ...]:
        """What was dropped or tried again."""
        return self._node.remarks()

    def last_remarks(self) -> tuple[str, ...]:
        """What of that has not been told."""
        return self._node.last_remarks()

    def identify(self) -> Identity:
        """Name, serial number and software version of the drive, as far as it has them (all are optional in CiA 301).

        Raises `LinkLostError`, `NoReplyError`.
        """
        return identity_of(self._node)

    def home(self) -> None:
        """Start homing; `status` tells when it is done. Raises `DeviceError`."""
        self._refuse_fault()
        self._node.booted = self._homed = False
        self._enable(Mode.HOMING)
        self._set_out(homing=True)
        self._control(states.ENABLE | states.START)
        self._see_it_begin()

    def start_move(self, angle_deg: float) -> None:
        """Begin to move to the nearest count; a move under way is replaced.

        Raises
        ------
        LimitError
            Outside the limits; nothing moved.
        ReferenceLostError
            The head has not been homed, or has lost its reference since.
        DeviceError
            The drive is faulty or did not take the set-point.
        """
        counts = self._counts(angle_deg)
        self._refuse_fault()
        if not self._referenced:
            raise ReferenceLostError(
                self._node.device, Message("has lost its reference"), Message("home it before it is moved")
            )
        self._enable(Mode.PROFILE_POSITION)
        self._node.write(objects.PROFILE_VELOCITY, max(1, round(abs(self._speed_deg_s * self._steps_per_deg))))
        self._node.write(objects.TARGET_POSITION, counts)
        # This bit says "homed" in the mode before.
        self._await(Message("be ready for a set-point"), states.ACKNOWLEDGED, 0)
        self._set_out(target=counts)
        self._control(states.ENABLE | states.START | states.AT_ONCE)
        self._await(Message("take the set-point"), states.ACKNOWLEDGED, states.ACKNOWLEDGED)
        self._control(states.ENABLE)
        self._await(Message("be ready for the next set-point"), states.ACKNOWLEDGED, 0)

    def status(self) -> PositionerStatus:
        """Read position and motion back.

        A fault of the drive or of the motion is raised as `DeviceError` the first time it is seen; after that the
        position can be read all the same, so that a standstill can be made sure of.
        """
        self._node.check()
        statusword = self._node.read(objects.STATUSWORD)
        mode = self._node.read(objects.MODE_DISPLAY)
        counts = self._node.read(objects.POSITION)
        self._tell_once(self._complaint(statusword, mode))
        now_s = time.monotonic()
        if mode == Mode.HOMING and self._errand.homed(statusword, counts, now_s):
            self._homed = True
        return PositionerStatus(
            angle_deg=counts / self._steps_per_deg + 0.0,  # never -0
            moving=states.is_powered(statusword) and not self._errand.over(statusword, counts, now_s),
            device_time_s=self._clock.monotonic_s(),
            referenced=self._referenced,
        )

    def stop(self) -> None:
        """Brake on the quick stop ramp; in every other state than a move this changes nothing. Raises `DeviceError`."""
        self._control(states.QUICK_STOP)
        self._believe()

    def reset_fault(self) -> str:
        """Reset a fault whose cause the operator has removed. Raises `DeviceError` where the cause is still there."""
        code = self._node.emergency or self._node.error_code()
        faulty = modes.state(self._node) is State.FAULT
        if faulty:
            self._control(states.DISABLE_VOLTAGE)
            self._control(states.FAULT_RESET)
            self._node.emergency = None
            self._await(Message("leave its fault"), states.STATUS[State.FAULT][0], 0x40)
        if self._node.read(objects.ERROR_REGISTER):
            raise self._node.fault(self._node.error_code())
        self._node.emergency = None
        if faulty:
            self._homed, self._told = False, ""
        return emergency_words(code) if faulty else ""

    @property
    def _referenced(self) -> bool:
        return self._homed and not self._node.booted

    def _counts(self, angle_deg: float) -> int:
        check_limits(self._node.device, angle_deg, self._limits_deg)
        counts = round(angle_deg * self._steps_per_deg)
        if abs(counts) > _MOST_COUNTS:
            happened = Message(
                "cannot count to {angle_deg:g} deg, which are {counts} of its position units",
                angle_deg=angle_deg,
                counts=counts,
            )
            raise LimitError(self._node.device, happened, Message("choose coarser position units in the drive"))
        return counts

    @property
    def _still(self) -> int:
        return max(1, round(_STILL_DEG * abs(self._steps_per_deg)))

    def _set_out(self, *, target: int | None = None, homing: bool = False) -> None:
        """Follow what the drive is about to do, from where it stands."""
        start = self._node.read(objects.POSITION)
        self._errand = Errand(start, self._still, time.monotonic(), target=target, homing=homing)

    def _believe(self) -> None:
        """Take what the drive says of its rest as it is."""
        self._errand = Errand(0, self._still, time.monotonic(), begun=True)

    def _see_it_begin(self) -> None:
        """See the bits of before go: a short way may be over before somebody asks for the status."""
        deadline_s = time.monotonic() + _BEGIN_S
        while not self._errand.begun and time.monotonic() < deadline_s:
            statusword = self._node.read(objects.STATUSWORD)
            self._errand.over(statusword, self._node.read(objects.POSITION), time.monotonic())

    def _enable(self, mode: Mode) -> None:
        """Choose the mode, and walk through the state machine until the drive is enabled in it."""
        modes.choose(self._node, mode)
        deadline_s = time.monotonic() + ANSWER_S
        while (state := modes.state(self._node)) is not State.ENABLED:
            if state in states.TOWARDS_ENABLED:
                self._control(states.TOWARDS_ENABLED[state])
            self._pause(deadline_s, Message("become enabled"))
        if not modes.shows(self._node, mode, ANSWER_S):
            self._refuse_fault()
            raise self._did_not(Message("enter the mode {mode}", mode=mode.name.lower().replace("_", " ")))

    def _complaint(self, statusword: int, mode: int) -> DeviceError | None:
        """What is wrong with the drive or its motion."""
        if self._node.emergency is not None:
            return self._node.fault(self._node.emergency)
        state = states.state_of(statusword)
        if state in (State.FAULT, State.FAULT_REACTION):
            return self._node.fault(self._node.error_code())
        if state is State.ENABLED and statusword & states.MOTION_ERROR:
            what = (
                Message("homing failed") if mode == Mode.HOMING else Message("the head does not follow its set-point")
            )
            return DeviceError(self._node.device, what, Message("look for what blocks it, then resume the run"))
        return None

    def _tell_once(self, complaint: DeviceError | None) -> None:
        told, self._told = self._told, str(complaint or "")
        if complaint is not None and str(complaint) != told:
            raise complaint

    def _refuse_fault(self) -> None:
        """Make sure that the drive is there and without a fault."""
        self._node.check()
        if self._node.emergency is not None:
            raise self._node.fault(self._node.emergency)
        if modes.state(self._node) is State.FAULT:
            raise self._node.fault(self._node.error_code())

    def _control(self, word: int) -> None:
        self._node.write(objects.CONTROLWORD, word)

    def _await(self, what: str, mask: int, value: int) -> None:
        deadline_s = time.monotonic() + ANSWER_S
        while self._node.read(objects.STATUSWORD) & mask != value:
            self._pause(deadline_s, what)

    def _pause(self, deadline_s: float, what: str) -> None:
        """Wait a moment for the drive. Raises `DeviceError` where it takes too long: its fault, or that it has none."""
        self._node.check()
        if time.monotonic() > deadline_s:
            self._refuse_fault()
            raise self._did_not(what)
        time.sleep(modes.POLL_S)

    def _did_not(self, what: str) -> NoReplyError:
        return NoReplyError(
            self._node.device, Message("did not {what}", what=what), Message("check its supply and its parameters")
        )
