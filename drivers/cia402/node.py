"""One CANopen node as its master sees it: objects by SDO, heartbeat, boot-up and emergency messages."""

import logging
import math
import time
from collections.abc import Callable
from functools import partial
from typing import Final, TypeVar

import can
import canopen
from canopen import SdoAbortedError, SdoCommunicationError
from canopen.emcy import EmcyError
from canopen.objectdictionary import ODVariable

from tumble.drivers.cia402 import objects
from tumble.drivers.cia402.emergencies import abort_words, emergency_words
from tumble.drivers.errors import DeviceError, LinkLostError, NoReplyError
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.links.patience import in_words
from tumble.drivers.links.tally import Tally
from tumble.messages import Message

TRIES: Final = 3
REPLY_TIMEOUT_S: Final = 0.5
HEARTBEAT_S: Final = 0.2
PATIENCE_S: Final = 1.5
"""A node from which no heartbeat came for so long is lost."""

_SDO_ANSWER: Final = 0x580
_FUNCTION: Final = 0x780
_NODE: Final = 0x7F
_MOST_ID: Final = 0x7FF
_SDO_BYTES: Final = 8
_LATE_S: Final = 0.1
"""Wait after a missing answer, so that a late one is not taken for the next."""
_SLICE_S: Final = 0.05
"""One wait for an answer without a look."""

Answer = TypeVar("Answer")

logging.getLogger("canopen").addHandler(logging.NullHandler())  # what it reports is raised here


class _BrokenOffError(Exception):
    """Somebody has a wait for an answer broken off, by raising `why`."""

    def __init__(self, why: Exception) -> None:
        super().__init__(why)
        self.why = why


