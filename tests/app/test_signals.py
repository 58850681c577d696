"""A signal ends every command, in whatever phase it is, with status 4 and a sentence."""

import signal
from contextlib import suppress

import pytest
from app_jobs import STAND, tumble

from tumble.app.guarding import connected
from tumble.app.signals import STOPPING_SIGNALS, interrupting
from tumble.drivers.errors import Interrupted
from tumble.drivers.own_file import load_from_file
from tumble.drivers.simulated.external import load_function

SIGNALS = [pytest.param(number, id=signal.Signals(number).name) for number in STOPPING_SIGNALS]
TABLE = "angle_deg,voltage_V\n" + "".join(f"{10 * n},{2.5 + 0.01 * n}\n" for n in range(37))


def raising(number=signal.SIGTERM):
    def raise_it(*_arguments, **_named):
        signal.raise_signal(number)

    return raise_it


@pytest.mark.parametrize("number", SIGNALS)
def test_every_signal_ends_a_command(monkeypatch, number):
    before = signal.getsignal(number)
    monkeypatch.setattr("tumble.app.commands.plan._summary", raising(number))
    ran = tumble("plan", "quick")

    assert ran.status == 4
    assert ran.complaint == (f"interrupted by {signal.Signals(number).name}; a recording keeps its complete points")
    assert signal.getsignal(number) == before


RUN = ["run", "--programme", "T", "--serial", "A"]
PHASES = {
    "planning": ("tumble.app.running.plan", ["plan", "quick"]),
    "reading a programme": ("tumble.app.commands.measuring.load_programme", RUN),
    "loading the stand": ("tumble.app.commands.measuring.load_stand", RUN),
    "connecting": ("tumble.app.commands.measuring.connect", RUN),
    "opening the recording": (
        "tumble.app.running.begin_recording",
        [*RUN, "--store", "s"],
    ),
    "reading a table": ("tumble.app.commands.fit.read_measurement", ["fit", "t.csv"]),
    "fitting": ("tumble.app.commands.fit.fit", ["fit", "t.csv"]),
    "Monte Carlo": ("tumble.calibrations.methods.dividing_head.analysis.monte_carlo", ["fit", "t.csv"]),
    "tracing": ("tumble.app.commands.close_loop.trace", ["close-loop", "t.csv"]),
    "fitting a calibration": (
        "tumble.app.calibrating.fit",
        ["calibrate", *RUN[1:], "--store", "s"],
    ),
    "storing": ("tumble.app.calibrating.store", ["calibrate", *RUN[1:], "--store", "s"]),
    "reporting": ("tumble.app.calibrating.write_report", ["report", "t.csv", "--store", "s"]),
    "writing a result": ("tumble.app.commands.options.write_text", ["plan", "quick", "--json", "p.json"]),
    "exporting": ("tumble.app.commands.export.write_table", ["export", "RECORDING", "--out", "o.csv"]),
    "serving": ("tumble.app.commands.emulate.time.sleep", ["emulate", "--head-port", "0", "--daq-port", "0"]),
    "emulating": ("tumble.app.commands.emulate.emulate", ["emulate"]),
    "opening a store": ("tumble.app.commands.records.open_store", ["records", "list"]),
    "verifying": ("tumble.app.commands.records.verified_record", ["records", "verify", "--store", "STORE"]),
    "listing stand records": ("tumble.app.commands.stand.list_stand_records", ["stand", "list"]),
    "looking for what is cut off": ("tumble.app.commands.resume.find", ["resume", "RECORDING"]),
}


@pytest.mark.parametrize(("place", "arguments"), PHASES.values(), ids=PHASES)
def test_every_phase_of_every_command_is_ended(
    write, tiny, tiny_recording, calibrated, tmp_path, monkeypatch, place, arguments
):
    monkeypatch.chdir(tmp_path)
    write("t.csv", TABLE)
    monkeypatch.setattr(place, raising())
    known = {"T": tiny, "RECORDING": tiny_recording, "STORE": calibrated.store}
    ran = tumble(*(known.get(argument, argument) for argument in arguments))

    assert ran.status == 4
    assert ran.err.splitlines()[-1] == "tumble: interrupted by SIGTERM; a recording keeps its complete points"
    assert "Traceback" not in ran.err


def test_a_signal_at_a_prompt_ends_the_run_at_a_standstill(write, tiny, tmp_path, monkeypatch):
    monkeypatch.setattr("tumble.procedures.operator.ScriptedOperator.ask", raising())
    answers = write("answers.toml", '[mounts]\ndefault = "yes"\n')
    stand = write("bench.toml", STAND)
    recording = tmp_path / "x.mcap"
    ran = tumble(
        "run", "--stand", stand, "--programme", tiny, "--serial", "A", "--answers", answers, "--out", recording
    )

    assert ran.status == 4
    assert "the operator stopped the run; 0 complete points kept" in ran.complaint


def test_a_second_signal_does_not_disturb_what_clears_up_after_the_first():
    with pytest.raises(Interrupted, match="SIGTERM"), interrupting():
        try:
            signal.raise_signal(signal.SIGTERM)
        finally:
            signal.raise_signal(signal.SIGTERM)


def test_a_second_interrupt_from_the_keyboard_does():
    with pytest.raises(Interrupted, match="SIGINT"), interrupting():
        try:
            signal.raise_signal(signal.SIGTERM)
        finally:
            signal.raise_signal(signal.SIGINT)


def test_an_interrupt_that_somebody_swallowed_is_told_at_the_end():
    with pytest.raises(Interrupted), interrupting(), suppress(KeyboardInterrupt):
        signal.raise_signal(signal.SIGTERM)


PRESSED = "import signal\nsignal.raise_signal(signal.SIGINT)\n"


def test_ctrl_c_in_a_python_session_is_no_fault_of_the_file_that_is_loaded(write, tmp_path):
    write("lab.py", PRESSED)
    with pytest.raises(KeyboardInterrupt):
        load_from_file("lab.py:HEAD", tmp_path)


def test_ctrl_c_in_a_python_session_is_no_fault_of_the_physics(write, tmp_path):
    write("physics.py", f"def response(*_):\n    {PRESSED.replace(chr(10), ';')}\n")
    with pytest.raises(KeyboardInterrupt):
        load_function("physics.py:response", tmp_path)(0.0)


def test_ctrl_c_in_a_python_session_is_no_fault_of_a_driver():
    with pytest.raises(KeyboardInterrupt):
        connected(raising(signal.SIGINT), "lab.py:HEAD", "head", frozenset())


def test_what_a_file_raises_is_its_own_fault_where_signals_are_told_apart(write, tmp_path):
    write("lab.py", "raise KeyboardInterrupt\n")
    with pytest.raises(ValueError, match=r"could not be loaded \(KeyboardInterrupt"), interrupting():
        load_from_file("lab.py:HEAD", tmp_path)
