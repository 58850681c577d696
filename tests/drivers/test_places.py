import socket
import sys
from threading import Event

import pytest

from tumble.drivers.links.places import one_name


@pytest.mark.parametrize(
    ("address", "same"),
    [
        ("socket://localhost:7001", "socket://127.0.0.1:7001"),
        ("socket://[::1]:7001", "socket://127.0.0.1:7001"),
        ("socket://127.0.0.1:7001?logging=debug", "socket://127.0.0.1:7001"),
        ("rfc2217://LOCALHOST:7001", "socket://127.0.0.1:7001"),
        ("socketcand:can0?port=7003&host=localhost", "socketcand:can0?host=127.0.0.1&port=7003"),
        ("socketcand:can0?host=127.0.0.1&port=7003&tcp_tune=1", "socketcand:can0?host=127.0.0.1&port=7003"),
        ("slcan:COM3?bitrate=500000", "slcan:COM3"),
        ("COM7", "COM7"),
        ("socket://127.0.0.1:99999", "socket://127.0.0.1:99999"),
    ],
)
def test_a_place_has_one_name_however_it_is_written(address, same):
    assert one_name(address) == same


@pytest.mark.parametrize(
    ("one", "other"),
    [
        ("socket://127.0.0.1:7001", "socket://127.0.0.1:7002"),
        ("socketcand:can0?host=127.0.0.1&port=7003", "socketcand:can1?host=127.0.0.1&port=7003"),
        ("socketcan:can0", "socketcan:can1"),
    ],
)
def test_two_places_have_two_names(one, other):
    assert one_name(one) != one_name(other)


def test_a_host_that_nobody_knows_keeps_its_name(monkeypatch):
    def unknown(*_):
        raise socket.gaierror("unknown")

    monkeypatch.setattr(socket, "getaddrinfo", unknown)
    assert one_name("socket://Bench-7:1") == "socket://bench-7:1"


@pytest.mark.parametrize("address", ["socket://bench-7:1", "socketcand:can0?host=bench-7&port=2"])
def test_nobody_waits_for_a_name_server_that_is_silent(monkeypatch, address):
    class StoppedError(Exception):
        """Somebody stops."""

    def stop():
        raise StoppedError

    silence = Event()
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_: silence.wait(60) and [])
    with pytest.raises(StoppedError):
        one_name(address, stop)
    silence.set()


@pytest.mark.skipif(sys.platform == "win32", reason="ports have no second names in a folder on Windows")
def test_a_link_to_a_port_is_that_port(tmp_path):
    (tmp_path / "ttyUSB0").touch()
    (tmp_path / "by-id").symlink_to(tmp_path / "ttyUSB0")
    assert one_name(f"{tmp_path}/by-id") == f"{tmp_path}/ttyUSB0"
    assert one_name(f"slcan:{tmp_path}/by-id") == f"slcan:{tmp_path}/ttyUSB0"


@pytest.mark.parametrize(("name", "same"), [("com3", "COM3"), (r"\\.\COM12", "COM12")])
def test_a_port_has_one_name_on_windows(monkeypatch, name, same):
    monkeypatch.setattr(sys, "platform", "win32")
    assert one_name(name) == same
