"""The master of the profile that `canopen` brings along, used as anybody would, with a data sheet file."""

import time
from contextlib import contextmanager

import canopen
import pytest
from can_bench import DEADLINE_S, can_bench
from canopen.profiles.p402 import BaseNode402

from tumble.drivers.cia402 import write_eds
from tumble.emulators.socketcand import CHANNEL, serve_socketcand


@contextmanager
def master(tmp_path, **bus):
    eds = tmp_path / "drive.eds"
    write_eds(eds, node_id=1)
    network = canopen.Network()
    network.NOTIFIER_CYCLE = 0.05
    network.connect(**bus)
    try:
        node = BaseNode402(1, str(eds))
        network.add_node(node)
        node.nmt.state = "PRE-OPERATIONAL"
        node.setup_402_state_machine()
        node.nmt.state = "OPERATIONAL"
        yield node
    finally:
        network.disconnect()


@pytest.fixture
def bench():
    with can_bench() as bench:
        yield bench


@pytest.fixture
def node(bench, tmp_path):
    with master(tmp_path, interface="virtual", channel=bench.channel) as node:
        yield node


def wait_for(node: BaseNode402, bit: int) -> None:
    deadline_s = time.monotonic() + DEADLINE_S
    while not node.check_statusword() & 1 << bit:
        assert time.monotonic() < deadline_s


def go_to(node: BaseNode402, counts: int) -> None:
    node.op_mode = "PROFILED POSITION"
    node.state = "OPERATION ENABLED"
    node.sdo[0x607A].raw = counts
    node.controlword = 0x1F
    wait_for(node, 12)
    node.controlword = 0x0F


def test_it_walks_through_the_state_machine(node: BaseNode402):
    assert node.check_statusword() & 0x4F == 0x40
    for state in ("READY TO SWITCH ON", "SWITCHED ON", "OPERATION ENABLED", "QUICK STOP ACTIVE"):
        node.sdo[0x605A].raw = 6
        node.state = state
        assert node.state == state


def test_it_homes(node: BaseNode402):
    node.op_mode = "HOMING"
    assert node.op_mode == "HOMING"
    assert not node.is_homed()
    assert node.homing(timeout=DEADLINE_S)
    assert node.is_homed(restore_op_mode=True)


def test_it_goes_to_a_profile_position(bench, node: BaseNode402):
    go_to(node, -33_000)
    wait_for(node, 10)
    assert node.sdo[0x6064].raw == -33_000
    assert bench.world.head.status().angle_deg == 33.0


def test_it_hears_the_position_in_a_cyclic_pdo(node: BaseNode402):
    go_to(node, -2_000)
    wait_for(node, 10)
    node.tpdo[2].wait_for_reception(1.0)
    assert node.tpdo[2].wait_for_reception(1.0) is not None
    assert node.tpdo[2][0x6064].raw == -2_000


def test_it_sends_the_target_in_a_pdo(node: BaseNode402):
    node.op_mode = "PROFILED POSITION"
    node.state = "OPERATION ENABLED"
    node.rpdo[2][0x607A].raw = -1_500
    node.rpdo[2].transmit()
    node.controlword = 0x1F
    wait_for(node, 12)
    wait_for(node, 10)
    assert node.sdo[0x6064].raw == -1_500


def test_it_halts(node: BaseNode402):
    go_to(node, -700_000)
    node.controlword = 0x10F
    wait_for(node, 10)
    assert -700_000 < node.sdo[0x6064].raw <= 0


def test_it_hears_heartbeats(node: BaseNode402):
    node.sdo[0x1017].raw = 20
    assert node.nmt.wait_for_heartbeat(1.0) == "OPERATIONAL"


def test_a_reset_loses_the_reference_and_boots_again(node: BaseNode402):
    assert node.homing(timeout=DEADLINE_S)
    booted = []
    node.nmt.add_heartbeat_callback(booted.append)
    node.nmt.state = "RESET"
    deadline_s = time.monotonic() + DEADLINE_S
    while 0 not in booted:
        assert time.monotonic() < deadline_s
    node.nmt.state = "OPERATIONAL"
    assert not node.is_homed()


def test_it_hears_the_emergency_of_a_stall_and_resets_the_fault(tmp_path):
    fault = {"device": "head", "kind": "stall", "at": {"command": 1, "containing": "controlword 001F"}}
    with can_bench(fault) as bench, master(tmp_path, interface="virtual", channel=bench.channel) as node:
        codes = []
        node.emcy.add_callback(lambda entry: codes.append(entry.code))
        go_to(node, -40_000)
        deadline_s = time.monotonic() + DEADLINE_S
        while 0x8611 not in codes:
            assert time.monotonic() < deadline_s
        node.check_statusword()
        assert node.state == "FAULT"
        node.reset_from_fault()
        assert node.state == "OPERATION ENABLED"


def test_an_sdo_beyond_the_limits_is_aborted(node: BaseNode402):
    with pytest.raises(canopen.SdoAbortedError) as caught:
        node.sdo[0x607A].raw = 2_000_000_000
    assert caught.value.code == 0x06090030
    assert (node.sdo[0x607D][1].raw, node.sdo[0x607D][2].raw) == (-760_000, 180_000)


def test_it_reaches_the_drive_over_tcp(bench, tmp_path):
    with (
        serve_socketcand(bench.channel) as server,
        master(tmp_path, interface="socketcand", channel=CHANNEL, host="127.0.0.1", port=server.port) as node,
    ):
        go_to(node, -10_000)
        wait_for(node, 10)
        assert node.sdo[0x6064].raw == -10_000
