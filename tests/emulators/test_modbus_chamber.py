"""The chamber on Modbus TCP: driver, emulator, and a client that nobody here wrote."""

from contextlib import contextmanager
from pathlib import Path

import pytest
from pymodbus.client import ModbusTcpClient

from benchmarks.endurance.two_axes import CHAMBER, SCANNER, WORLD, ZABER, served
from tumble.app.running import run
from tumble.drivers.errors import DeviceError, LimitError, LinkLostError
from tumble.emulators.faults import At, Fault
from tumble.procedures.events import FinishReason, WarningRaised
from tumble.procedures.recording.reader import read_recording

STAND = "\n".join((ZABER, SCANNER, CHAMBER))
SOAKED = """method = "triad"
name = "soaked"
temperatures_degC = [25]
settle_s = 0.1
settle_tolerance_v = 1.0

[soak]
window_s = 96.0
look_s = 24.0
rate_K_per_h = 30.0

[[procedure]]
positions = [[90, 0], [90, 90], [0, 0], [180, 0]]
"""


@contextmanager
def chamber(folder, registers=CHAMBER, *faults):
    """The driver of an emulated chamber, and its stand; the chamber's clock is a hundred times as fast."""
    with served(folder, "\n".join((ZABER, SCANNER, registers)), SOAKED, speed=100.0) as stand:
        for kind, at, lasts_s in faults:
            stand.faults.add(Fault(device="chamber", kind=kind, at=At(**at), lasts_s=lasts_s))
        connected = stand.connect()
        try:
            yield connected.stand.environments["chamber"], stand
        finally:
            connected.links.close()


def test_a_set_point_is_told_and_read_back(tmp_path):
    with chamber(tmp_path) as (driver, _):
        driver.identify()
        driver.begin(41.5)
        status = driver.status()
    assert (status.setpoint_degc, status.running, status.door_open) == (41.5, True, False)


def test_the_air_follows(tmp_path):
    with chamber(tmp_path) as (driver, stand):
        driver.begin(33.0)
        stand.clock.sleep(280.0)
        assert driver.status().temperature_degc == pytest.approx(33.0, abs=0.2)


def test_it_is_left_at_its_safe_set_point(tmp_path):
    with chamber(tmp_path) as (driver, _):
        driver.begin(60.0)
        driver.make_safe()
        assert driver.status().setpoint_degc == 23.0


def test_without_a_safe_set_point_it_is_switched_off(tmp_path):
    with chamber(tmp_path, CHAMBER.replace("safe_degC = 23.0\n", "")) as (driver, _):
        driver.begin(60.0)
        driver.make_safe()
        assert not driver.status().running


@pytest.mark.parametrize("kind", ["int16", "uint16", "int32", "uint32", "float32"])
@pytest.mark.parametrize("order", ["big", "little"])
def test_numbers_stand_in_registers_as_the_stand_file_says(kind, order, tmp_path):
    numbers = f'setpoint = {{ holding = 7, kind = "{kind}", scale = 0.01, offset = -50.0, word_order = "{order}" }}'
    with chamber(tmp_path, CHAMBER.replace("setpoint = { holding = 7 }", numbers)) as (driver, _):
        driver.begin(33.25)
        assert driver.status().setpoint_degc == pytest.approx(33.25, abs=1e-3)


def test_nothing_is_sent_beyond_its_limits(tmp_path):
    with chamber(tmp_path) as (driver, _), pytest.raises(LimitError, match="125 °C is outside -40 to 120 °C"):
        driver.begin(125.0)


@pytest.mark.parametrize(
    ("kind", "said"),
    [
        ("sensor_broken", r"says that its air has 1e\+30 °C; look at its sensor"),
        ("refused", "was told 50 °C and has 23 °C"),
    ],
)
def test_what_it_cannot_be_believed_is_told(kind, said, tmp_path):
    with chamber(tmp_path, CHAMBER, (kind, {"time_s": 0.0}, 9.0)) as (driver, _):  # noqa: SIM117
        with pytest.raises(DeviceError, match=said):
            driver.begin(50.0)
            driver.status()


