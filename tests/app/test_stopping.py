import signal

import pytest
from app_jobs import at_call, raiser, tumble

from tumble.app.running import Job, failure, run
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.calibrations.records.store import Store
from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.drivers.simulated.head import SimulatedHead
from tumble.messages import Language
from tumble.procedures.events import FinishReason, PointCompleted, State, StateChanged
from tumble.procedures.programmes import load_programme
from tumble.procedures.recording.reader import read_recording

LOST = DeviceError("voltmeter", "does not answer", "check its cable, then resume the run")


def run_tiny(tiny, tmp_path):
    recording = tmp_path / "x.mcap"
    return tumble("run", "--programme", tiny, "--serial", "A", "--out", recording), recording


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, getattr(signal, "SIGHUP", signal.SIGTERM)])
def test_a_signal_stops_the_run_at_a_standstill_and_keeps_the_points(tiny, tmp_path, monkeypatch, number):
    before = signal.getsignal(number)
    at_call(monkeypatch, SimulatedHead, "start_move", 4, lambda: signal.raise_signal(number), last=4)

    ran, recording = run_tiny(tiny, tmp_path)

    found = read_recording(recording)
    assert ran.status == 4
    assert (
        ran.complaint == f"the operator stopped the run; 3 complete points kept in {recording}; tumble resume goes on"
    )
    assert len(found.points) == 3
    assert found.closed
    assert found.ending.reason is FinishReason.STOPPED
    assert found.ending.at_standstill
    assert found.events[-2] == StateChanged(state=State.STANDSTILL, reason="the operator stopped the run")
    assert signal.getsignal(number) == before


def test_a_second_interrupt_ends_the_run_at_once_still_at_a_standstill(tiny, tmp_path):
    stand = load_stand()
    job = Job(stand=stand, programme=load_programme(tiny), serial_number="A")
    recording = tmp_path / "x.mcap"

    def interrupt(event):
        if isinstance(event, PointCompleted) and event.point.index == 1:
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)

    outcome = run(job, connect(stand), recording, [interrupt])

    assert outcome.reason is FinishReason.STOPPED
    assert outcome.at_standstill
    assert failure(outcome, recording).status == 4
    assert len(read_recording(recording).points) == 2


@pytest.mark.parametrize("state", [State.STOPPING, State.STANDSTILL])
def test_interrupts_while_the_run_is_being_ended_do_not_keep_it_from_its_end(tiny, tmp_path, state):
    job = Job(stand=load_stand(), programme=load_programme(tiny), serial_number="A")
    recording = tmp_path / "x.mcap"

    def interrupt(event):
        if isinstance(event, PointCompleted) and event.point.index == 1:
            signal.raise_signal(signal.SIGINT)
        if event == StateChanged(state=state, reason="the operator stopped the run"):
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)

    outcome = run(job, connect(job.stand), recording, [interrupt])

    assert outcome.at_standstill
    assert outcome.message == "the operator stopped the run"
    assert read_recording(recording).ending.at_standstill


def test_calibrate_that_is_stopped_stores_nothing(tiny, tmp_path, monkeypatch):
    at_call(monkeypatch, SimulatedHead, "start_move", 4, lambda: signal.raise_signal(signal.SIGINT), last=4)

    ran = tumble("calibrate", "--programme", tiny, "--serial", "A", "--store", tmp_path)

    assert ran.status == 4
    assert Store.existing(tmp_path).find() == ()
    assert len(list(tmp_path.glob("recordings/A/*.mcap"))) == 1


def test_a_run_that_was_stopped_is_fitted_as_incomplete(tiny, tmp_path, monkeypatch):
    at_call(monkeypatch, SimulatedHead, "start_move", 6, lambda: signal.raise_signal(signal.SIGTERM), last=6)
    _, recording = run_tiny(tiny, tmp_path)

    ran = tumble("fit", recording)

    assert ran.status == 0
    assert "holds a run that ended early (stopped by the operator); its 5 complete points are used" in ran.err


def test_an_instrument_that_fails_is_status_3_and_the_points_are_kept(tiny, tmp_path, monkeypatch):
    # Every point takes two blocks to settle, and the dwell.
    at_call(monkeypatch, SimulatedDaq, "acquire", 3 * 2 + 1, raiser(LOST))

    ran, recording = run_tiny(tiny, tmp_path)

    found = read_recording(recording)
    assert ran.status == 3
    assert ran.complaint == (
        f"voltmeter: does not answer; check its cable, then resume the run; 2 complete points kept in {recording}"
    )
    assert len(found.points) == 2
    assert found.ending.at_standstill


def test_a_head_that_falls_silent_is_status_3_and_nobody_claims_a_standstill(tiny, tmp_path, monkeypatch):
    at_call(monkeypatch, SimulatedHead, "status", 20, raiser(LOST))

    ran, recording = run_tiny(tiny, tmp_path)

    assert ran.status == 3
    assert "its standstill could not be read back; look at it before you touch it" in ran.complaint
    assert not read_recording(recording).ending.at_standstill


def test_what_may_still_move_is_told_in_the_language_of_its_reader(tiny, tmp_path, monkeypatch):
    at_call(monkeypatch, SimulatedHead, "status", 20, raiser(LOST))

    _, recording = run_tiny(tiny, tmp_path)

    said = read_recording(recording).ending.message.in_language(Language.GERMAN)
    assert said.endswith("Teilkopf: der Stillstand konnte nicht zurückgelesen werden; vor dem Berühren ansehen")


def test_a_fault_of_the_program_in_a_run_is_status_70_and_the_points_are_kept(tiny, tmp_path, monkeypatch):
    at_call(monkeypatch, SimulatedDaq, "acquire", 3 * 2 + 1, raiser(ZeroDivisionError("division by zero")))

    ran, recording = run_tiny(tiny, tmp_path)

    assert ran.status == 70
    assert "a fault of the program: ZeroDivisionError: division by zero" in ran.complaint
    assert len(read_recording(recording).points) == 2


def test_a_fault_of_the_program_elsewhere_is_status_70_with_its_traceback(tiny_recording, monkeypatch):
    monkeypatch.setattr("tumble.app.commands.fit.fit", raiser(ZeroDivisionError("division by zero")))

    ran = tumble("fit", tiny_recording)

    assert ran.status == 70
    assert "ZeroDivisionError: division by zero" in ran.err
    assert ran.err.splitlines()[-1] == "tumble: a fault of the program; report it with the lines above"


def test_an_interrupt_outside_a_run_is_status_4(tiny_recording, monkeypatch):
    monkeypatch.setattr("tumble.app.commands.fit.fit", raiser(KeyboardInterrupt()))

    ran = tumble("fit", tiny_recording)

    assert ran.status == 4
    assert ran.err.strip() == "tumble: interrupted; a recording keeps its complete points"
