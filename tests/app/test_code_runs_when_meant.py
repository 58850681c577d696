"""A stand file may name Python files; they are run by what moves the stand only, and only where they are the same."""

import py_compile
import struct
from dataclasses import replace
from hashlib import sha256

import pytest
from app_jobs import STAND, tumble

from tumble.app.same_stand import followed, load_same_stand
from tumble.app.stand import read_stand
from tumble.procedures.errors import InputError
from tumble.procedures.recording.reader import read_recording

DRIVER = """\
from pathlib import Path

Path(__file__).with_name("ran").touch()

from dataclasses import replace

from tumble.drivers.clock import VirtualClock
from tumble.drivers.driver import Driver
from tumble.drivers.protocols import PositionerStatus, Identity, SampleBlock
from tumble.drivers.tables import DaqTable, HeadTable
import numpy as np

class Head:
    limits_deg, speed_deg_s = (-180.0, 760.0), 20.0
    angle_deg, moving = 0.0, False
    def identify(self): return Identity(model="lab", serial="1")
    def home(self): pass
    def start_move(self, angle_deg): self.angle_deg = angle_deg
    def status(self): return PositionerStatus(angle_deg=self.angle_deg, moving=False, device_time_s=0.0)
    def stop(self): Path(__file__).with_name("stopped").touch()

class Sampler:
    def identify(self): return Identity(model="lab", serial="2")
    def acquire(self, samples, rate_hz):
        return SampleBlock(voltage_v=np.full(samples, 2.5), rate_hz=rate_hz, device_time_s=0.0, temperature_degc=None)

HEAD = Driver(table=HeadTable, connect=lambda table, bench: Head())
DAQ = Driver(table=DaqTable, connect=lambda table, bench: Sampler())
"""
FAILING = DRIVER.replace("return SampleBlock(", "raise SystemExit(0)\n        return SampleBlock(")
KINDS = ["SystemExit(0)", "KeyboardInterrupt", "ValueError('no port')", "BaseException('x')"]
LAB = 'name = "lab"\n[head]\ndriver = "lab.py:HEAD"\nlimits_deg = [-180.0, 760.0]\n[daq]\ndriver = "lab.py:DAQ"\n'
ANSWERS = '[mounts]\ndefault = "yes"\n'
REMOTE = [r"\\server\share\bench.toml", "//server/share/bench.toml", "file:///bench.toml", "http://server/bench.toml",
          "smb://server/bench.toml", r"\\?\UNC\server\bench.toml"]  # fmt: skip


@pytest.fixture
def lab(write):
    """A stand whose drivers are in a file of its own; writes that file."""

    def make(code=DRIVER):
        write("lab.py", code)
        return write("lab.toml", LAB)

    return make


@pytest.fixture
def ran(tmp_path):
    """Whether the driver file has run; forgets it."""

    def look():
        there = (tmp_path / "ran").exists()
        (tmp_path / "ran").unlink(missing_ok=True)
        return there

    return look


@pytest.fixture
def run(write, tiny, tmp_path, monkeypatch):
    """Runs six dwells at a stand without waiting; returns what was said and the recording."""
    monkeypatch.setattr("tumble.drivers.clock.time.sleep", lambda _: None)
    monkeypatch.setattr("tumble.procedures.motion._STANDSTILL_S", 0.1)
    answers = write("answers.toml", ANSWERS)

    def measure(stand):
        recording = tmp_path / "x.mcap"
        return tumble(
            "run", "--stand", stand, "--programme", tiny, "--serial", "A", "--answers", answers, "--out", recording
        ), recording

    return measure


@pytest.fixture
def recorded(stand, write, tiny, tmp_path):
    """A recording of a simulated stand with physics of its own."""
    write("physics.py", "def response(ax, ay, az, degc, time_s):\n    return 2.5 + ax\n")
    stand = write("own.toml", STAND + 'response = "physics.py:response"\n')
    recording = tmp_path / "own.mcap"
    done = tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", recording)
    assert done.status == 0, done.err
    return read_recording(recording)


def with_header(recording, **changed):
    return replace(recording, header=replace(recording.header, **changed))


@pytest.mark.parametrize(
    "arguments", [("plan", "quick"), ("fit", "t.csv"), ("report", "t.csv", "--store", "s"), ("close-loop", "t.csv")]
)
def test_what_moves_nothing_runs_no_driver(lab, write, ran, tmp_path, monkeypatch, arguments):
    monkeypatch.chdir(tmp_path)
    write("t.csv", "angle_deg,voltage_V\n0,2.5\n")
    tumble(*arguments, "--stand", lab())

    assert not ran()


def test_a_plan_at_a_stand_of_ones_own_is_made(lab):
    assert tumble("plan", "quick", "--stand", lab()).status == 0


def test_what_moves_the_stand_runs_it_and_records_what_it_was(lab, run, ran):
    done, recording = run(lab())

    assert (done.status, ran()) == (0, True)
    assert set(read_recording(recording).header.stand_code_sha256) == {"lab.py:HEAD", "lab.py:DAQ"}


@pytest.mark.parametrize(
    "kind", ["SystemExit(0)", "SystemExit(1)", "KeyboardInterrupt", "BaseException('x')", "OSError(2)"]
)
def test_whatever_a_file_raises_when_it_is_loaded_is_bad_input(lab, run, tmp_path, kind):
    done, recording = run(lab(f"raise {kind}\n"))

    assert done.status == 2
    assert f"{tmp_path / 'lab.py'} could not be loaded ({kind.partition('(')[0]}" in done.complaint
    assert not recording.exists()


def test_a_file_that_is_none_of_python_is_bad_input(lab, run):
    assert run(lab("\0"))[0].status == 2
    assert run(lab("def"))[0].status == 2


