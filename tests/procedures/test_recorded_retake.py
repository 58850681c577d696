"""Points that were taken again, in recordings and tables."""

from dataclasses import replace

import orjson
import pytest
from mcap.reader import make_reader
from recording_examples import FINISHED, HEADER, completed, record, run_of, samples

from tumble.calibrations.core.table import read_rows, write_table
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.drivers.clock import VirtualClock
from tumble.procedures.events import RetakeBegun
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.recording.reader import complete_messages, iter_samples, read_recording
from tumble.procedures.recording.writer import Recorder

AGAIN = [
    RetakeBegun(point=1),
    replace(samples(1, (2.6, 2.6001)), take=2),
    completed(1, voltage_v=2.6, take=2),
]
"""What the recording of a run says of a point that is taken again."""


@pytest.fixture
def retaken(tmp_path):
    """A run of three points whose second one was taken twice."""
    whole = run_of(3)
    after = whole.index(completed(1)) + 1
    return record(tmp_path / "run.mcap", [*whole[:after], *AGAIN, *whole[after:]])


def messages(path, topic):
    with path.open("rb") as stream:
        return [orjson.loads(message.data) for _, _, message in make_reader(stream).iter_messages([topic])]


def test_the_later_reading_is_the_point(retaken):
    recording = read_recording(retaken)
    assert [(point.index, point.take) for point in recording.points] == [(0, 1), (1, 2), (2, 1)]
    means_v = [point.readings["voltage_v"].mean for point in recording.points]
    assert means_v == [2.5001234567890123, 2.6, 2.5001234567890123]
    assert RetakeBegun(point=1) in recording.events
    assert recording.complete


def test_both_readings_are_in_the_file_with_their_samples(retaken):
    assert [(row["index"], row["voltage_v"], row.get("take")) for row in messages(retaken, "/point")] == [
        (0, 2.5001234567890123, None),
        (1, 2.5001234567890123, None),
        (1, 2.6, 2),
        (2, 2.5001234567890123, None),
    ]
    assert [(event.point, event.take, len(event.block.voltage_v)) for event in iter_samples(retaken)] == [
        (0, 1, 3),
        (1, 1, 3),
        (1, 2, 2),
        (2, 1, 3),
    ]
    assert [row.get("take") for row in messages(retaken, "/head")] == [None, None, 2, None]


def test_the_table_says_which_rows_were_taken_again(retaken, tmp_path):
    table = observations(read_recording(retaken))
    assert table.take.tolist() == [1, 2, 1]
    write_table(table, tmp_path / "table.csv")
    assert read_rows(tmp_path / "table.csv", Observations).take.tolist() == [1, 2, 1]


def test_a_table_of_a_run_without_such_a_point_is_as_ever(tmp_path):
    table = observations(read_recording(record(tmp_path / "run.mcap", run_of(2))))
    assert table.take is None
    write_table(table, tmp_path / "table.csv")
    assert "take" not in (tmp_path / "table.csv").read_text("utf-8").splitlines()[0].split(",")


def go_on(path, target):
    """What a run that goes on begins its file with."""
    recording = read_recording(path)
    with Recorder(target, HEADER, VirtualClock(wall_start_ns=0), complete_messages(recording)):
        return target


def test_a_run_that_goes_on_keeps_both_readings(retaken, tmp_path):
    again = go_on(retaken, tmp_path / "again.mcap")
    assert read_recording(again).points == read_recording(retaken).points
    assert messages(again, "/point") == messages(retaken, "/point")
    assert len(list(iter_samples(again))) == 4


@pytest.mark.parametrize("kept", [1, 2], ids=["begun", "sampled"])
def test_of_a_retake_that_was_cut_off_nothing_counts(tmp_path, kept):
    broken = record(tmp_path / "run.mcap", [*run_of(2)[:-1], *AGAIN[:kept]])
    again = go_on(broken, tmp_path / "again.mcap")
    assert [(point.index, point.take) for point in read_recording(again).points] == [(0, 1), (1, 1)]
    assert [(event.point, event.take) for event in iter_samples(again)] == [(0, 1), (1, 1)]


def test_a_point_can_be_taken_many_times(tmp_path):
    takes = [completed(0, voltage_v=float(take), take=take) for take in (1, 2, 3)]
    (point,) = read_recording(record(tmp_path / "run.mcap", [*takes, FINISHED])).points
    assert (point.take, point.readings["voltage_v"].mean) == (3, 3.0)
