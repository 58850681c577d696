import json

import pytest
from app_jobs import STAND, tumble

from tumble.procedures.events import ReadingAnswered, ReadingRequested
from tumble.procedures.recording.reader import read_recording

MANUAL = STAND.replace('driver = "simulated"\nlimits', 'driver = "manual"\nserial = "OG-7"\nlimits')


@pytest.fixture
def manual(write):
    return write("manual.toml", MANUAL)


def run(manual, tiny, tmp_path, *options):
    recording = tmp_path / "x.mcap"
    ran = tumble("run", "--stand", manual, "--programme", tiny, "--serial", "A", "--out", recording, *options)
    return ran, read_recording(recording)


def test_every_reading_is_in_the_recording(manual, tiny, tmp_path, write):
    answers = write("answers.toml", '[mounts]\ndefault = "yes"\n[readings]\ndefault = ""\n2 = "60 00 18"\n')
    ran, recording = run(manual, tiny, tmp_path, "--answers", answers)
    assert ran.status == 0, ran.err
    readings = [answer for answer in recording.answers if isinstance(answer, ReadingAnswered)]
    assert [reading.answer for reading in readings] == ["", "60 00 18", "", "", "", ""]
    assert recording.points[1].positions_deg["head"] == pytest.approx(60.005)
    assert sum(isinstance(event, ReadingRequested) for event in recording.events) == 6


def test_an_unattended_run_without_readings_ends_at_the_first(manual, tiny, tmp_path, write):
    ran, recording = run(manual, tiny, tmp_path, "--answers", write("answers.toml", '[mounts]\ndefault = "yes"\n'))
    assert ran.status == 2
    assert ran.complaint.startswith("the request to set the head to 0° 00′ 00″ was not answered; set it and resume")
    assert recording.points == ()


def test_a_run_by_hand_goes_on_after_it_ended_early(manual, tiny, tmp_path, write):
    answers = write("answers.toml", '[mounts]\ndefault = "yes"\n[readings]\n1 = ""\n2 = "59"\n3 = "59"\n4 = ""\n')
    ran, recording = run(manual, tiny, tmp_path, "--answers", answers)
    assert (ran.status, len(recording.points)) == (2, 3)
    resumed = tumble("resume", tmp_path / "x.mcap", "--json", "-")
    assert resumed.status == 0, resumed.err
    assert json.loads(resumed.out)["points"] == 6
    assert read_recording(tmp_path / "x.mcap").points[1].positions_deg["head"] == 59.0


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (('[head]\ndriver = "simulated"', '[head]\ndriver = "zaber"'), "the driver zaber needs a url"),
        (
            ('[head]\ndriver = "simulated"', '[head]\ndriver = "cia402"'),
            "the driver cia402 needs interface and",
        ),
        (
            ('[head]\ndriver = "simulated"', '[head]\ndriver = "zaber"\nurl = "COM3"'),
            "a simulated head and a simulated daq belong together",
        ),
        (
            ('[daq]\ndriver = "simulated"', '[daq]\ndriver = "scpi"\nurl = "COM3"'),
            "a simulated head and a simulated daq belong together",
        ),
        (("[head]\n", "[head]\ncable_turns = 0\n"), "cable_turns: Input should be greater than 0"),
    ],
)
def test_a_stand_whose_instruments_cannot_be_reached_is_refused(write, tiny, tmp_path, change, complaint):
    assert STAND.count(change[0]) == 1
    stand = write("bad.toml", STAND.replace(*change))
    ran = tumble("run", "--stand", stand, "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap")
    assert ran.status == 2
    assert complaint in ran.complaint


def test_a_cable_that_allows_less_than_the_programme_is_told_in_the_plan(write, tiny):
    stand = write("short.toml", STAND.replace("[head]\n", "[head]\ncable_turns = 0.5\n"))
    ran = tumble("plan", tiny, "--stand", stand)
    assert ran.status == 2
    assert "the sweep goes to 240 deg, and the cable allows 0.5 turns to either side of zero" in ran.complaint


def test_an_instrument_that_is_not_there_is_status_3_before_anything_is_recorded(write, tiny, tmp_path):
    text = STAND.replace('driver = "simulated"\nlimits', 'driver = "zaber"\nurl = "socket://127.0.0.1:1"\nlimits')
    text = text.replace('[daq]\ndriver = "simulated"', '[daq]\ndriver = "scpi"\nurl = "socket://127.0.0.1:1"')
    ran = tumble(
        "run", "--stand", write("real.toml", text), "--programme", tiny, "--serial", "A", "--out", tmp_path / "x.mcap"
    )  # fmt: skip
    assert ran.status == 3
    assert "cannot be reached at socket://127.0.0.1:1" in ran.complaint
    assert not (tmp_path / "x.mcap").exists()
