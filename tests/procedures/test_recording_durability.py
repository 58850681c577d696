import errno
import io
import os
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from mcap.reader import make_reader
from recording_examples import FINISHED, HEADER, STARTED_NS, completed, record, run_of, samples

from tumble.drivers.clock import VirtualClock
from tumble.procedures.events import ConditionAnswered
from tumble.procedures.methods.dividing_head.layout import MOUNT
from tumble.procedures.methods.dividing_head.rows import row_of
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.header import header_to_strings
from tumble.procedures.recording.reader import iter_samples, read_recording
from tumble.procedures.recording.writer import Recorder

posix = pytest.mark.skipif(os.name == "nt", reason="Windows lets nobody remove an open file")


def start(path):
    return Recorder(path, HEADER, VirtualClock(wall_start_ns=STARTED_NS))


def ends_of(path):
    """Where the header ends, and where the chunk of each point ends, by the file's own index."""
    with path.open("rb") as stream:
        summary = make_reader(stream).get_summary()
    point_channel = next(channel.id for channel in summary.channels.values() if channel.topic == "/point")
    (header,) = summary.metadata_indexes
    chunks = [index for index in summary.chunk_indexes if point_channel in index.message_index_offsets]
    return header.offset + header.length, [index.chunk_start_offset + index.chunk_length for index in chunks]


def test_a_file_cut_at_any_byte_yields_the_points_before_the_cut(tmp_path):
    path = record(tmp_path / "run.mcap", run_of(2))
    header_end, point_ends = ends_of(path)
    whole = path.stat().st_size
    assert len(point_ends) == 2
    assert read_recording(path).complete

    in_the_index, in_the_data = range(whole - 1, point_ends[-1] + 300, -16), range(point_ends[-1] + 300, -1, -1)
    for size in (*in_the_index, *in_the_data):
        os.truncate(path, size)
        if size < header_end:
            with pytest.raises(RecordingError, match="cut off before its header"):
                read_recording(path)
            continue
        recording = read_recording(path)
        assert recording.points == tuple(completed(index).point for index, end in enumerate(point_ends) if end <= size)
        assert not recording.closed
        assert not recording.complete


def test_samples_of_a_cut_file_are_those_of_its_points(tmp_path):
    path = record(tmp_path / "run.mcap", run_of(4))
    _, point_ends = ends_of(path)

    os.truncate(path, point_ends[2] + 5)

    assert [event.point for event in iter_samples(path)] == [0, 1, 2]


@pytest.fixture(scope="module")
def short_run(tmp_path_factory):
    return record(tmp_path_factory.mktemp("short") / "run.mcap", run_of(3))


@given(data=st.data())
def test_a_damaged_byte_never_yields_a_wrong_point(data, short_run):
    header_end, point_ends = ends_of(short_run)
    content = bytearray(short_run.read_bytes())
    place = data.draw(st.integers(header_end, point_ends[-1] - 1))
    content[place] ^= data.draw(st.integers(1, 255))
    damaged = short_run.with_name("damaged.mcap")
    damaged.write_bytes(content)

    points = read_recording(damaged).points

    assert {row_of(point) for point in points} <= {row_of(completed(index).point) for index in range(3)}
    before = sum(end <= place for end in point_ends)
    assert [point.index for point in points[:before]] == list(range(before))


def test_a_damaged_programme_is_said(short_run):
    damaged = short_run.with_name("damaged.mcap")
    damaged.write_bytes(short_run.read_bytes().replace(b'name = "sweep"', b'name = "\xffweep"'))

    with pytest.raises(RecordingError, match=r"UnicodeDecodeError.*; it was altered or written by another program"):
        read_recording(damaged)


@given(garbage=st.binary(max_size=300), begin=st.sampled_from([b"", b"\x89MCAP0\r\n"]))
def test_garbage_is_no_recording(garbage, begin, tmp_path_factory):
    path = tmp_path_factory.getbasetemp() / "garbage.mcap"
    path.write_bytes(begin + garbage)

    with pytest.raises(RecordingError, match=r"garbage\.mcap: is not a recording"):
        read_recording(path)
    with pytest.raises(RecordingError, match="is not a recording"):
        next(iter_samples(path))


