"""One request at a time over a link, and the message that answers it and no other."""

import time
from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import cycle
from typing import Final, Protocol

from tumble.drivers.errors import DeviceError, NoReplyError
from tumble.drivers.zaber.codec import (
    BROADCAST,
    LINE_END,
    MESSAGE_IDS,
    DeviceMessage,
    GarbledError,
    Kind,
    Request,
    encode_request,
    parse_message,
)
from tumble.drivers.zaber.warnings import rejection
from tumble.messages import Message

ATTEMPTS: Final = 3
"""How often what may be repeated is tried."""


class Link(Protocol):
    """What is needed of `tumble.drivers.links.SerialLink`."""

    def write(self, data: bytes) -> None:
        """Send bytes. Raises `LinkLostError`."""
        ...

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        """Wait for a line. Raises `LinkLostError`, `NoReplyError`."""
        ...

    def discard_input(self) -> None:
        """Throw away what has come. Raises `LinkLostError`, and `NoReplyError` where it does not end."""
        ...

    def reopen(self) -> None:
        """Open the port anew. Raises `LinkLostError`."""
        ...


def request_ids() -> Iterator[int]:
    """Numbers for requests, each as far as can be from its next use."""
    return cycle(range(MESSAGE_IDS))


@dataclass(frozen=True)
class Line:
    """A serial line that all axes of a chain share, with the numbers of the requests on it. Fits `Link`."""

    link: Link
    ids: Iterator[int] = field(default_factory=request_ids)

    def write(self, data: bytes) -> None:
        """Send bytes. Raises `LinkLostError`."""
        self.link.write(data)

    def read_line(self, terminator: bytes, timeout_s: float) -> bytes:
        """Wait for a line. Raises `LinkLostError`, `NoReplyError`."""
        return self.link.read_line(terminator, timeout_s)

    def discard_input(self) -> None:
        """Throw away what has come. Raises as `Link.discard_input`."""
        self.link.discard_input()

    def reopen(self) -> None:
        """Open the port anew, for all. Raises `LinkLostError`."""
        self.link.reopen()


class UnclearError(NoReplyError):
    """What came of a command is unknown: the answer did not come, or came garbled."""


class RejectedError(DeviceError):
    """The device refused a command; nothing happened."""

    def __init__(self, device: str, command: str, reason: str) -> None:
        happened, remedy = rejection(reason)
        super().__init__(
            device, Message("refuses {command!r}: it {happened}", command=command, happened=happened), remedy
        )
        self.reason = reason


class Conversation:
    """Requests to one axis of one device, every one with an id and a checksum.

    Messages with another id are late or doubled answers to earlier requests and are passed over, and so are alerts.

    Parameters
    ----------
    link
        The way to the device.
    device
        Number of the device in its chain, from 1.
    axis
        Number of the axis, from 1.
    name
        What errors call the device.
    timeout_s
        Real time in which an answer must be there.
    """

    def __init__(self, link: Link, *, device: int, axis: int, name: str, timeout_s: float) -> None:
        self.name = name
        self.checksums = False
        """Whether the device has been told to send checksums; then a message without one is never taken."""
        self._link = link
        self._device = device
        self._axis = axis
        self._timeout_s = timeout_s
        self._ids = link.ids if isinstance(link, Line) else request_ids()

    def reopen(self) -> None:
        """Begin anew on a new link. Raises `LinkLostError`."""
        self._link.reopen()

    def repeat(self, command: str, *, axis: bool = True) -> DeviceMessage:
        """Ask what may be asked twice, up to `ATTEMPTS` times.

        Raises
        ------
        NoReplyError, RejectedError, LinkLostError
        """
        for _ in range(ATTEMPTS - 1):
            try:
                return self.once(command, axis=axis)
            except UnclearError:
                continue
            except RejectedError as error:
                if error.reason != "AGAIN":
                    raise
        return self.once(command, axis=axis)

    def once(self, command: str, *, axis: bool = True) -> DeviceMessage:
        """Send a command, to the axis or to the whole device, and return what the device says to it.

        Raises
        ------
        UnclearError
            Whether the device heard the command is unknown.
        RejectedError
            It heard and refused.
        LinkLostError
            The link is gone, and what came of the command is as unknown.
        NoReplyError
            Somebody sends without pause; nothing was sent.
        """
        request = self._request(command, axis=axis)
        self._link.discard_input()
        deadline_s = time.monotonic() + self._timeout_s
        self._link.write(encode_request(request))
        reply = self._next(request, Kind.REPLY, deadline_s)
        while reply.continues:
            reply = self._continued(reply, request, deadline_s)
        if not reply.accepted:
            raise RejectedError(self.name, command, reply.data)
        return reply

    def say(self, command: str) -> None:
        """Send a command to the axis and do not wait for what comes of it. Raises `LinkLostError`."""
        self._link.write(encode_request(self._request(command, axis=True)))

    def _request(self, command: str, *, axis: bool) -> Request:
        """A command with the next id."""
        number = self._axis if axis else BROADCAST
        return Request(device=self._device, axis=number, message_id=next(self._ids), command=command)

    def _continued(self, reply: DeviceMessage, request: Request, deadline_s: float) -> DeviceMessage:
        try:
            return reply.continued_by(self._next(request, Kind.INFO, deadline_s))
        except GarbledError as error:
            raise self._unclear(request, Message("was garbled ({error})", error=error)) from error

    def _next(self, request: Request, kind: Kind, deadline_s: float) -> DeviceMessage:
        """The next message that belongs to the request."""
        while True:
            try:
                if time.monotonic() > deadline_s:
                    raise NoReplyError(
                        self.name, Message("sends other messages without pause"), Message("see what else talks there")
                    )
                line = self._link.read_line(LINE_END, deadline_s - time.monotonic())
                message = parse_message(line, checksum=self.checksums)
            except NoReplyError as error:
                raise self._unclear(
                    request, Message("did not come within {timeout_s:g} s", timeout_s=self._timeout_s)
                ) from error
            except GarbledError as error:
                raise self._unclear(request, Message("was garbled ({error})", error=error)) from error
            sender = message.device, message.axis, message.message_id
            if message.kind is kind and sender == (request.device, request.axis, request.message_id):
                return message

    def _unclear(self, request: Request, how: str) -> UnclearError:
        return UnclearError(
            self.name,
            Message("the answer to {command!r} {how}", command=request.command or "a status request", how=how),
            Message("check power, cable, device number and baud rate, and what else talks on this line"),
        )
