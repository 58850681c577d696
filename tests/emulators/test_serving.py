import socket
import sys
import time
from functools import partial
from threading import Event

import pytest

from tumble.drivers.errors import LinkLostError, NoReplyError
from tumble.drivers.links import SerialLink
from tumble.emulators import ports, serving
from tumble.emulators.faults import Faults, FaultScript
from tumble.emulators.ports import TcpChannel
from tumble.emulators.serving import Server, serve_pty, serve_tcp

on_posix = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pseudo-terminals")


class Counter:
    """Counts commands over all clients, like a device whose state outlives them."""

    heard = 0

    def received(self, data):
        Counter.heard += 1
        return b"%d %s\n" % (Counter.heard, data.strip())

    def due(self):
        return b""


@pytest.fixture(autouse=True)
def _from_zero():
    Counter.heard = 0


def dropping(**fault):
    return Faults(FaultScript.model_validate({"fault": [{"device": "head", "kind": "drop", **fault}]}))


def ask(link, command):
    link.write(command + b"\n")
    return link.read_line(b"\n", 2.0)


def reopened(link):
    """Open the link again as soon as it is there, within five seconds."""
    deadline_s = time.monotonic() + 5.0
    while True:
        try:
            return link.reopen()
        except LinkLostError:
            if time.monotonic() > deadline_s:
                raise


SERVERS = [pytest.param(serve_tcp, id="tcp"), pytest.param(serve_pty, id="pty", marks=on_posix)]


@pytest.mark.parametrize("serve", SERVERS)
def test_a_client_leaves_and_another_comes(serve):
    with serve(Counter) as server:
        answers = []
        for name in (b"first", b"second"):
            link = SerialLink(server.url)
            answers.append(ask(link, name))
            link.close()
    assert answers == [b"1 first\n", b"2 second\n"]


@pytest.mark.parametrize("serve", SERVERS)
def test_a_link_that_vanishes_is_lost_and_returns_under_the_same_name(serve):
    with serve(Counter, faults=dropping(at={"command": 2}, lasts_s=0.1)) as server:
        link = SerialLink(server.url)
        assert ask(link, b"first") == b"1 first\n"
        with pytest.raises(LinkLostError, match="is lost"):
            ask(link, b"second")
        reopened(link)
        assert ask(link, b"third") == b"3 third\n"
        link.close()


@pytest.mark.parametrize("serve", SERVERS)
def test_a_server_that_is_closed_is_gone(serve):
    server = serve(Counter)
    link = SerialLink(server.url)
    server.close()
    with pytest.raises(LinkLostError):
        for _ in range(3):  # the first write into a closed socket succeeds
            ask(link, b"anybody")
    with pytest.raises(LinkLostError, match="cannot be reached"):
        link.reopen()


def test_a_link_may_vanish_while_nobody_talks():
    with serve_tcp(Counter, faults=dropping(at={"time_s": 0.05}, lasts_s=0.1)) as server:
        link = SerialLink(server.url)
        with pytest.raises(LinkLostError):
            link.read_line(b"\n", 2.0)


def test_several_clients_are_served_at_a_time():
    with serve_tcp(Counter) as server:
        links = [SerialLink(server.url) for _ in range(3)]
        answers = [ask(link, b"x") for link in links]
        for link in links:
            link.close()
    assert answers == [b"1 x\n", b"2 x\n", b"3 x\n"]


def test_a_port_that_is_taken_is_refused():
    with serve_tcp(Counter) as server, pytest.raises(OSError, match=r"in use|permission|forbidden"):
        serve_tcp(Counter, port=server.port)


def test_an_instrument_that_does_not_answer_is_told_from_a_lost_link():
    with serve_tcp(Counter) as server:
        link = SerialLink(server.url, device="stage")
        with pytest.raises(NoReplyError, match="stage: gave no answer"):
            link.read_line(b"\n", 0.05)
        assert ask(link, b"still there") == b"1 still there\n"
        link.close()


def test_input_is_thrown_away_when_told():
    with serve_tcp(Counter) as server:
        link = SerialLink(server.url)
        link.write(b"a\nb\n")
        assert link.read_line(b"\n", 2.0) == b"1 a\n"
        link.discard_input()
        assert ask(link, b"c") == b"3 c\n"
        link.close()


def test_a_closed_link_is_a_lost_link():
    with serve_tcp(Counter) as server:
        link = SerialLink(server.url)
        link.close()
        with pytest.raises(LinkLostError, match="the port is closed"):
            link.write(b"x\n")


def test_a_terminal_has_no_port_number():
    if sys.platform == "win32":
        with pytest.raises(OSError, match="no pseudo-terminals"):
            serve_pty(Counter)
        return
    with serve_pty(Counter) as server, pytest.raises(AttributeError, match="no TCP port"):
        partial(getattr, server, "port")()


@on_posix
def test_a_port_that_another_program_has_is_refused():
    with serve_pty(Counter) as server:
        link = SerialLink(server.url)
        with pytest.raises(LinkLostError, match="cannot be reached"):
            SerialLink(server.url)
        link.close()
        SerialLink(server.url).close()


def test_a_client_that_never_reads_is_dropped(monkeypatch):
    monkeypatch.setattr(ports, "_WRITE_TIMEOUT_S", 0.02)
    with socket.create_server(("127.0.0.1", 0)) as listening, socket.create_connection(listening.getsockname()):
        connection = listening.accept()[0]
        with connection:
            channel = TcpChannel(connection)
            assert channel.read() == b""
            channel.write(bytes(1 << 26))
            assert channel.read() is None


class TakenPort:
    """A port that somebody else has when it is to be opened for the second and third time."""

    url = "socket://nowhere:1"

    def __init__(self):
        self.attempts = 0
        self.back = Event()

    def open(self):
        self.attempts += 1
        if self.attempts in (2, 3):
            raise OSError("address already in use")
        if self.attempts == 4:
            self.back.set()

    def wait(self, _timeout_s):
        return []

    def close(self):
        pass


def test_a_server_comes_back_once_its_port_is_free(monkeypatch):
    monkeypatch.setattr(serving, "REOPEN_S", 0.001)
    port = TakenPort()
    with Server(Counter, port, dropping(at={"time_s": 0.0}, lasts_s=0.001), b"\n"):
        assert port.back.wait(5.0)
