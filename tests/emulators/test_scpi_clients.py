"""Clients that nobody here wrote, at the emulated multimeter over TCP."""

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial

import numpy as np
import pytest

from tumble.drivers.simulated import Simulated, build
from tumble.emulators.scpi import Multimeter, ScpiSession
from tumble.emulators.serving import serve_tcp
from tumble.emulators.speed import FasterClock
from tumble.emulators.world import SharedWorld

with warnings.catch_warnings():
    warnings.simplefilter("ignore")
    from pymeasure.instruments.agilent import Agilent34410A
    from pymeasure.instruments.keithley import Keithley2000, KeithleyDMM6500
    from qcodes.instrument_drivers.Keithley import Keithley2000 as QcodesKeithley2000
    from qcodes.instrument_drivers.Keithley import Keithley6500
    from qcodes.instrument_drivers.Keysight import Keysight34465A

pytestmark = pytest.mark.filterwarnings("ignore")

U0 = pytest.approx(2.5, abs=0.05)


@contextmanager
def resource(model: str) -> Iterator[str]:
    """VISA resource name of an emulated meter."""
    world = SharedWorld(build(Simulated(), clock=FasterClock(200.0)))
    meter = Multimeter(world, model=model)
    with serve_tcp(partial(ScpiSession, meter)) as server:
        yield f"TCPIP::127.0.0.1::{server.port}::SOCKET"


@contextmanager
def closing(instrument):
    try:
        yield instrument
    finally:
        instrument.adapter.close()


def pymeasure(cls, name):
    return closing(cls(name, visa_library="@py", read_termination="\n", write_termination="\n", timeout=5000))


def test_pymeasure_reads_a_voltage():
    with resource("34410A") as name, pymeasure(Agilent34410A, name) as meter:
        assert meter.id.startswith("Agilent Technologies,34410A,")
        assert [meter.voltage_dc for _ in range(3)] == [U0] * 3
        assert meter.check_errors() == []


def test_pymeasure_sees_what_is_wrong():
    with resource("34410A") as name, pymeasure(Agilent34410A, name) as meter:
        meter.write("NONSENSE")

        assert meter.check_errors() == [[-113, '"Undefined header"']]


def test_pymeasure_takes_it_for_a_dmm6500():
    with resource("MODEL DMM6500") as name, pymeasure(KeithleyDMM6500, name) as meter:
        meter.measure_voltage(max_voltage=10)
        meter.voltage_nplc = 1

        assert meter.mode == "voltage"
        assert meter.voltage_range == 10
        assert meter.nplc == 1
        assert meter.line_frequency == 50
        assert meter.voltage == U0
        assert meter.check_errors() == []


def test_pymeasure_fills_the_buffer_of_a_keithley_2000():
    with resource("MODEL 2000") as name, pymeasure(Keithley2000, name) as meter:
        meter.measure_voltage(max_voltage=10)
        meter.voltage_nplc = 0.1
        meter.config_buffer(points=20, delay=0.01)
        meter.start_buffer()
        meter.wait_for_buffer(timeout=5, interval=0.01)

        assert meter.mode == "voltage"
        assert meter.voltage_range == 10
        assert meter.voltage_nplc == 0.1
        assert meter.buffer_data.shape == (20,)
        np.testing.assert_allclose(meter.buffer_data, 2.5, atol=0.05)
        assert meter.check_errors() == []


def test_pymeasure_reads_a_keithley_2000():
    with resource("MODEL 2000") as name, pymeasure(Keithley2000, name) as meter:
        meter.measure_voltage(max_voltage=10)

        assert meter.id == "KEITHLEY INSTRUMENTS INC.,MODEL 2000,MY57200001,A20 /A02"
        assert [meter.voltage for _ in range(3)] == [U0] * 3
        assert meter.check_errors() == []


@contextmanager
def qcodes(cls, model):
    with resource(model) as name:
        meter = cls(f"meter_{model.split()[-1]}", name, visalib="@py", terminator="\n")
        try:
            yield meter
        finally:
            meter.close()


def test_qcodes_drives_a_keithley_2000():
    with qcodes(QcodesKeithley2000, "MODEL 2000") as meter:
        meter.mode("dc voltage")
        meter.range(10)
        meter.nplc(0.1)
        meter.averaging_enabled(False)
        meter.trigger_continuous(False)
        meter.trigger_count(1)
        meter.trigger_source("timer")
        meter.trigger_timer(0.01)
        meter.trigger()

        assert meter.amplitude() == U0
        assert meter.mode() == "dc voltage"
        assert (meter.range(), meter.nplc(), meter.trigger_timer()) == (10.0, 0.1, 0.01)
        assert not meter.averaging_enabled()
        assert meter.ask("SYST:ERR?") == '0,"No error"'


def test_qcodes_reads_a_dmm6500():  # it knows functions without quotation marks only, and so sets nothing here
    with qcodes(Keithley6500, "MODEL DMM6500") as meter:
        meter.mode("dc voltage")

        assert meter.amplitude() == U0
        assert meter.ask("SYST:ERR?") == '0,"No error;0;0 0"'


@pytest.fixture
def keysight():
    with resource("34465A") as name:
        meter = Keysight34465A("meter", name, silent=True, visalib="@py")
        try:
            yield meter
        finally:
            meter.close()


def test_qcodes_connects_and_asks_everything(keysight):
    assert keysight.model == "34465A"
    assert keysight.line_frequency() == 50

    keysight.snapshot(update=True)

    assert keysight.error() == (0, "No error")


def test_qcodes_sets_and_reads_back(keysight):
    keysight.NPLC(0.2)
    keysight.range(10)
    keysight.autorange("OFF")
    keysight.autozero("OFF")
    keysight.aperture_time(0.01)

    assert keysight.range() == 10
    assert keysight.aperture_mode() == "ON"
    keysight.NPLC(1)
    assert keysight.aperture_mode() == "OFF"
    assert keysight.NPLC() == 1
    assert keysight.resolution() == pytest.approx(3e-6)
    assert keysight.error() == (0, "No error")


def test_qcodes_reads_a_voltage(keysight):
    assert keysight.volt() == U0


def test_qcodes_samples_a_buffer(keysight):
    keysight.NPLC(0.2)
    keysight.sample.count(50)
    keysight.init_measurement()

    readings = keysight.fetch()

    assert readings.shape == (50,)
    np.testing.assert_allclose(readings, 2.5, atol=0.05)
    assert keysight.read().shape == (50,)


def test_qcodes_takes_a_time_trace(keysight):
    keysight.NPLC(0.2)
    keysight.timetrace_npts(100)
    keysight.timetrace_dt(0.02)

    readings = keysight.timetrace()

    assert readings.shape == (100,)
    np.testing.assert_allclose(readings, 2.5, atol=0.05)
    assert keysight.error() == (0, "No error")


def test_qcodes_clears_errors(keysight):
    keysight.write("NONSENSE")
    keysight.flush_error_queue(verbose=False)

    assert keysight.error() == (0, "No error")
