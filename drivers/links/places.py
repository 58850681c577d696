"""One name for every place at which an instrument is found, in however many ways it can be written."""

import ipaddress
import os
import socket
import sys
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from typing import Final
from urllib.parse import urlsplit

from tumble.drivers.links.can_address import CanAddress
from tumble.drivers.links.opening import opened_unless_stopped
from tumble.messages import Message

LOOPBACK: Final = "127.0.0.1"
_NETWORKED: Final = ("socket", "rfc2217")
_SCHEMES: Final = (*_NETWORKED, "alt", "cp2110", "hwgrep", "loop", "spy")
"""What pyserial opens by a URL (its documentation, "URL Handlers")."""
_PORTS: Final = range(65536)
"""0 among them, which an emulated stand takes for any that is free."""
_OF_SERVERS: Final = ("host", "port", "tcp_tune")
"""Options of a bus behind a server; python-can's `tcp_tune` is always on here."""


def one_name(address: str, check: Callable[[], object] = lambda: None) -> str:
    """The name that two addresses share where they are the same port of the same computer, or the same CAN bus.

    Parameters
    ----------
    address
        A port name, a pyserial URL, or a CAN bus as `CanAddress` has it.
    check
        Called many times a second while the number of a host is looked up; what it raises breaks that off.
    """
    if "://" in address:
        return _networked(address, check)
    if address.startswith("/") or ":" not in address:
        return _port(address)
    try:
        bus = CanAddress.from_url(address)
    except ValueError:
        return address
    host, port = bus.options.get("host", ""), bus.options.get("port", "")
    server = f"?host={one_host(str(host), check)}&port={port}" if host else ""
    return f"{bus.interface}:{_port(bus.channel)}{server}"


def check_network(url: str) -> None:
    """Make sure that a URL of a network port names host and port. Raises `ValueError` with what is wrong with it."""
    if not url.casefold().startswith(tuple(f"{scheme}://" for scheme in _NETWORKED)):
        return
    host = port = None
    with suppress(ValueError):
        place = urlsplit(url)
        host, port = place.hostname, place.port
    if not host or port not in _PORTS:
        raise ValueError(
            Message(
                "{url!r} names no host and port; write such as socket://127.0.0.1:7001, with a port to 65535", url=url
            )
        )


def check_scheme(url: str) -> None:
    """Make sure that pyserial knows what to open. Raises `ValueError` with what is wrong with the URL."""
    scheme, is_url, _ = url.partition("://")
    if is_url and scheme.casefold() not in _SCHEMES:
        known = ", ".join(f"{known}://" for known in _SCHEMES)
        raise ValueError(
            Message(
                "{url!r} begins with {scheme}://, and a serial line with a port name or {known}",
                url=url,
                scheme=scheme,
                known=known,
            )
        )


def check_server(bus: CanAddress) -> None:
    """Make sure that a bus behind a server names it, and nothing else. Raises `ValueError` with what is wrong."""
    if bus.interface != "socketcand":
        return
    if not (bus.options.get("host") and bus.options.get("port") in _PORTS):
        raise ValueError(
            Message(
                "{url!r} names no server; write such as socketcand:can0?host=127.0.0.1&port=29536, a port to 65535",
                url=bus.url,
            )
        )
    if unknown := [name for name in bus.options if name not in _OF_SERVERS]:
        raise ValueError(
            Message(
                "{url!r}: socketcand has no option {unknown}, only {known}; leave it out (the bit rate "
                "is set at the server)",
                url=bus.url,
                unknown=", ".join(unknown),
                known=", ".join(_OF_SERVERS),
            )
        )


def one_host(host: str, check: Callable[[], object] = lambda: None) -> str:
    """Number of a host by its name or number, every loopback being 127.0.0.1; the name where nobody knows it.

    `check` as of `one_name`.
    """
    with suppress(OSError, UnicodeError):
        entries = opened_unless_stopped(partial(socket.getaddrinfo, host, None), check, lambda late: late.clear(), host)
        found = {str(entry[4][0]).partition("%")[0] for entry in entries}
        if any(_is_here(number) for number in found):
            return LOOPBACK
        return min(found)
    return host.casefold()


def _is_here(number: str) -> bool:
    known = ipaddress.ip_address(number)
    return known.is_loopback or known.is_unspecified


def _networked(url: str, check: Callable[[], object]) -> str:
    """`socket://HOST:PORT`, whatever is spoken there."""
    with suppress(ValueError):
        place = urlsplit(url)
        if place.scheme in _NETWORKED and place.hostname:
            return f"socket://{one_host(place.hostname, check)}:{place.port}"
    return url


def _port(name: str) -> str:
    """A port has several names: through links in a folder, or written in two ways on Windows."""
    if sys.platform == "win32":
        port = name.removeprefix("\\\\.\\").upper()
        return port if port.startswith("COM") else name
    return os.path.realpath(name) if name.startswith("/") else name
