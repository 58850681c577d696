"""The makers' own client on the emulated stage, in native units; `identify` is never called, as it asks a server."""

import pytest
from zaber_motion import MotionLibException
from zaber_motion.ascii import Connection, WarningFlags

from tumble.drivers.simulated import HeadOptions, Simulated, build
from tumble.emulators.faults import At, Fault, Faults, FaultScript
from tumble.emulators.serving import serve_tcp
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld
from tumble.emulators.zaber import EmulatedZaber

STALL = Fault(device="head", kind="stall", at=At(command=1, containing="move abs 90001"))


@pytest.fixture(scope="module")
def connection():
    shared = SharedWorld(build(Simulated(), clock=FasterClock(50.0), head=HeadOptions()))
    faults = Faults(FaultScript(fault=(STALL,)))
    stage = EmulatedZaber(shared, steps_per_deg=1000.0, faults=faults)
    with (
        serve_tcp(stage.session, faults=faults) as server,
        Connection.open_tcp("127.0.0.1", server.port) as connection,
    ):
        yield connection


@pytest.fixture(scope="module")
def axis(connection):
    devices = connection.detect_devices(identify_devices=False)
    assert [device.device_address for device in devices] == [1]
    axis = devices[0].get_axis(1)
    assert axis.warnings.get_flags() == {WarningFlags.NO_REFERENCE_POSITION, WarningFlags.DEVICE_NOT_HOMED}
    axis.home()
    return axis


def test_it_homes(axis):
    axis.home()
    assert axis.is_homed()
    assert axis.get_position() == 0
    assert axis.warnings.get_flags() == set()


def test_it_moves_and_waits_and_reads_where_it_is(axis):
    axis.move_absolute(90_000, wait_until_idle=False)
    assert axis.is_busy()
    axis.wait_until_idle()
    assert axis.get_position() == 90_000
    axis.move_relative(-1_000)
    assert axis.get_position() == 89_000


def test_it_stops(axis):
    axis.move_absolute(0)
    axis.move_absolute(700_000, wait_until_idle=False)
    axis.stop()
    assert not axis.is_busy()
    assert 0 < axis.get_position() < 700_000


def test_it_goes_to_its_limit(axis):
    axis.move_max()
    assert axis.get_position() == axis.settings.get("limit.max") == 760_000


def test_a_place_beyond_the_limits_is_refused(axis):
    with pytest.raises(MotionLibException, match="BADDATA"):
        axis.move_absolute(760_001)


def test_replies_may_carry_checksums_and_moves_may_end_with_an_alert(connection, axis):
    connection.generic_command("set comm.checksum 1", device=1)
    connection.enable_alerts()
    axis.move_absolute(1_000)
    assert axis.get_position() == 1_000
    connection.disable_alerts()


def test_a_stall_is_told_as_a_failed_movement(axis):
    axis.move_absolute(0)
    with pytest.raises(MotionLibException, match="Stalled and Stopped"):
        axis.move_absolute(90_001)