class DriveNode:
    """A node on a CAN bus; every failure is told as an error of `tumble.drivers.errors`.

    Reading an object and writing one are both repeated where no answer came: writing the same value twice is the same
    as writing it once, also for the controlword, of which only edges count.

    Parameters
    ----------
    link
        The bus.
    node_id
        1 to 127.
    check
        Called many times a second while an answer is awaited; what it raises breaks the wait off.
    """

    def __init__(self, link: CanLink, node_id: int, check: Callable[[], object] = lambda: None) -> None:
        self.device = Message("CAN drive, node {node_id}", node_id=node_id)
        self.booted = False
        """Whether it has told of a start since this was last set to false."""
        self.emergency: int | None = None
        """Code of an emergency that it has not taken back."""
        self.tally = Tally(self.device)
        """Messages that could not be read."""
        self._link = link
        self._heard_s = -math.inf
        self._beats = True
        self._network = _LinkNetwork(link, node_id, self.tally)
        self._node = canopen.RemoteNode(node_id, objects.object_dictionary(node_id))
        self._network[node_id] = self._node
        self._check = check
        self._node.sdo.RESPONSE_TIMEOUT = _SLICE_S
        self._node.sdo.read_response = partial(self._awaited, self._node.sdo.read_response)
        self._node.nmt.add_heartbeat_callback(self._hear_heartbeat)
        self._node.emcy.add_callback(self._hear_emergency)
        self._generation = 0

    def connect(self) -> None:
        """Start the node and its heartbeat, on the bus as it is, or opened anew where it was used before.

        A node that gives no heartbeat (CiA 301 lets it have node guarding in its place) is there as long as it answers.
        Raises `LinkLostError` while the node does not answer.
        """
        self._generation = self._link.reopen(self._generation)
        self._heard_s = -math.inf
        try:
            self.read(objects.STATUSWORD)
            self._heard_s = time.monotonic()
            self._beats = self.write_where_offered(objects.HEARTBEAT_MS, round(1000 * HEARTBEAT_S))
        except NoReplyError as error:
            raise LinkLostError(error.device, error.happened, error.remedy) from error
        self._heard_s = time.monotonic()
        self._node.nmt.state = "OPERATIONAL"

    def check(self) -> None:
        """Make sure that the node is there, and shall be awaited. Raises `LinkLostError`."""
        self._check()
        self._link.check()
        if self._beats and not self._alive():
            raise LinkLostError(
                self.device,
                Message("has given no heartbeat for {patience_s:g} s", patience_s=PATIENCE_S),
                Message("check its power and the cable; the run can be resumed"),
            )

    def remarks(self) -> tuple[str, ...]:
        """What was dropped here and on the bus, as far as it is time to tell of it."""
        return self.tally.remarks() + self._link.tally.remarks()

    def last_remarks(self) -> tuple[str, ...]:
        """What of that has not been told."""
        return self.tally.last_remarks() + self._link.tally.last_remarks()

    def error_code(self) -> int:
        """What the drive says of its fault; 0 where it does not (603Fh is optional in CiA 402)."""
        return int(self.read_where_offered(objects.ERROR_CODE) or 0)

    def fault(self, code: int) -> DeviceError:
        """The error that says what the drive complains of."""
        return DeviceError(
            self.device,
            Message("reports {emergency}", emergency=emergency_words(code)),
            Message("remove the cause, make sure that the head is free to turn, then resume the run"),
        )

    def read(self, index: int, subindex: int = 0) -> int:
        """Value of a numeric object. Raises `LinkLostError`, `NoReplyError`, `DeviceError`."""
        return int(self._read(self._variable(index, subindex)))

    def read_where_offered(self, index: int, subindex: int = 0) -> int | str | None:
        """Value of an object that a drive need not have; None where it refuses it or does not answer, as some do.

        Raises `LinkLostError`, and `NoReplyError` where it no longer answers at all.
        """
        try:
            value = self._read(self._variable(index, subindex))
        except LinkLostError:
            raise
        except NoReplyError:
            self.read(objects.STATUSWORD)  # which every drive has
            return None
        except DeviceError:
            return None
        return value.strip("\0 ") if isinstance(value, str) else value

    def write(self, index: int, value: int, subindex: int = 0) -> None:
        """Set an object. Raises `LinkLostError`, `NoReplyError`, `DeviceError`."""
        variable = self._variable(index, subindex)
        self._asked(variable, lambda: self._node.sdo.download(index, subindex, variable.encode_raw(value)))

    def write_where_offered(self, index: int, value: int) -> bool:
        """Set an object that a drive need not have; false where it refuses that or does not answer, as some do.

        Raises `LinkLostError`, and `NoReplyError` where it no longer answers at all.
        """
        try:
            self.write(index, value)
        except LinkLostError:
            raise
        except NoReplyError:
            self.read(objects.STATUSWORD)  # which every drive has
            return False
        except DeviceError:
            return False
        return True

    def _read(self, variable: ODVariable) -> int | str:
        return self._asked(  # type: ignore[return-value]  # no object here is a float or a block of bytes
            variable, lambda: variable.decode_raw(self._node.sdo.upload(variable.index, variable.subindex))
        )

    def _asked(self, variable: ODVariable, ask: Callable[[], Answer]) -> Answer:
        """What the node answers, asked again where no answer or none that can be read has come."""
        reason = ""
        for _ in range(TRIES):
            try:
                return ask()
            except DeviceError:  # of the link
                raise
            except _BrokenOffError as error:
                time.sleep(_LATE_S)
                raise error.why from None
            except SdoAbortedError as error:
                raise self._refused(variable, error) from error
            except Exception as error:  # canopen raises several kinds for an answer that is none
                reason = "" if isinstance(error, SdoCommunicationError) else in_words(error)
                time.sleep(_LATE_S)
        raise self._silent(reason)

    def _awaited(self, read: Callable[[], bytes]) -> bytes:
        """An answer, read as canopen does, in short waits."""
        deadline_s = time.monotonic() + REPLY_TIMEOUT_S
        while True:
            try:
                self._check()
            except Exception as error:  # to be told from what canopen raises
                raise _BrokenOffError(error) from error
            try:
                return read()
            except SdoCommunicationError:
                if time.monotonic() > deadline_s:
                    raise

    def _variable(self, index: int, subindex: int) -> ODVariable:
        variable = self._node.object_dictionary.get_variable(index, subindex)
        assert variable is not None, f"{index:04X}h is not in the object dictionary"
        return variable

    def _refused(self, variable: ODVariable, error: SdoAbortedError) -> DeviceError:
        return DeviceError(
            self.device,
            Message(
                "refused object {index:04X}h ({name}): {reason}",
                index=variable.index,
                name=variable.name.lower(),
                reason=abort_words(error.code),
            ),
            Message("check that it is a CiA 402 drive with profile position and homing, and its parameters"),
        )

    def _alive(self) -> bool:
        return time.monotonic() - self._heard_s <= PATIENCE_S

    def _silent(self, reason: str) -> DeviceError:
        """The error for a node that does not answer: is it there at all?"""
        self._link.check()
        happened = Message("gave no SDO answer in {tries} tries", tries=TRIES)
        if reason:
            happened = Message(
                "gave no SDO answer that can be read ({reason}) in {tries} tries", reason=reason, tries=TRIES
            )
        if self._alive():
            return NoReplyError(self.device, happened, Message("switch it off and on, then resume the run"))
        return LinkLostError(
            self.device,
            Message("{happened} and no heartbeat", happened=happened),
            Message("check its power, node number and cable"),
        )

    def _hear_heartbeat(self, state: int) -> None:
        self._heard_s = time.monotonic()
        if state == 0:
            self.booted = True
            self.emergency = None

    def _hear_emergency(self, entry: EmcyError) -> None:
        self.emergency = None if entry.code & 0xFF00 == 0 else entry.code


class _LinkNetwork(canopen.Network):
    """A CANopen network whose bus is a `CanLink`, so that others may share the bus."""

    def __init__(self, link: CanLink, node_id: int, tally: Tally) -> None:
        super().__init__()
        self._link = link
        self._node_id = node_id
        self._tally = tally
        link.subscribe(self._hear)

    def send_message(self, can_id: int, data: bytes, remote: bool = False) -> None:
        """Send through the link; a remote request, which nothing here uses, is not sent."""
        if not remote:
            self._link.send(can_id, bytes(data))

    def _hear(self, message: can.Message) -> None:
        """Pass a message on to whom it concerns; one of the node's that cannot be read is dropped and counted."""
        can_id, data = message.arbitration_id, message.data
        if can_id > _MOST_ID:
            return
        try:
            if message.is_extended_id:
                raise ValueError(Message("an identifier here has 11 bits"))
            if can_id & _FUNCTION == _SDO_ANSWER and len(data) != _SDO_BYTES:
                raise ValueError(Message("an SDO answer has 8 bytes"))
            self.notify(can_id, data, message.timestamp)
        except Exception as error:  # canopen raises several kinds, and nobody would see them in this thread
            if can_id & _NODE == self._node_id:
                self._tally.count(
                    Message("messages dropped that cannot be read"),
                    f"{can_id:X}h {data.hex()}: {in_words(error)}",
                )
