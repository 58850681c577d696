"""The page on adding an instrument, and the driver that it shows, against a fake controller and through a whole run."""

import math
import re
from pathlib import Path

import pytest
from fakes import QUICK, FakeDaq, FakeOperator, MemorySink
from mercury_controller import MercuryController

from tumble.app.stand import load_stand
from tumble.drivers.clock import VirtualClock
from tumble.drivers.driver import Bench
from tumble.drivers.errors import DeviceError, LimitError, LinkLostError
from tumble.drivers.links.opened import Links
from tumble.drivers.protocols import Identity, Reconnectable, Stand
from tumble.drivers.tables import TITLES
from tumble.procedures.composition import compose
from tumble.procedures.engine import Engine
from tumble.procedures.events import Identified, WarningRaised
from tumble.procedures.methods.dividing_head.layout import LAYOUT
from tumble.procedures.methods.dividing_head.sweep import Sweep
from tumble.procedures.outcome import FinishReason

DOCS = Path(__file__).parents[2] / "docs"
PAGE = (DOCS / "adding-an-instrument.md").read_text("utf-8")
EXAMPLES = "".join((DOCS / "examples" / name).read_text("utf-8") for name in ("mercury.py", "mercury.toml"))
SWEEP = Sweep(kind="sweep", mount="end", step_deg=30.0, points=4)


class Mercury:
    """The head of the stand file in the page, at a fake controller."""

    def __init__(self, monkeypatch):
        self.clock = VirtualClock(0)
        self.controller = MercuryController(self.clock)
        monkeypatch.setattr(Links, "serial", lambda *_: self.controller)
        self.loaded = load_stand(DOCS / "examples" / "mercury.toml")
        bench = Bench(clock=self.clock, links=Links(), folder=self.loaded.folder, eyepiece=None)
        self.head = self.loaded.positioner_drivers["head"].connect(self.loaded.file.head, bench)

    def homed(self):
        self.head.identify()
        self.head.home()
        self.clock.sleep(5.0)
        assert self.head.status().referenced
        return self

    def run(self, on_block=lambda block: None):
        """A sweep with this head and a fake DAQ, as the engine runs it."""
        daq, sink = FakeDaq(self.clock, self.head), MemorySink()
        daq.on_acquire = lambda: on_block(daq.blocks)
        serials = {"head": self.loaded.file.head.serial}
        stand = Stand(
            name="bench-3",
            positioners={"head": self.head},
            samplers={"daq": daq},
            clock=self.clock,
            serials=serials,
            titles=TITLES,
        )
        outcome = Engine(stand, FakeOperator(daq), sink, QUICK).run(lambda: compose([SWEEP], 1, LAYOUT.ask))
        return outcome, [event.message for event in sink.of(WarningRaised)], sink


@pytest.fixture
def mercury(monkeypatch):
    return Mercury(monkeypatch)


@pytest.mark.parametrize("block", re.findall(r"```(?:python|toml)\n(.*?)```", PAGE, re.DOTALL))
def test_what_the_page_shows_is_what_is_tested(block):
    assert block in EXAMPLES


def test_it_says_who_it_is_and_is_given_its_speed(mercury):
    assert mercury.head.identify() == Identity(model="C-863.12", serial="0123456789", firmware="1.2.1")
    assert mercury.controller.heard == ["*IDN?", "VEL 1 20.000000", "ERR?"]


def test_nothing_is_sent_before_it_is_identified(mercury):
    assert mercury.controller.heard == []
    assert isinstance(mercury.head, Reconnectable)


def test_it_is_moving_and_knows_no_angle_while_it_looks_for_its_reference(mercury):
    assert not mercury.head.status().referenced
    mercury.head.home()
    status = mercury.head.status()
    assert (status.moving, status.referenced, math.isnan(status.angle_deg)) == (True, False, True)


def test_it_moves_and_stands(mercury):
    head = mercury.homed().head
    head.start_move(10.0)
    assert head.status().moving
    mercury.clock.sleep(1.0)
    status = head.status()
    assert (status.angle_deg, status.moving, status.referenced) == (10.0, False, True)


@pytest.mark.parametrize("angle_deg", [-180.1, 760.1, math.nan, math.inf])
def test_nothing_is_sent_outside_the_limits(mercury, angle_deg):
    heard = list(mercury.homed().controller.heard)
    with pytest.raises(LimitError, match="outside the limits -180 to 760 deg"):
        mercury.head.start_move(angle_deg)
    assert mercury.controller.heard == heard


def test_it_stops_where_it_is(mercury):
    mercury.homed().head.start_move(90.0)
    mercury.clock.sleep(1.0)
    mercury.head.stop()
    status = mercury.head.status()
    assert (status.angle_deg, status.moving) == (20.0, False)


def test_a_move_that_is_refused_is_told(mercury):
    mercury.head.identify()
    with pytest.raises(DeviceError, match=r"refuses to move without reference or servo \(error 5\); resume the run"):
        mercury.head.start_move(10.0)


def test_a_fault_is_told_once_and_the_position_read_all_the_same(mercury):
    mercury.homed().controller.blocked_at_deg = 5.0
    mercury.head.start_move(10.0)
    mercury.clock.sleep(1.0)
    with pytest.raises(DeviceError, match="does not follow its set-point"):
        mercury.head.status()
    status = mercury.head.status()
    assert (status.angle_deg, status.moving, status.referenced) == (5.0, False, False)


@pytest.mark.parametrize("trouble", [{"mute": 1}, {"garbles": True}])
def test_an_answer_that_cannot_be_had_is_a_lost_link(mercury, trouble):
    vars(mercury.homed().controller).update(trouble)
    with pytest.raises(LinkLostError):
        mercury.head.status()


def test_a_run_identifies_it_and_homes_it_first(mercury):
    outcome, warnings, sink = mercury.run()
    assert outcome.reason is FinishReason.COMPLETED
    assert [point.positions_deg["head"] for point in outcome.points] == [0.0, 30.0, 60.0, 90.0]
    assert warnings == ["dividing head: has no reference; it is homed"]
    assert [each.model for each in sink.of(Identified)] == ["C-863.12", "fake DAQ"]


def test_a_run_goes_on_after_a_loss_of_power(mercury):
    blocks = []

    def lose_power_once(block):
        blocks.append(block)
        if len(blocks) == 5:
            mercury.controller.switch_on()

    outcome, warnings, _ = mercury.run(lose_power_once)
    assert outcome.reason is FinishReason.COMPLETED
    assert [point.positions_deg["head"] for point in outcome.points] == [0.0, 30.0, 60.0, 90.0]
    assert any("has lost its reference" in warning for warning in warnings)


def test_a_run_goes_on_after_a_lost_answer_with_everything_anew(mercury):
    mercury.controller.mute_from = "MOV 1 60.000000"
    outcome, warnings, _ = mercury.run()
    assert outcome.reason is FinishReason.COMPLETED
    assert [point.positions_deg["head"] for point in outcome.points] == [0.0, 30.0, 60.0, 90.0]
    assert mercury.controller.reopened == 1
    assert mercury.controller.heard.count("FRF 1") == 2
    assert any("is back after" in warning for warning in warnings)


def test_a_run_ends_at_a_standstill_where_the_stage_is_blocked(mercury):
    mercury.controller.blocked_at_deg = 45.0
    outcome, _, _ = mercury.run()
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert outcome.at_standstill
    assert "does not follow its set-point" in outcome.message
    assert [point.positions_deg["head"] for point in outcome.points] == [0.0, 30.0]
