r"""Lines of the Zaber ASCII protocol (Zaber, ASCII Protocol Manual, firmware 7, "Message Format").

    /1 1 06 move abs 50000:B6     request: device, axis, message id, command, checksum
    @01 1 06 OK IDLE -- 0:06      reply: the same, then flag, state, warning, data
    #01 1 06 some text            info, belongs to a reply
    !01 1 IDLE --                 alert, unasked

The checksum makes the sum of all bytes between the first character and the colon, plus itself, zero modulo 256. It sees
every wrong byte but the first, and neither two bytes exchanged nor two errors that cancel; therefore the grammar here
is as narrow as the protocol allows: an info that reads like a reply or an alert is none. A reply whose text ends in
a backslash goes on in infos that begin with `cont`.
"""

import re
from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Final

from tumble.messages import Message

LINE_END: Final = b"\n"
"""Ends every line; devices send a carriage return before it."""
BROADCAST: Final = 0
"""Device number of everybody, or axis number of a whole device."""
MESSAGE_IDS: Final = 100
"""Ids run from 0 to 99."""


class GarbledError(ValueError):
    """A line is none of this protocol, or not what was sent."""


class Kind(StrEnum):
    """What a device sends."""

    REPLY = "@"
    INFO = "#"
    ALERT = "!"


@dataclass(frozen=True, kw_only=True)
class Request:
    """A command to one axis of one device, for example `Request(device=1, axis=1, message_id=6, command="home")`."""

    device: int
    axis: int
    message_id: int | None = None
    command: str = ""


@dataclass(frozen=True, kw_only=True)
class DeviceMessage:
    """What a device sends. An alert has no id; an info has neither state nor warning."""

    kind: Kind
    device: int
    axis: int
    message_id: int | None = None
    accepted: bool = True
    """False where a request was rejected; `data` then says why."""
    busy: bool = False
    """Whether the axis moves."""
    warning: str = "--"
    """The most severe warning flag, two letters; `--` for none."""
    data: str = ""
    continues: bool = False
    """More of `data` follows in an info."""

    def continued_by(self, info: "DeviceMessage") -> "DeviceMessage":
        """The message with the next part of its data. Raises `GarbledError` where the info is no such part."""
        word, _, rest = info.data.partition(" ")
        if info.kind is not Kind.INFO or word != "cont":
            raise GarbledError(Message("{data!r} does not continue a reply", data=info.data))
        return replace(self, data=f"{self.data} {rest}", continues=info.continues)


def lrc(text: bytes) -> int:
    """Longitudinal redundancy check of the bytes between the first character of a line and the colon."""
    return -sum(text) & 0xFF


def encode_request(request: Request) -> bytes:
    """The request as a line with its checksum."""
    words = [str(request.device), str(request.axis)]
    if request.message_id is not None:
        words.append(f"{request.message_id:02d}")
    if request.command:
        words.append(request.command)
    return _line("/", " ".join(words), checksum=True)


def encode_message(message: DeviceMessage, *, checksum: bool) -> bytes:
    """The message as a device writes it."""
    words = [f"{message.device:02d}", str(message.axis)]
    if message.message_id is not None:
        words.append(f"{message.message_id:02d}")
    if message.kind is Kind.REPLY:
        words.append("OK" if message.accepted else "RJ")
    if message.kind is not Kind.INFO:
        words += ["BUSY" if message.busy else "IDLE", message.warning]
    if message.data:
        words.append(message.data)
    text = " ".join(words) + ("\\" if message.continues else "")
    return _line(message.kind, text, checksum=checksum, end=b"\r\n")


def parse_request(line: bytes) -> Request:
    """Read a request as a device does: every number may be left out, and so may the checksum.

    Raises
    ------
    GarbledError
        No request, or one with a wrong checksum.
    """
    text, _ = _checked(line)
    match = _REQUEST.fullmatch(text)
    if not match:
        raise GarbledError(Message("{line!r} is no request", line=line))
    device, axis, message_id, command = match.groups()
    return Request(
        device=int(device or BROADCAST),
        axis=int(axis or BROADCAST),
        message_id=None if message_id is None else int(message_id),
        command=" ".join((command or "").split()),
    )