@pytest.mark.parametrize(
    "event", [completed(0), ConditionAnswered(condition=MOUNT, value="end", answer="yes", confirmed=True), FINISHED]
)
def test_what_was_completed_is_on_the_disk_before_record_returns(event, tmp_path, monkeypatch):
    synchronised = []
    fsync = os.fsync
    path = tmp_path / "run.mcap"
    with start(path) as recorder:
        monkeypatch.setattr(os, "fsync", lambda fd: (fsync(fd), synchronised.append(path.stat().st_size)))

        recorder.record(event)

        assert synchronised == [path.stat().st_size]
        recording = read_recording(path)
        assert len(recording.points) + len(recording.answers) + len(recording.events) == 1


RUN_UNTIL_KILLED = """
import itertools, sys
from pathlib import Path
sys.path.insert(0, sys.argv[2])
from recording_examples import HEADER, completed, samples
from tumble.drivers.clock import VirtualClock
from tumble.procedures.recording.writer import Recorder

with Recorder(Path(sys.argv[1]), HEADER, VirtualClock()) as recorder:
    for index in itertools.count():
        recorder.record(samples(index))
        recorder.record(completed(index))
        print(index, flush=True)
"""


def test_a_killed_process_loses_no_completed_point(tmp_path):
    path = tmp_path / "run.mcap"
    here = str(Path(__file__).parent)
    with subprocess.Popen(
        [sys.executable, "-c", RUN_UNTIL_KILLED, str(path), here], stdout=subprocess.PIPE, text=True
    ) as process:
        while int(process.stdout.readline()) < 25:
            pass
        process.kill()
        last = max([25, *(int(line) for line in process.stdout.read().split())])

    recording = read_recording(path)

    assert [point.index for point in recording.points][: last + 1] == list(range(last + 1))
    assert not recording.complete


class SmallDisk(io.FileIO):
    """A file on a disk that is full after `room` bytes; a write that does not fit is done in part."""

    room = 0

    def write(self, data):
        if not self.room:
            raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
        written = super().write(memoryview(data)[: self.room])
        self.room -= written
        return written


def open_on_disk_with(room):
    def opened(path, mode):
        raw = SmallDisk(path, mode)
        raw.room = room
        return io.BufferedWriter(raw)

    return opened


@pytest.mark.parametrize("room", range(0, 9000, 250))
def test_a_full_disk_is_said_and_leaves_what_was_recorded(room, tmp_path, monkeypatch):
    path = tmp_path / "run.mcap"
    recorded = 0
    with (
        monkeypatch.context() as patch,
        pytest.raises(RecordingError, match=r"run\.mcap: cannot be written \(No space"),
    ):
        patch.setattr(Path, "open", open_on_disk_with(room))
        recorder = start(path)
        with recorder:
            for index in range(40):
                recorder.record(samples(index))
                recorder.record(completed(index))
                recorded += 1

    if recorded:
        recording = read_recording(path)
        assert recorded <= len(recording.points) <= recorded + 1
        assert not recording.complete


def test_nothing_can_be_recorded_after_the_disk_failed(tmp_path, monkeypatch):
    recorder = start(tmp_path / "run.mcap")
    monkeypatch.setattr(os, "fsync", lambda fd: (_ for _ in ()).throw(OSError(errno.EIO, "Input/output error")))
    with pytest.raises(RecordingError, match="Input/output error"):
        recorder.record(completed(0))

    with pytest.raises(RecordingError, match="is closed already; start another recording"):
        recorder.record(completed(1))


def test_closing_twice_does_nothing(tmp_path):
    path = tmp_path / "run.mcap"
    recorder = start(path)
    recorder.record(completed(0))
    recorder.close()
    content = path.read_bytes()

    recorder.close()

    assert path.read_bytes() == content


def test_an_existing_file_is_not_overwritten(tmp_path):
    path = tmp_path / "run.mcap"
    path.write_text("precious")

    with pytest.raises(RecordingError, match=r"run\.mcap: exists already; .* choose another name"):
        start(path)

    assert path.read_text() == "precious"


