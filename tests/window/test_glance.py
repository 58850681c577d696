"""What the samplers of a stand read while nothing else goes on."""

import numpy as np
import pytest

from tumble.app.stand import load_stand
from tumble.app.wiring import Attendant, obliging_operator
from tumble.drivers.errors import DeviceError, NoReplyError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.drivers.simulated.head import SimulatedHead
from tumble.procedures.axes import look_away
from tumble.procedures.errors import StopRequestedError
from tumble.window.work.session import StandSession

AT_ONCE = Attendant(operator=obliging_operator)


def unheard():
    """Nobody wants the look to end."""


def session_of(method):
    session = StandSession(load_stand(None, method), look_away)
    session.connect(AT_ONCE)
    return session


def recorded(method, watched):
    """What every sampler gives at three angles, with and without glances between."""
    session, blocks = session_of(method), []
    stand = session.connected.stand
    for angle_deg in (0.0, 5.0, 10.0):
        for positioner in stand.positioners.values():
            positioner.start_move(angle_deg)
        stand.clock.sleep(20.0)
        for _ in range(watched):
            assert session.readings(unheard)
        blocks += [sampler.acquire(8, 100.0) for sampler in stand.samplers.values()]
    return blocks


@pytest.mark.parametrize("method", ["dividing_head", "triad", "vibration"])
def test_a_simulated_run_is_the_same_whether_it_was_watched_or_not(method):
    for watched, unwatched in zip(recorded(method, 3), recorded(method, 0), strict=True):
        for name, values in watched.channels.items():
            np.testing.assert_array_equal(values, unwatched.channels[name])
        assert watched.device_time_s == unwatched.device_time_s
        assert watched.temperature_degc == unwatched.temperature_degc


def failing(monkeypatch, error):
    """Have the meter answer with an error; a list of how often it was asked."""
    asked = []

    def fail(*_):
        asked.append(True)
        raise error

    monkeypatch.setattr(SimulatedDaq, "acquire", fail)
    return asked


def test_a_meter_that_does_not_answer_is_not_looked_at_again(monkeypatch):
    session = session_of("dividing_head")
    asked = failing(monkeypatch, NoReplyError("voltmeter", "does not answer", "look at it"))
    assert [session.readings(unheard), session.readings(unheard)] == [{"daq": None}, {}]
    assert len(asked) == 1


def test_it_is_looked_at_again_once_the_stand_is_connected_anew(monkeypatch):
    session = session_of("dividing_head")
    failing(monkeypatch, NoReplyError("voltmeter", "does not answer", "look at it"))
    assert session.readings(unheard) == {"daq": None}
    monkeypatch.undo()
    session.disconnect()
    session.connect(AT_ONCE)
    assert session.readings(unheard)["daq"] is not None


def test_a_meter_that_answers_something_else_has_no_value_and_is_asked_again(monkeypatch):
    session = session_of("dividing_head")
    asked = failing(monkeypatch, DeviceError("voltmeter", "answers something else", "look at it"))
    assert [session.readings(unheard), session.readings(unheard)] == [{"daq": None}, {"daq": None}]
    assert len(asked) == 2


def test_a_look_ends_where_somebody_wants_that_and_the_meter_is_looked_at_again(monkeypatch):
    session = session_of("dividing_head")

    def wait_for_an_answer(*_):
        session.connected.stand.attention.check()
        raise AssertionError("the wait went on")

    def stop():
        raise StopRequestedError("stopped")

    monkeypatch.setattr(SimulatedDaq, "acquire", wait_for_an_answer)
    with pytest.raises(StopRequestedError):
        session.readings(stop)
    monkeypatch.undo()
    assert session.readings(unheard)["daq"] is not None


def test_a_stop_while_a_meter_is_asked_who_it_is_brings_the_head_to_rest(monkeypatch):
    stops = []
    monkeypatch.setattr(SimulatedHead, "stop", lambda _: stops.append("told to stop"))

    def stop(*_):
        raise StopRequestedError("stopped")

    monkeypatch.setattr(SimulatedDaq, "identify", stop)
    session = StandSession(load_stand(), look_away)
    with pytest.raises(StopRequestedError):
        session.connect(AT_ONCE, check=stop)
    assert stops
    assert not session.is_connected
