"""A lost link in a run is told once."""

import pytest
from window_driver import Driver

from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.drivers.simulated.head import SimulatedHead

LOST = DeviceError("dividing head", "does not answer", "check its cable, then resume the run")


@pytest.fixture
def driver(lent_driver) -> Driver:
    """A window that was lent."""
    return lent_driver


def fail(*_):
    raise LOST


def test_a_stand_that_is_lost_in_a_run_is_left_and_that_is_told_once(driver, long, monkeypatch):
    acquire, calls = SimulatedDaq.acquire, []

    def lost_with_all(*arguments):
        calls.append(arguments)
        if len(calls) == 8:
            for name in ("status", "stop", "home"):
                monkeypatch.setattr(SimulatedHead, name, fail)
            raise LOST
        return acquire(*arguments)

    monkeypatch.setattr(SimulatedDaq, "acquire", lost_with_all)
    driver.start(long)
    driver.wait_for_end()
    assert not driver.window.worker.session.is_connected
    assert len(driver.complaints) == 1
    assert driver.complaints[0].startswith("dividing head: does not answer")
    assert "2 complete points kept" in driver.complaints[0]
