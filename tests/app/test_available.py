from dataclasses import replace

import numpy as np
import pytest
from app_jobs import STAND

from tumble.app.acting import AtStand, DeclinedError, prepare
from tumble.app.exits import JobError
from tumble.app.methods.dividing_head.experiments import (
    NO_THERMOMETER,
    NOBODY_WARMS,
    available,
    offered,
    programme_of,
)
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.procedures.operator import Answer

TABLE = Observations(row=np.array([1]), angle_deg=np.zeros(1), voltage_v=np.ones(1), temperature_degc=np.full(1, 23.0))
BACK = next(probe for probe in PROBES if probe.programme == "probe-back")
WARM = next(probe for probe in PROBES if probe.programme == "probe-warm")
LATER = offered(next(probe for probe in PROBES if probe.programme == "probe-later"))


@pytest.fixture
def stand(write):
    """Loads a stand whose head says something more."""

    def load(head=""):
        return load_stand(write("s.toml", STAND.replace("[daq]\n", f"{head}\n[daq]\n")))

    return load


def test_a_stand_without_limits_that_matter_runs_every_probe_as_it_comes_along(stand):
    found = available(stand(), TABLE, attended=True)
    assert [probe.programme for probe in found.probes] == [probe.programme for probe in PROBES]
    assert {probe.points for probe in found.probes} == {80}
    assert dict(found.refused) == {}


def test_nobody_warms_a_unit_at_a_stand_that_nobody_attends(stand):
    assert available(stand(), TABLE, attended=False).refused["probe-warm"][1] == NOBODY_WARMS


def test_without_a_temperature_there_is_nothing_to_warm_for(stand):
    table = Observations(row=TABLE.row, angle_deg=TABLE.angle_deg, voltage_v=TABLE.voltage_v)
    assert available(stand(), table, attended=True).refused["probe-warm"][1] == NO_THERMOMETER


def test_a_mount_that_the_seat_does_not_allow_is_refused_with_the_reason(stand):
    found = available(stand('mounts = ["face-up", "edge"]'), TABLE, attended=True)
    assert {probe.mount for probe in found.probes} == {"face-up", "edge"}
    assert "the sweep needs the mount end, and the seat allows face-up, edge only" in found.refused["probe-end"][1]


@pytest.mark.parametrize(
    ("head", "first_deg", "points"),
    [("cable_turns = 0.5", -180.0, 73), ("cable_turns = 0.25", -90.0, 37), ("cable_turns = 2.0", 0.0, 80)],
)
def test_a_probe_is_as_long_as_the_head_may_turn(stand, head, first_deg, points):
    probe = available(stand(head), TABLE, attended=True).offer("probe-back").probe
    assert (probe.start_deg, probe.points) == (first_deg, points)


def test_where_there_is_hardly_any_room_there_is_no_probe(stand):
    found = available(stand("cable_turns = 0.1"), TABLE, attended=True)
    assert found.probes == ()
    assert found.refused["probe-back"][1] == "the head may turn from -36 to 36 deg, which leaves no room for it"


def test_a_mounting_takes_as_long_as_the_stand_says(stand):
    slow, quick = (available(stand(f"mounting_s = {each}"), TABLE, attended=True) for each in (600.0, 0.0))
    assert slow.offer("probe-back").probe.stand_time_s - quick.offer("probe-back").probe.stand_time_s == pytest.approx(
        600.0
    )


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.programme)
def test_the_programme_of_a_shortened_probe_takes_its_dwells(probe):
    short = probe.between(-90.0, 90.0)
    (sweep,) = programme_of(short).procedures
    taken = [sweep.angles_deg(number) for number in range(1, probe.realisations + 1)]
    assert np.array(taken).tolist() == short.angles_deg.tolist()
    assert programme_of(short).realisations == probe.realisations


class Person:
    """Says one thing, whatever is asked."""

    def __init__(self, confirmed):
        self.asked = []
        self.answer = Answer(text="yes" if confirmed else "no", confirmed=confirmed)

    def ask(self, ask):
        self.asked.append(ask.prompt)

    def ask_reading(self, prompt):
        self.asked.append(prompt)

    def poll(self):
        return self.answer


def at_stand(stand, folder, operator):
    loaded = stand()
    connected = replace(connect(loaded), operator=operator)
    return AtStand(stand=loaded, connected=connected, serial_number="A", folder=folder)


def test_who_is_asked_to_warm_the_unit_may_decline(stand, tmp_path):
    person = Person(confirmed=False)
    with pytest.raises(DeclinedError, match="does not warm the unit") as raised:
        prepare(at_stand(stand, tmp_path, person), offered(WARM))
    assert (raised.value.condition, raised.value.value) == ("temperature", "warm")
    assert person.asked[0].startswith("Bring the unit to a temperature about 10 K higher")


def test_what_shall_be_measured_later_waits_for_that_long(stand, tmp_path):
    at = at_stand(stand, tmp_path, Person(confirmed=True))
    began_s = at.connected.stand.clock.monotonic_s()
    prepare(at, LATER)
    assert at.connected.stand.clock.monotonic_s() - began_s == pytest.approx(7200.0)


def test_a_wait_can_be_stopped_before_anything_moves(stand, tmp_path):
    at = at_stand(stand, tmp_path, Person(confirmed=True))
    with pytest.raises(JobError, match="stopped while waiting; nothing moved") as raised:
        prepare(at, LATER, stopped=lambda: True)
    assert raised.value.status == 4
