"""A point that is taken again, by each method: both readings are kept, the later one counts, and that is told."""

import csv

import pytest
from app_jobs import take_again_once, tumble

from tumble.app.measurements import read_measurement
from tumble.procedures.recording.reader import iter_samples, read_recording

SHAKEN = """method = "vibration"
name = "shaken"
dwell_s = 1.0

[[procedure]]
levels_g = [3.0, 5.0]
frequencies_Hz = [81.3]
"""
PROGRAMMES = {"dividing_head": "quick", "triad": "6", "gyrocompass": "0-120-240", "vibration": "shaken.toml"}


@pytest.fixture(params=PROGRAMMES, scope="module")
def ran(request, tmp_path_factory):
    """A recording in which the third point was taken twice."""
    path = tmp_path_factory.mktemp(request.param) / "run.mcap"
    path.with_name("shaken.toml").write_text(SHAKEN, "utf-8")
    with pytest.MonkeyPatch.context() as patched:
        patched.chdir(path.parent)
        take_again_once(patched, 2)
        done = tumble("run", "--programme", PROGRAMMES[request.param], "--serial", "A", "--out", path)
    assert done.status == 0, done.err
    return path


def test_each_method_has_the_later_reading_and_keeps_the_former(ran):
    recording = read_recording(ran)
    takes = [point.take for point in recording.points]
    assert (takes[2], sum(takes)) == (2, len(takes) + 1)
    assert recording.complete
    taken = [(event.point, event.take) for event in iter_samples(ran)]
    assert {(2, 1), (2, 2)} <= set(taken)


def test_each_method_has_the_time_of_the_later_reading_in_its_row(ran):
    rows, points = read_measurement(ran).observations, read_recording(ran).points
    (row,) = [place for place, number in enumerate(rows.row.tolist()) if number == 3]
    assert rows.time_s[row] == pytest.approx(points[2].time_s)
    assert rows.take[row] == 2
    began_s = {event.take: event.time_s for event in iter_samples(ran) if event.point == 2}
    assert began_s[1] < began_s[2] < points[2].time_s


def test_each_table_and_the_warnings_of_each_method_say_so(ran, tmp_path):
    for _ in range(2):  # the second one takes the place of the first, which is known as a table of a recording
        done = tumble("export", ran, "--out", tmp_path / "table.csv")
        assert done.status == 0, done.err
    assert "was taken again as the operator wished; the later reading is used" in done.err
    with (tmp_path / "table.csv").open(encoding="utf-8", newline="") as table:
        takes = [row["take"] for row in csv.DictReader(table)]
    assert takes.count("2") == 1
    assert set(takes) == {"1", "2"}
