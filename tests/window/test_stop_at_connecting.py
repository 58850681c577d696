"""Whoever stops is heard while a stand is connected, however long a name server takes to say where it is."""

import socket
from threading import Event

import pytest

from tumble.app.stand import load_stand
from tumble.app.wiring import Attendant, obliging_operator
from tumble.procedures.axes import look_away
from tumble.procedures.errors import StopRequestedError
from tumble.window.work.session import StandSession

STAND = """\
name = "far away"

[site]
latitude_deg = 50.45
height_m = 180.0

[head]
driver = "zaber"
url = "socket://bench-7:7001"
limits_deg = [-180.0, 760.0]
steps_per_deg = 1000.0

[daq]
driver = "scpi"
url = "socket://bench-7:7002"
"""


class Slow:
    """A name server that is silent at one of its questions, and knows of nobody at any other."""

    def __init__(self, silent_at):
        self._left, self._silent, self.answers = silent_at, Event(), Event()

    def __call__(self, *_, **__):
        self._left -= 1
        if self._left == 0:
            self._silent.set()
            self.answers.wait(60)
        raise socket.gaierror("unknown")

    def stop(self):
        """Stop once it is silent."""
        if self._silent.is_set():
            raise StopRequestedError("stopped")


@pytest.mark.parametrize("question", [1, 2, 3])
def test_a_stop_is_heard_at_every_question_to_a_name_server(tmp_path, monkeypatch, question):
    server = Slow(question)
    monkeypatch.setattr(socket, "getaddrinfo", server)
    (tmp_path / "stand.toml").write_text(STAND, "utf-8")
    session = StandSession(load_stand(tmp_path / "stand.toml"), look_away)
    with pytest.raises(StopRequestedError):
        session.connect(Attendant(operator=obliging_operator), check=server.stop)
    assert not server.answers.is_set()
    assert not session.is_connected
    server.answers.set()
