"""Stand files with several positioners and samplers, and a run of a method that is none of the product's."""

import shutil

import pytest
from two_axes import CHANNELS

from tumble.app.measurements import read_measurement
from tumble.app.methods.dividing_head.experiments import available
from tumble.app.resuming import find, resume
from tumble.app.running import Job, run
from tumble.app.same_stand import load_same_stand
from tumble.app.stand import load_stand, read_stand, same_instruments
from tumble.app.wiring import Attendant, connect, obliging_operator
from tumble.drivers.clock import VirtualClock
from tumble.procedures.errors import InputError, ProgrammeError
from tumble.procedures.events import FinishReason, PointCompleted
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.reader import read_recording

DRIVERS = """
from fakes import FakeHead
from two_axes import MADE, Triad

from tumble.drivers.driver import Driver
from tumble.drivers.tables import DaqTable, HeadTable


class AxisKeys(HeadTable):
    gear: int = 1


def axis(keys, bench):
    MADE.append(FakeHead(bench.clock))
    return MADE[-1]


class Late:
    def __init__(self, clock):
        self.clock = clock

    def identify(self):
        return Triad(self.clock, *MADE[-2:]).identify()

    def acquire(self, samples, rate_hz):
        return Triad(self.clock, *MADE[-2:]).acquire(samples, rate_hz)


AXIS = Driver(table=AxisKeys, connect=axis)
TRIAD = Driver(table=DaqTable, connect=lambda keys, bench: Late(bench.clock))
"""

STAND = """
name = "two axes"

[positioners.outer]
driver = "mine.py:AXIS"
limits_deg = [-180.0, 180.0]
speed_deg_s = 30.0
serial = "1"

[positioners.inner]
driver = "mine.py:AXIS"
limits_deg = [-180.0, 180.0]
speed_deg_s = 30.0
gear = 3

[samplers.triad]
driver = "mine.py:TRIAD"
samples = 20
channels = ["u_x_v", "u_y_v", "u_z_v"]
"""

PROGRAMME = """method = "two_axes"
name = "four"
[positions]
places_deg = [[90.0, 0.0], [90.0, 45.0], [0.0, 45.0], [-90.0, 30.0]]
"""


@pytest.fixture(autouse=True)
def installed(install):
    install("tumble.procedures", "two_axes", "two_axes:TWO_AXES")


@pytest.fixture
def write(tmp_path):
    (tmp_path / "mine.py").write_text(DRIVERS, "utf-8")

    def stand(text=STAND):
        path = tmp_path / "bench.toml"
        path.write_text(text, "utf-8")
        return path

    return stand


def at(loaded):
    return connect(loaded, clock=VirtualClock(0), attendant=Attendant(operator=obliging_operator))


def job_at(loaded):
    return Job(stand=loaded, programme=programme_from_text(PROGRAMME, "four.toml"), serial_number="T-1")


def test_every_table_is_an_instrument_with_the_keys_of_its_driver(write):
    loaded = load_stand(write())
    assert list(loaded.file.positioners) == ["outer", "inner"]
    assert list(loaded.file.samplers) == ["triad"]
    assert loaded.file.positioners["inner"].gear == 3
    assert at(loaded).stand.serials == {"outer": "1", "inner": "", "triad": ""}


def test_head_and_daq_are_a_positioner_and_a_sampler_of_these_names():
    file = read_stand().file
    assert list(file.positioners) == ["head"]
    assert list(file.samplers) == ["daq"]
    assert (file.positioners["head"], file.samplers["daq"]) == (file.head, file.daq)


def test_a_run_is_measured_recorded_and_goes_on(write, tmp_path):
    loaded, recording = load_stand(write()), tmp_path / "run.mcap"
    broken = tmp_path / "broken.mcap"

    def copy(event):
        if isinstance(event, PointCompleted) and event.point.index == 1:
            shutil.copyfile(recording, broken)

    assert run(job_at(loaded), at(loaded), recording, [copy]).reason is FinishReason.COMPLETED
    whole = read_recording(recording)
    assert (whole.header.method, whole.header.method_version, whole.header.format_version) == ("two_axes", 2, 4)
    assert whole.complete
    assert [point.positions_deg["inner"] for point in whole.points] == [0.0, 45.0, 45.0, 30.0]
    assert list(whole.points[0].readings) == list(CHANNELS)
    assert {reading.samples for reading in whole.points[0].readings.values()} == {20}

    unfinished = find(broken)
    assert len(unfinished.recording.points) == 2
    again = load_same_stand(unfinished.recording)
    outcome = resume(unfinished, job_at(again), at(again))
    assert outcome.reason is FinishReason.COMPLETED
    assert [point.positions_deg for point in outcome.points] == [point.positions_deg for point in whole.points]
    assert read_recording(broken).complete


def test_the_limits_of_every_positioner_are_kept(write):
    narrow = STAND.replace("[-180.0, 180.0]", "[-45.0, 180.0]", 1)
    with pytest.raises(ProgrammeError, match="goes to -90 deg, outside the outer's limits of -45 to 180 deg"):
        job_at(load_stand(write(narrow))).plan()


def test_a_programme_for_other_positioners_is_refused():
    with pytest.raises(ProgrammeError, match="needs the positioner inner; the stand has head"):
        job_at(load_stand()).plan()


def test_what_needs_a_dividing_head_says_that_there_is_none(write):
    with pytest.raises(InputError, match=r"stand two axes: has no \[head\]"):
        available(load_stand(write()), None, attended=False)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (("gear = 3", "gears = 3"), "line 14: positioners: inner: gears: Extra inputs are not permitted"),
        (('driver = "mine.py:TRIAD"\n', ""), "line 16: samplers: triad: driver: Field required; add it"),
        (("mine.py:TRIAD", "mine.py:AXIS"), "line 17: samplers: triad: driver: mine.py:AXIS is no driver whose table"),
        (("samplers.triad", "samplers.outer"), "two instruments are called outer: give one of them another name"),
        (("[samplers.triad]", "[samplers]"), "samplers: driver: Input should be"),
        (('driver = "mine.py:TRIAD"', 'driver = "simulated"'), "a simulated head and a simulated daq belong together"),
        (("[samplers.triad]", "[other.triad]"), "daq: Field required; add it"),
    ],
)
def test_what_is_wrong_in_such_a_table_is_said_with_its_line(write, change, complaint):
    with pytest.raises(InputError) as raised:
        load_stand(write(STAND.replace(*change)))
    assert complaint in str(raised.value)


def test_a_sampler_with_fewer_channels_than_it_has_names_is_a_device_fault(write, tmp_path):
    loaded = load_stand(write(STAND.replace(', "u_z_v"]', "]")))
    outcome = run(job_at(loaded), at(loaded), tmp_path / "run.mcap")
    assert outcome.message.startswith("triad: gives 3 channels, and the stand file names 2; correct channels")


def test_another_instrument_in_any_table_is_another_stand(write):
    here = load_stand(write())
    assert same_instruments(here.recorded, here)
    other = load_stand(write(STAND.replace('serial = "1"', 'serial = "2"')))
    assert not same_instruments(here.recorded, other)


def test_the_analysis_of_a_head_refuses_the_recording_of_another_method(write, tmp_path):
    loaded, recording = load_stand(write()), tmp_path / "run.mcap"
    run(job_at(loaded), at(loaded), recording)
    with pytest.raises(InputError, match=r"run\.mcap: is of the method two_axes, which this does not analyse"):
        read_measurement(recording)