def test_a_register_that_it_has_not_is_told(tmp_path):
    with chamber(tmp_path) as (driver, stand):
        registers = stand.job.stand.file.chamber_table.registers
        elsewhere = registers.model_copy(update={"actual": registers.setpoint.model_copy(update={"holding": 99})})
        driver._table = driver._table.model_copy(update={"registers": elsewhere})
        with pytest.raises(DeviceError, match="answers with an error: it has no such register"):
            driver.status()


def test_a_link_that_goes_is_lost_and_comes_back(tmp_path):
    with chamber(tmp_path, CHAMBER) as (driver, stand):
        driver.identify()
        stand.faults.add(Fault(device="chamber", kind="drop", at=At(time_s=0.0), lasts_s=0.5))
        with pytest.raises(LinkLostError, match=r"temperature chamber: does not answer at socket://127\.0\.0\.1:"):
            for _ in range(200):
                driver.status()
        for _ in range(50):
            try:
                driver.reconnect()
                break
            except LinkLostError:
                stand.clock.sleep(10.0)
        assert driver.status().setpoint_degc == 23.0


@pytest.mark.parametrize("kind", ["late", "double", "cut", "reorder"])
def test_an_answer_that_comes_to_harm_is_asked_for_again(kind, tmp_path):
    impatient = CHAMBER.replace('url = "', 'timeout_s = 0.3\nurl = "')
    with chamber(tmp_path, impatient, (kind, {"time_s": 0.0}, 0.5)) as (driver, _):
        driver.begin(44.0)
        assert driver.status().setpoint_degc == 44.0


def test_a_stranger_reads_and_writes_it(tmp_path):
    with chamber(tmp_path) as (driver, stand):
        host, port = stand.job.stand.file.chamber_table.place
        client = ModbusTcpClient(host, port=port)
        assert client.connect()
        assert client.write_register(7, 305).isError() is False
        assert client.read_holding_registers(7, count=1).registers == [305]
        words = client.read_input_registers(100, count=2).registers
        assert client.convert_from_registers(words, client.DATATYPE.FLOAT32, "little") == pytest.approx(23.0, abs=0.5)
        assert client.read_discrete_inputs(12, count=2).bits[:2] == [True, False]
        assert client.write_coil(3, True).isError() is False
        assert client.read_coils(3, count=1).bits[0] is True
        assert client.read_holding_registers(50, count=1).exception_code == 2
        client.close()
        assert driver.status().running


def outcome_of(folder: Path, faults=(), programme=SOAKED, world=WORLD):
    with served(folder, STAND, programme, speed=60.0, world=world) as stand:
        for device, kind, at, lasts_s in faults:
            stand.faults.add(Fault(device=device, kind=kind, at=At(**at), lasts_s=lasts_s))
        connected = stand.connect()
        try:
            outcome = run(stand.job, connected, folder / "run.mcap")
        finally:
            connected.links.close()
        return outcome, stand


def test_a_run_soaks_and_leaves_the_chamber_safe_and_its_door_open(tmp_path):
    outcome, stand = outcome_of(tmp_path)
    assert outcome.reason is FinishReason.COMPLETED
    chamber = stand.shared.world.chamber
    assert (chamber.setpoint_degc, chamber.door_locked) == (23.0, False)
    assert [point.conditions for point in outcome.points] == [{"chamber": "25"}] * 4


def test_an_opened_door_stops_what_turns(tmp_path):
    outcome, stand = outcome_of(tmp_path, [("chamber", "door_opened", {"point": 2}, 60.0)])
    assert outcome.reason is FinishReason.DEVICE_FAULT
    assert "temperature chamber: its door is open; shut it, then resume the run" in outcome.message
    assert outcome.at_standstill
    assert not any(axis.status().moving for axis in stand.shared.world.positioners.values())
    assert stand.shared.world.chamber.setpoint_degc == 23.0


@pytest.mark.parametrize("at", [{"time_s": 60.0}, {"point": 2}])
def test_a_link_to_the_chamber_that_is_lost_for_a_while_ends_nothing(at, tmp_path):
    outcome, _ = outcome_of(tmp_path, [("chamber", "drop", at, 0.1)])
    assert (outcome.reason, len(outcome.points)) == (FinishReason.COMPLETED, 4), outcome.message
    told = [event.message for event in read_recording(tmp_path / "run.mcap").events if isinstance(event, WarningRaised)]
    assert any("temperature chamber" in message and "is back after" in message for message in told)