def test_a_folder_that_does_not_exist_is_said(tmp_path):
    with pytest.raises(RecordingError, match=r"cannot be written .*; make sure that the folder exists"):
        start(tmp_path / "nowhere" / "run.mcap")


def test_a_run_that_breaks_leaves_a_closed_file_that_is_not_complete(tmp_path):
    path = tmp_path / "run.mcap"
    with pytest.raises(KeyboardInterrupt), start(path) as recorder:
        recorder.record(completed(0))
        raise KeyboardInterrupt

    recording = read_recording(path)

    assert recording.closed
    assert not recording.finished
    assert not recording.complete


def test_a_file_that_is_not_there_is_said(tmp_path):
    with pytest.raises(RecordingError, match=r"none\.mcap: cannot be read \(.*\); check the name"):
        read_recording(tmp_path / "none.mcap")


def test_a_recording_of_a_newer_format_is_refused(tmp_path):
    path = record(tmp_path / "run.mcap", [], header=replace(HEADER, format_version=5, program_version="9.1"))

    with pytest.raises(RecordingError, match=r"format version 5, .* up to 4; read it with tumble 9\.1 or newer"):
        read_recording(path)


def test_a_header_without_one_of_its_fields_is_said(tmp_path, monkeypatch):
    strings = header_to_strings(HEADER)
    del strings["operator"]
    monkeypatch.setattr("tumble.procedures.recording.writer.header_to_strings", lambda header: strings)
    path = record(tmp_path / "run.mcap", [])

    with pytest.raises(RecordingError, match="KeyError: 'operator'"):
        read_recording(path)


@posix
@pytest.mark.parametrize("folder_too", [False, True])
def test_a_recording_that_is_removed_under_way_is_put_back_with_all_its_points(tmp_path, folder_too):
    path = tmp_path / "folder" / "run.mcap"
    path.parent.mkdir()
    with start(path) as recorder:
        recorder.record(samples(0))
        assert recorder.record(completed(0)) is None
        path.unlink()
        if folder_too:
            path.parent.rmdir()
        recorder.record(samples(1))
        said = recorder.record(completed(1))
        assert [point.index for point in read_recording(path).points] == [0, 1]
        recorder.record(completed(2))
        recorder.record(FINISHED)

    assert said == f"{path}: was removed while it was written, and was put back; leave it there until the run ends"
    recording = read_recording(path)
    assert recording.complete
    assert [point.index for point in recording.points] == [0, 1, 2]
    assert [event.point for event in iter_samples(path)] == [0, 1]


@posix
def test_a_recording_that_is_removed_after_its_last_event_is_put_back(tmp_path):
    path = tmp_path / "run.mcap"
    with start(path) as recorder:
        recorder.record(completed(0))
        recorder.record(FINISHED)
        path.unlink()

    assert read_recording(path).complete


def test_a_recording_that_is_cut_under_way_ends_with_the_points_that_are_left(tmp_path):
    path = tmp_path / "run.mcap"
    recorder = start(path)
    recorder.record(completed(0))
    left = path.stat().st_size
    recorder.record(completed(1))
    written = path.stat().st_size
    os.truncate(path, left)

    with pytest.raises(RecordingError, match=f"was cut from {written} to {left} bytes by another program"):
        recorder.record(completed(2))
    recorder.close()

    assert path.stat().st_size == left
    assert [point.index for point in read_recording(path).points] == [0]


@posix
def test_a_recording_that_is_replaced_by_another_file_is_kept_beside_it(tmp_path):
    path = tmp_path / "run.mcap"
    (tmp_path / "other").write_text("other")
    recorder = start(path)
    recorder.record(completed(0))
    (tmp_path / "other").rename(path)

    with pytest.raises(RecordingError, match=r"was replaced by another file .*kept-.*; give it its name back") as said:
        recorder.record(completed(1))
    recorder.close()

    assert path.read_text() == "other"
    (kept,) = tmp_path.glob("run.kept-*.mcap")
    assert kept.name in str(said.value)
    assert [point.index for point in read_recording(kept).points] == [0, 1]
