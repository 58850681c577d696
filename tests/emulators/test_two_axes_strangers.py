"""Clients that nobody here wrote, on both axes: the makers' own of Zaber, and canopen as a master of two nodes."""

import re
import time

import canopen
import pytest
from zaber_motion.ascii import Connection

from benchmarks.endurance.two_axes import CIA402, SCANNER, ZABER, ZABER_CHAIN, served
from tumble.drivers.cia402 import objects

SHORT = 'method = "triad"\nname = "short"\n[[procedure]]\nlist = "8o"\n'


def stand(folder, positioners):
    return served(folder, "\n".join((positioners, SCANNER)), SHORT, speed=50.0)


def place(served_stand):
    found = re.search(r"socket://127\.0\.0\.1:(\d+)", served_stand.job.stand.file.positioners["outer"].url)
    return int(found[1])


@pytest.mark.parametrize(("positioners", "devices"), [(ZABER, [2]), (ZABER_CHAIN, [1, 1])], ids=["axes", "chain"])
def test_zabers_own_client_finds_homes_and_moves_both(positioners, devices, tmp_path):
    with stand(tmp_path, positioners) as here, Connection.open_tcp("127.0.0.1", place(here)) as connection:
        found = connection.detect_devices(identify_devices=False)
        assert [device.settings.get("system.axiscount") for device in found] == devices
        axes = [
            device.get_axis(number + 1) for device, count in zip(found, devices, strict=True) for number in range(count)
        ]
        for axis in axes:
            axis.home()
        axes[0].move_absolute(90 * 3600, wait_until_idle=False)
        axes[1].move_absolute(-45 * 3600, wait_until_idle=False)
        assert all(axis.is_busy() for axis in axes)
        for axis in axes:
            axis.wait_until_idle()
        assert [axis.get_position() for axis in axes] == [90 * 3600, -45 * 3600]
        world = here.shared.world.positioners
        assert [world[name].status().angle_deg for name in ("outer", "inner")] == [90.0, -45.0]


def test_canopen_reaches_two_nodes_on_one_bus(tmp_path):
    with stand(tmp_path, CIA402) as here:
        connected = here.connect()
        link = connected.stand.positioners["outer"]._node._link
        network = canopen.Network()
        network.send_message = lambda can_id, data, remote=False: link.send(can_id, bytes(data))
        link.subscribe(lambda frame: network.notify(frame.arbitration_id, frame.data, time.monotonic()))
        nodes = [network.add_node(number, objects.object_dictionary(number)) for number in (1, 2)]
        answers = [node.sdo[0x1000].raw & 0xFFFF for node in nodes]
        connected.links.close()
    assert answers == [402, 402]