@pytest.mark.parametrize("kind", ["SystemExit(0)", "KeyboardInterrupt", "ValueError('no port')", "BaseException('x')"])
@pytest.mark.parametrize(
    "method", ["start_move(self, angle_deg):", "status(self):", "acquire(self, samples, rate_hz):"]
)
def test_whatever_a_driver_raises_is_a_fault_of_the_instrument(lab, run, method, kind):
    head, name, rest = DRIVER.partition(f"def {method}")
    done, _ = run(lab(f"{head}{name}\n        raise {kind}\n    def _rest(self, *_):{rest}"))

    assert done.status == 3
    assert f"its driver lab.py:{'DAQ' if 'acquire' in method else 'HEAD'} failed ({kind.partition('(')[0]}" in done.err


def test_the_head_is_stopped_where_the_driver_of_the_voltmeter_fails(lab, run, tmp_path):
    done, recording = run(
        lab(DRIVER.replace("return SampleBlock(", "raise SystemExit(0)\n        return SampleBlock("))
    )

    assert done.status == 3
    assert (tmp_path / "stopped").exists()
    assert read_recording(recording).ending.at_standstill


def test_a_driver_that_lacks_something_is_named(lab, run):
    done, _ = run(lab(DRIVER.replace("def home", "def homing")))

    assert done.status == 2
    assert "the driver lab.py:HEAD of the dividing head has no home; see drivers/protocols.py" in done.err


@pytest.mark.parametrize("kind", ["SystemExit(0)", "KeyboardInterrupt", "ZeroDivisionError"])
def test_whatever_physics_raise_is_a_fault_of_the_stand(write, run, kind):
    write("physics.py", f"def response(*_):\n    raise {kind}\n")
    done, _ = run(write("own.toml", STAND + 'response = "physics.py:response"\n'))

    assert done.status == 3
    assert f"simulated stand: physics.py:response failed ({kind.partition('(')[0]}" in done.err


def test_what_lies_compiled_beside_a_file_is_not_run(lab, run, tmp_path):
    stand = lab("raise SystemExit(0)\n")
    py_compile.compile(str(tmp_path / "lab.py"), doraise=True)
    source = DRIVER.encode()
    compiled = next((tmp_path / "__pycache__").glob("lab.*.pyc"))
    lab()
    content = bytearray(compiled.read_bytes())
    content[8:16] = struct.pack("<II", int((tmp_path / "lab.py").stat().st_mtime), len(source))  # as if it were its own
    compiled.write_bytes(content)

    assert run(stand)[0].status == 0


def test_a_run_is_not_resumed_with_another_driver_file_and_that_is_not_run(lab, run, ran, write, monkeypatch, tmp_path):
    _, recording = run(lab(FAILING))
    assert ran()
    write("lab.py", DRIVER)
    resumed = tumble("resume", recording, "--answers", tmp_path / "answers.toml")

    assert resumed.status == 2
    assert "lab.py:DAQ is not the file with which" in resumed.complaint
    assert not ran()


def test_the_same_stand_is_shown_before_it_is_loaded(recorded):
    shown = []
    load_same_stand(recorded, None, shown.append)

    assert shown == [f"stand file {recorded.header.stand_path}, as {recorded.path} says"]


def test_physics_that_were_changed_are_not_run(recorded, write):
    write("physics.py", "raise SystemExit(0)\n")

    with pytest.raises(InputError, match=r"physics.py:response is not the file with which .* was begun"):
        load_same_stand(recorded)


def test_an_old_recording_goes_on_where_its_stand_names_no_file(tiny_recording):
    assert load_same_stand(with_header(read_recording(tiny_recording), stand_code_sha256=None)).path is None


def test_an_old_recording_whose_stand_names_a_file_goes_on_once_somebody_vouches_for_it(recorded, tmp_path):
    old = with_header(recorded, stand_code_sha256=None)

    with pytest.raises(InputError, match=r"does not say what physics.py:response held"):
        load_same_stand(old)
    assert load_same_stand(old, tmp_path / "own.toml").file.name == "bench-1"


@pytest.mark.parametrize("place", REMOTE)
def test_a_path_to_another_computer_is_not_followed(recorded, place):
    with pytest.raises(InputError, match="which leads to another computer and is not followed"):
        load_same_stand(with_header(recorded, stand_path=place))
    with pytest.raises(InputError, match="which leads to another computer and is not followed"):
        followed(with_header(recorded, follows=(place,)))


def test_a_file_of_an_instrument_on_another_computer_is_not_followed_from_a_recording(recorded, write, tiny, tmp_path):
    text = 'name = "c"\n[head]\ndriver = "zaber"\nurl = "COM7"\nlimits_deg = [0.0, 1.0]\n[daq]\ndriver = "can"\n'
    stand = write("can.toml", text + 'url = "socketcan:can0"\ndbc = "//server/daq.dbc"\n')
    begun = with_header(recorded, stand_path=str(stand), stand_sha256=read_stand(stand).sha256, stand_code_sha256={})

    with pytest.raises(InputError, match=r"daq: dbc: //server/daq.dbc leads to another computer"):
        load_same_stand(begun)


@pytest.mark.parametrize("driver", ["//server/lab.py:HEAD", r"\\\\server\\lab.py:HEAD", "http://server/lab.py:HEAD"])
def test_code_of_another_computer_is_never_run(write, run, driver):
    done, _ = run(write("lab.toml", LAB.replace("lab.py:HEAD", driver)))

    assert done.status == 2
    assert "leads to another computer, whose code is not run; copy the file to this one" in done.complaint


def test_what_the_files_held_is_recorded(recorded, tmp_path):
    held = sha256((tmp_path / "physics.py").read_bytes()).hexdigest()

    assert recorded.header.stand_code_sha256 == {"physics.py:response": held}
