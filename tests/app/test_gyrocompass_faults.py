"""What may go wrong while a gyro platform is measured: the run goes on, or ends at a standstill that is read back."""

import re

import numpy as np
import pytest
from gyro_line_stand import PROGRAMME, line_stand

from tumble.procedures.events import PointCompleted, StepStarted, WarningRaised
from tumble.procedures.operator import Answers, ScriptedOperator
from tumble.procedures.programmes import programme_from_text
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.reader import read_recording

FOR_EVER = 1_000_000
SECOND_DWELL = {"time_s": 14.0}
"""While it is waited for, at its place."""


def stands(stand):
    return not stand.world.head.status().moving


@pytest.mark.parametrize(
    ("kind", "sentence"),
    [
        ("power_loss", "gave no answer, and did not come back within 30 s"),
        ("garble", "say nothing"),
        ("wrong_checksum", "lines with a wrong checksum dropped"),
        ("cut", "gave no answer, and did not come back within 30 s"),
        ("double", "did not follow the one before, twice in a row"),
        ("stale", "did not follow the one before, twice in a row"),
        ("frames_lost", "gave no answer, and did not come back within 30 s"),
    ],
)
def test_a_platform_that_fails_for_good_ends_the_run_at_a_standstill(kind, sentence, tmp_path):
    stand = line_stand({"kind": kind, "at": SECOND_DWELL, "times": FOR_EVER, "lasts_s": 1e9})
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, outcome.at_standstill, stands(stand)) == (3, True, True)
    assert sentence in outcome.message
    assert len(read_recording(tmp_path / "r.mcap").points) == len(outcome.points) == 1


@pytest.mark.parametrize("kind", ["nan", "other_unit"])
def test_a_platform_without_usable_values_ends_the_run_after_half_a_minute(kind, tmp_path):
    patient = PROGRAMME.replace("settle_timeout_s = 8.0", "settle_timeout_s = 40.0")
    stand = line_stand({"kind": kind, "at": SECOND_DWELL, "times": FOR_EVER}, programme=patient)
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, outcome.at_standstill, stands(stand)) == (3, True, True)
    assert "levelling_rate_deg_h has had no value between -400 and 400" in outcome.message


@pytest.mark.parametrize(
    ("turntable", "status", "sentence"),
    [
        ("stalls", 3, r"azimuth \(turntable\): has stalled; look what blocks it"),
        ("refuses", 3, r"azimuth \(turntable\): refused the move"),
        ("elsewhere", 3, "deg"),
        ("away for ever", 3, "did not come back within 30 s"),
        ("swapped", 3, "is turntable .*T2.*, and the run was begun with turntable .*T1"),
        ("moves for ever", 3, "standstill could not be read back"),
        ("broken driver", 70, "a fault of the program: ZeroDivisionError"),
    ],
)
def test_a_turntable_that_fails_ends_the_run(turntable, status, sentence, tmp_path):
    stand = line_stand(turntable=turntable)
    given, outcome = stand.run(tmp_path / "r.mcap")
    read_back = turntable not in ("away for ever", "moves for ever")
    assert (given, outcome.at_standstill) == (status, read_back)
    assert re.search(sentence, outcome.message)
    assert stands(stand)


@pytest.mark.parametrize("turntable", ["away", "unreferenced"])
def test_a_turntable_that_comes_back_goes_on(turntable, tmp_path):
    stand = line_stand(turntable=turntable)
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, [point.positions_deg["azimuth"] for point in outcome.points]) == (0, [0.0, 180.0, 90.0])


@pytest.mark.parametrize("kind", ["garble", "wrong_checksum", "cut", "stale", "double", "frames_lost"])
def test_a_platform_that_fails_once_loses_nothing(kind, tmp_path):
    stand = line_stand({"kind": kind, "at": {"time_s": 8.5}})
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, len(outcome.points)) == (0, 3)
    assert all(point.settled and np.isfinite(point.readings["levelling_rate_deg_h"].mean) for point in outcome.points)


