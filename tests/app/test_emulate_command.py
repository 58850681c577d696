import pytest
from app_jobs import tumble

from app.commands.emulate import _port
from drivers.candaq.declaration import CAN
from drivers.scpi.declaration import SCPI


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
