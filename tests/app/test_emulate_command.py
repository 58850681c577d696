from contextlib import ExitStack

import pytest
from app_jobs import tumble

from tumble.app.commands.emulate import _port
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.drivers.candaq.declaration import CAN
from tumble.drivers.clock import SystemClock
from tumble.drivers.scpi.declaration import SCPI
from tumble.drivers.simulated import HeadOptions, Simulated, build
from tumble.drivers.tables import DaqTable, HeadTable
from tumble.emulators.emulation import Wanted, emulate
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld


@pytest.mark.parametrize(
    ("url", "port"),
    [
        ("socketcand:can0?host=127.0.0.1&port=7103", 7103),
        ("socketcand:can0?port=7103&host=localhost", 7103),
        ("socketcand:can0?host=192.0.2.1&port=7103", 0),
        ("socketcan:can0", 0),
    ],
)
def test_the_port_of_a_can_bus_is_that_of_the_stand_file(url, port):
    assert _port(CAN.table(driver="can", url=url)) == port


@pytest.mark.parametrize(
    ("url", "port"),
    [("socket://localhost:7002", 7002), ("socket://192.0.2.1:7002", 0), ("COM7", 0), ("rfc2217://127.0.0.1:7002", 0)],
)
def test_the_port_of_a_serial_line_is_that_of_the_stand_file(url, port):
    assert _port(SCPI.table(driver="scpi", url=url)) == port


@pytest.mark.parametrize("speed", ["nan", "inf"])
def test_a_speed_that_is_no_number_is_refused(speed):
    ran = tumble("emulate", "--speed", speed)
    assert ran.status == 2
    assert f"Invalid value for '--speed': {speed} is no finite number." in ran.err


@pytest.fixture
def emulated(write, monkeypatch, tmp_path):
    """A stand file that names an emulated stand."""
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    monkeypatch.setenv("LOCALAPPDATA", str(tmp_path))
    limits = {"limits_deg": (-180.0, 760.0)}
    shared = SharedWorld(build(Simulated(), clock=FasterClock(50.0), head=HeadOptions(**limits)))
    wanted = Wanted(head=HeadTable(driver="simulated", **limits), daq=DaqTable(driver="simulated"))
    with ExitStack() as stack:
        at = emulate(stack, shared, wanted)
        head = f'[head]\ndriver = "zaber"\nurl = "{at["head"]}"\nlimits_deg = [-180.0, 760.0]\n'
        yield write(
            "emulated.toml", f'name = "emulated"\n{head}[daq]\ndriver = "scpi"\nurl = "{at["daq"]}"\n[simulated]\n'
        )


def test_a_stand_without_simulated_is_never_taken_for_an_emulated_one(emulated, write):
    real = load_stand(write("real.toml", emulated.read_text().replace("[simulated]\n", "")))
    clocks = []
    for stand in (real, load_stand(emulated)):
        connected = connect(stand, write("answers.toml", '[mounts]\ndefault = "yes"\n'))
        connected.links.close()
        clocks.append(type(connected.stand.clock))

    assert clocks == [SystemClock, FasterClock]


def test_only_a_stand_with_simulated_is_emulated(write):
    head = '[head]\ndriver = "zaber"\nurl = "socket://127.0.0.1:1"\nlimits_deg = [0.0, 1.0]\n'
    stand = write("real.toml", f'name = "r"\n{head}[daq]\ndriver = "scpi"\nurl = "socket://127.0.0.1:2"\n')
    ran = tumble("emulate", "--stand", stand)

    assert ran.status == 2
    assert ran.complaint == f"{stand}: has no table [simulated], so that it is no stand to be emulated; add one"


def test_it_is_said_that_nobody_is_asked_for_mounts_at_an_emulated_stand(emulated, write):
    stand, answers = load_stand(emulated), write("answers.toml", '[mounts]\ndefault = "yes"\n')
    warnings = []
    for given in (None, answers):
        connected = connect(stand, given)
        connected.links.close()
        warnings.append(connected.warnings)

    assert warnings == [
        (
            "stand emulated: is emulated, and its emulated operator confirms every mount; "
            "give --attended or --answers to decide it",
        ),
        (),
    ]