def test_a_platform_without_power_for_a_while_goes_on(tmp_path):
    stand = line_stand({"kind": "power_loss", "at": SECOND_DWELL, "lasts_s": 12.0})
    told = []
    status, outcome = stand.run(tmp_path / "r.mcap", [told.append])
    assert (status, len(outcome.points)) == (0, 3)
    assert any("is back after" in event.message for event in told if isinstance(event, WarningRaised))


def test_another_platform_in_its_place_ends_the_run(tmp_path):
    stand = line_stand(
        {"kind": "power_loss", "at": SECOND_DWELL, "lasts_s": 12.0}, {"kind": "swapped", "at": SECOND_DWELL}
    )
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, outcome.at_standstill) == (3, True)
    assert "90002" in outcome.message and "90001" in outcome.message


@pytest.mark.parametrize(("gone_s", "status", "points"), [(10.0, 0, 3), (1e9, 3, 2)])
def test_a_line_that_is_lost_is_waited_for(gone_s, status, points, tmp_path):
    stand = line_stand()

    def lose(event):
        if isinstance(event, PointCompleted) and event.point.index == 1:
            stand.line.lose(gone_s)

    given, outcome = stand.run(tmp_path / "r.mcap", [lose])
    assert (given, len(outcome.points), outcome.at_standstill) == (status, points, True)


def test_a_single_number_that_is_none_has_its_point_set_aside(tmp_path):
    stand = line_stand({"kind": "nan", "at": {"time_s": 10.5}})
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, len(outcome.points)) == (0, 3)
    assert sum(np.isnan(point.readings["levelling_rate_deg_h"].mean) for point in outcome.points) == 1


def test_a_lean_that_nobody_makes_ends_the_run(tmp_path):
    text = PROGRAMME + 'base = 1\n\n[[procedure]]\npositions = "0/90"\nbase = 2\n'
    answers = Answers(mounts={"1": "yes", "2": "no"})
    stand = line_stand(programme=text, operator=ScriptedOperator(answers))
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, outcome.at_standstill, len(outcome.points)) == (2, True, 3)
    assert "lean the base as number 2 was answered 'no'; lean it and resume the run" in outcome.message


def test_a_stop_ends_the_run_wherever_the_turntable_is(tmp_path):
    stand = line_stand()

    def stop(event):
        if isinstance(event, StepStarted) and event.step.targets_deg["azimuth"] == 90.0:
            stand.connected.control.stop()

    status, outcome = stand.run(tmp_path / "r.mcap", [stop])
    assert (status, outcome.at_standstill, stands(stand)) == (4, True, True)


def test_a_full_disk_ends_the_run_at_a_standstill(tmp_path, monkeypatch):
    from tumble.procedures.recording.writer import Recorder

    record = Recorder.record

    def full(self, event):
        if isinstance(event, PointCompleted) and event.point.index == 2:
            raise RecordingError("the disk is full; make room")
        record(self, event)

    monkeypatch.setattr(Recorder, "record", full)
    stand = line_stand()
    status, outcome = stand.run(tmp_path / "r.mcap")
    assert (status, outcome.at_standstill, stands(stand)) == (5, True, True)


def test_a_platform_that_does_not_level_has_its_points_marked(tmp_path):
    """A loop so slow that it is still on its way when nobody waits any longer."""
    stand = line_stand(world={"levelling_tau_s": 200.0, "range_deg_h": 1e9})
    told = []
    stand.run(tmp_path / "r.mcap", [told.append])
    assert any("had not settled after 8 s" in event.message for event in told if isinstance(event, WarningRaised))


def test_a_stand_without_a_latitude_is_refused_before_anything_moves():
    from tumble.app.running import Outline
    from tumble.procedures.errors import ProgrammeError

    stand = line_stand()
    recorded = {**stand.job.stand.recorded, "site": {"height_m": 180.0}}
    lacking = type(stand.job.stand)(**vars(stand.job.stand) | {"recorded": recorded})
    with pytest.raises(ProgrammeError, match=r"gyrocompassing needs the latitude; add latitude_deg to \[site\]"):
        Outline(stand=lacking, programme=programme_from_text(PROGRAMME, "p.toml")).plan()
