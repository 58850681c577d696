"""One name for every place at which an instrument is found, in however many ways it can be written."""

import ipaddress
import os
import socket
import sys
from contextlib import suppress
from typing import Final
from urllib.parse import urlsplit

from drivers.links.can_address import CanAddress

LOOPBACK: Final = "127.0.0.1"
_NETWORKED: Final = ("socket", "rfc2217")


def one_name(address: str) -> str:
    """The name that two addresses share where they are the same port of the same computer, or the same CAN bus.

    Parameters
    ----------
    address
        A port name, a pyserial URL, or a CAN bus as `CanAddress` has it.
    """
    if "://" in address:
        return _networked(address)
    if address.startswith("/") or ":" not in address:
        return _port(address)
    try:
        bus = CanAddress.from_url(address)
    except ValueError:
        return address
    host, port = bus.options.get("host", ""), bus.options.get("port", "")
    server = f"?host={one_host(str(host))}&port={port}" if host else ""
    return f"{bus.interface}:{_port(bus.channel)}{server}"


def one_host(host: str) -> str:
    """Number of a host by its name or number, every loopback being 127.0.0.1; the name where nobody knows it."""
    with suppress(OSError, UnicodeError):
        found = {str(entry[4][0]).partition("%")[0] for entry in socket.getaddrinfo(host, None)}
        if any(_is_here(number) for number in found):
            return LOOPBACK
        return min(found)
    return host.casefold()


def _is_here(number: str) -> bool:
    known = ipaddress.ip_address(number)
    return known.is_loopback or known.is_unspecified


def _networked(url: str) -> str:
    """`socket://HOST:PORT`, whatever is spoken there."""
    with suppress(ValueError):
        place = urlsplit(url)
        if place.scheme in _NETWORKED and place.hostname:
            return f"socket://{one_host(place.hostname)}:{place.port}"
    return url


def _port(name: str) -> str:
    """A port has several names: through links in a folder, or written in two ways on Windows."""
    if sys.platform == "win32":
        port = name.removeprefix("\\\\.\\").upper()
        return port if port.startswith("COM") else name
    return os.path.realpath(name) if name.startswith("/") else name
