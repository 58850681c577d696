"""Whoever stops is heard while a connection is opened that nobody answers, and nothing of it stays open."""

import socket
import threading
from threading import Event

import numpy as np
import pytest
from somebody_stops import Stop, StoppedError

from tumble.drivers.chamber.modbus import ModbusChamber
from tumble.drivers.chamber.table import ModbusChamberTable
from tumble.drivers.errors import LinkLostError
from tumble.drivers.links.can_address import CanAddress
from tumble.drivers.links.can_link import CanLink
from tumble.drivers.links.opened import Links
from tumble.drivers.links.opening import opened_unless_stopped
from tumble.drivers.links.serial_link import SerialLink
from tumble.drivers.tables import OnSerialLine


def stop():
    raise StoppedError


def test_what_is_there_at_once_is_returned():
    assert opened_unless_stopped(lambda: "port", lambda: None, print, "here") == "port"


def test_what_goes_wrong_is_raised_where_it_is_waited_for():
    with pytest.raises(ZeroDivisionError):
        opened_unless_stopped(lambda: 1 / 0, lambda: None, print, "here")


def test_what_is_there_only_after_the_stop_is_closed():
    answers, closed, left = Event(), [], Event()

    def late():
        answers.wait()
        return "port"

    def close(port):
        closed.append(port)
        left.set()

    with pytest.raises(StoppedError):
        opened_unless_stopped(late, stop, close, "here")
    assert closed == []
    answers.set()
    assert left.wait(60)
    assert closed == ["port"]


def test_what_fails_only_after_the_stop_fails_in_silence(caplog):
    answers, closed = Event(), []

    def late():
        answers.wait()
        raise LinkLostError("stage", "is away", "look for it")

    with pytest.raises(StoppedError):
        opened_unless_stopped(late, stop, closed.append, "here")
    (thread,) = [each for each in threading.enumerate() if each.name == "opening here"]
    answers.set()
    thread.join(60.0)
    assert closed == []
    assert caplog.records == []


@pytest.fixture
def full():
    """A place where a connection is neither taken nor refused: the queue before its door is full, as Linux has it."""
    with socket.create_server(("127.0.0.1", 0), backlog=0) as server:
        queued = [socket.socket() for _ in range(4)]
        for one in queued:
            one.setblocking(False)
            one.connect_ex(server.getsockname())
        yield server.getsockname()[1]
        for one in queued:
            one.close()


@pytest.fixture
def silent():
    """A place where a connection is taken and nothing is ever said."""
    with socket.create_server(("127.0.0.1", 0)) as server:
        yield server.getsockname()[1]


def chamber(port, check):
    table = {
        "driver": "modbus",
        "url": f"socket://127.0.0.1:{port}",
        "limits_degC": [0.0, 50.0],
        "safe_degC": 20.0,
        "timeout_s": 60.0,
        "registers": {"actual": {"input": 1}, "setpoint": {"holding": 2}},
    }
    return ModbusChamber(ModbusChamberTable.model_validate(table), check)


QUEUING = {
    "line": lambda port, check: SerialLink(f"socket://127.0.0.1:{port}", check_opening=check),
    "server of ports": lambda port, check: SerialLink(f"rfc2217://127.0.0.1:{port}", check_opening=check),
    "bus": lambda port, check: CanLink(CanAddress.from_url(f"socketcand:can0?host=127.0.0.1&port={port}"), check),
    "chamber": lambda port, check: chamber(port, check).reconnect(),
}


@pytest.mark.parametrize("kind", QUEUING)
def test_nobody_waits_at_a_door_that_does_not_open(full, kind):
    wish = Stop()
    with pytest.raises(StoppedError):
        QUEUING[kind](full, wish)
    assert max(np.diff(wish.moments_s)) < 0.4


def test_nobody_waits_for_a_server_that_does_not_greet(silent):
    wish = Stop()
    with pytest.raises(StoppedError):
        QUEUING["bus"](silent, wish)
    assert max(np.diff(wish.moments_s)) < 0.4


def test_a_line_whose_opening_was_stopped_is_closed_and_can_be_opened_again(silent, monkeypatch):
    link = SerialLink(f"socket://127.0.0.1:{silent}")
    monkeypatch.setattr(link, "_check_opening", stop)
    monkeypatch.setattr("tumble.drivers.links.serial_link.serial.serial_for_url", lambda *_, **__: Event().wait(0.2))
    with pytest.raises(StoppedError):
        link.reopen()
    with pytest.raises(LinkLostError):
        link.write(b"/\n")
    monkeypatch.undo()
    link.reopen()
    link.write(b"/\n")
    link.close()


def test_the_links_of_a_stand_heed_the_stop_while_they_are_opened(full):
    wish = Stop()
    with pytest.raises(StoppedError):
        Links(wish).serial(OnSerialLine(driver="zaber", url=f"socket://127.0.0.1:{full}"), "stage")


def test_the_links_of_a_stand_heed_the_stop_while_a_name_is_looked_up(monkeypatch):
    silence = Event()
    monkeypatch.setattr(socket, "getaddrinfo", lambda *_: silence.wait(60) and [])
    with pytest.raises(StoppedError):
        Links(stop).name_of("socket://bench-7:1")
    silence.set()