def parse_message(line: bytes, *, checksum: bool) -> DeviceMessage:
    """Read what a device sent.

    Parameters
    ----------
    line
        With its line end.
    checksum
        Whether the device has been told to send checksums, so that a line without one has lost it.

    Raises
    ------
    GarbledError
        Cut, changed on the way, or nothing of this protocol.
    """
    text, checked = _checked(line)
    if checksum and not checked:
        raise GarbledError(Message("{line!r} has no checksum", line=line))
    match = next((match for form in _FORMS if (match := form.fullmatch(text))), None)
    if not match:
        raise GarbledError(Message("{line!r} is no message of a device", line=line))
    part = match.groupdict()
    return DeviceMessage(
        kind=Kind(part["kind"]),
        device=int(part["device"]),
        axis=int(part["axis"]),
        message_id=int(part["id"]) if part.get("id") else None,
        accepted=part.get("flag") != "RJ",
        busy=part.get("state") == "BUSY",
        warning=part.get("warning") or "--",
        data=part["data"] or "",
        continues=bool(part["more"]),
    )


def parse_flags(data: str) -> tuple[str, ...]:
    """Read the answer to `warnings`: how many flags there are, then the flags, for example `02 FS WR`.

    Raises
    ------
    GarbledError
        Not that many, or something that is no flag.
    """
    count, *flags = data.split(" ")
    if not _COUNT.fullmatch(count) or int(count) != len(flags):
        raise GarbledError(Message("{data!r} does not hold as many flags as it says", data=data))
    if not all(_FLAG.fullmatch(flag) for flag in flags):
        raise GarbledError(Message("{data!r} holds something that is no flag", data=data))
    return tuple(flags)


_COUNT: Final = re.compile(r"\d{2}", re.ASCII)
_FLAG: Final = re.compile(r"[FWN][A-Z]", re.ASCII)
_ADDRESS = r"(?P<device>\d\d) (?P<axis>\d)"
_STATE = r"(?P<state>BUSY|IDLE) (?P<warning>--|[FWN][A-Z])"
_DATA = r"(?P<data>[!-9;-\[\]-~]+(?: [!-9;-\[\]-~]+)*)"
_FORMS: Final = tuple(
    re.compile(form + r"(?P<more>\\?)")
    for form in (
        rf"(?P<kind>@){_ADDRESS}(?: (?P<id>\d\d))? (?P<flag>OK|RJ) {_STATE} {_DATA}",
        rf"(?P<kind>!){_ADDRESS} {_STATE}(?: {_DATA})?",
        rf"(?P<kind>#){_ADDRESS}(?!(?: \d\d)? (?:OK|RJ|BUSY|IDLE) )(?: (?P<id>\d\d))?(?: {_DATA})?",
    )
)
_REQUEST: Final = re.compile(r"/ *(?:(\d{1,2})(?: +(\d)(?: +(\d\d))?)?)?(?:(?:(?<=/) *| +)([a-z][!-9;-~ ]*))? *")


def _line(first: str, text: str, *, checksum: bool, end: bytes = LINE_END) -> bytes:
    octets = text.encode("ascii")
    footer = b":%02X" % lrc(octets) if checksum else b""
    return first.encode("ascii") + octets + footer + end


def _checked(line: bytes) -> tuple[str, bool]:
    """Text of a line before the colon, and whether it had a checksum, which then was right."""
    if line[-1:] not in (b"\n", b"\r"):
        raise GarbledError(Message("{line!r} does not end", line=line))
    head, colon, footer = line.rstrip(b"\r\n").partition(b":")
    if colon and footer != b"%02X" % lrc(head[1:]):
        raise GarbledError(Message("{line!r} has a wrong checksum", line=line))
    try:
        return head.decode("ascii"), bool(colon)
    except UnicodeDecodeError as error:
        raise GarbledError(Message("{line!r} is no text", line=line)) from error
