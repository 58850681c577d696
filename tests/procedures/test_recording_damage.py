"""Recordings that were damaged: what is not as it was written is refused or said, and memory stays within bounds."""

import os
import struct
import tracemalloc
import zlib
from collections import Counter
from dataclasses import replace
from io import BytesIO
from pathlib import Path

import pytest
import zstandard
from mcap.opcode import Opcode
from mcap.writer import Writer
from recording_examples import HEADER, completed, record, run_of, samples

from benchmarks.endurance.flips import flips, places
from tumble.procedures.methods.dividing_head.observations import observations
from tumble.procedures.recording import header as header_module
from tumble.procedures.recording.errors import RecordingError
from tumble.procedures.recording.frames import LARGEST_RECORD, frames
from tumble.procedures.recording.header import Header, header_to_strings, is_intact
from tumble.procedures.recording.reader import complete_messages, iter_samples, leading, read_header, read_recording

FIRST_FORMAT = Path(__file__).parent / "fixtures" / "recording_v1.mcap"


@pytest.fixture
def run(tmp_path):
    return record(tmp_path / "run.mcap", run_of(5))


def chunks(path):
    return [frame for frame in frames(BytesIO(path.read_bytes())) if frame.opcode == Opcode.CHUNK]


def flip(path, place, bit=0):
    content = bytearray(path.read_bytes())
    content[place] ^= 1 << bit
    path.write_bytes(content)


def chunk_of_point(path, index):
    """The chunks: what begins the run, the operator's answer, one per point, the end."""
    return chunks(path)[1 + index]


def as_format_2(monkeypatch):
    """Write recordings as the first version did: no hash, no checksum of the data."""
    monkeypatch.setattr(header_module, "FORMAT_VERSION", 2)
    plain = header_to_strings

    def strings(header):
        return {name: text for name, text in plain(header).items() if name != "header_sha256"}

    monkeypatch.setattr("tumble.procedures.recording.writer.header_to_strings", strings)
    monkeypatch.setattr("tumble.procedures.recording.writer.Writer", lambda stream, **_: Writer(stream))
    return replace(HEADER, format_version=2)


def test_no_flip_of_a_sample_is_silent(run):
    done = list(flips(run, structural=280, header=60, seed=1))

    assert len(done) == 340
    assert {each.kind for each in done} >= {"opcode", "length", "chunk", "message_index", "statistics", "footer"}
    assert Counter(each.outcome for each in done)["silent"] == 0


def test_the_places_of_a_recording_are_all_of_it_but_the_data_of_its_chunks(run):
    content = run.read_bytes()
    covered = sum(place.end - place.begin for place in places(content))
    data = sum(struct.unpack_from("<Q", frame.body, 36)[0] for frame in chunks(run))

    assert covered + data == len(content)


@pytest.mark.parametrize("old", [False, True], ids=["", "format 2"])
def test_a_chunk_that_is_no_longer_known_as_one_leaves_a_point_missing(tmp_path, monkeypatch, old):
    header = as_format_2(monkeypatch) if old else HEADER
    path = record(tmp_path / "run.mcap", run_of(5), header)
    whole = read_recording(path)
    flip(path, chunk_of_point(path, 2).place, bit=7)

    recording = read_recording(path)

    assert whole.complete
    assert recording.points == tuple(point for point in whole.points if point.index != 2)
    assert recording.missing == (2,)
    assert not recording.complete
    assert [event.point for event in iter_samples(path)] == [0, 1, 3, 4]
    (damaged, lacking) = observations(recording).warnings[1:]
    assert "is of no kind that a recording has, messages 16 to 20 are missing" in damaged
    assert "lacks point 2 (counted from 0), recorded before others that are there" in lacking


def test_a_run_goes_on_from_the_points_before_the_one_that_is_missing(run):
    flip(run, chunk_of_point(run, 2).place, bit=7)

    begun = leading(read_recording(run))

    assert [point.index for point in begun.points] == [0, 1]
    assert sum(said.topic == "/point" for said in complete_messages(begun)) == 2


@pytest.mark.parametrize("old", [False, True], ids=["", "format 2"])
def test_a_last_chunk_that_is_lost_is_missed_by_its_number_of_messages(tmp_path, monkeypatch, old):
    header = as_format_2(monkeypatch) if old else HEADER
    path = record(tmp_path / "run.mcap", run_of(2), header)
    flip(path, chunks(path)[-1].place, bit=7)

    recording = read_recording(path)

    assert not recording.closed
    assert any("messages were written to it, and the last that is there is" in what for what in recording.damage)


def test_what_follows_a_damaged_chunk_is_read(run):
    flip(run, chunk_of_point(run, 1).place + 60)

    assert [point.index for point in read_recording(run).points] == [0, 2, 3, 4]


def test_a_block_that_lacks_a_message_in_its_middle_is_left_out(tmp_path):
    from tumble.procedures.recording.blocks import join, split

    first, _, last = split(samples(0, range(2500)))

    assert list(join([first, last])) == []
    assert list(join([last])) == []


@pytest.mark.parametrize("name", ["stand", "serial_number", "started_wall_ns", "header_sha256"])
def test_a_header_with_another_content_is_refused(tmp_path, monkeypatch, name):
    strings = header_to_strings(HEADER)
    changed = {**strings, name: strings[name].replace(strings[name][-4], "3")}
    assert changed != strings
    monkeypatch.setattr("tumble.procedures.recording.writer.header_to_strings", lambda header: changed)
    path = record(tmp_path / "run.mcap", run_of(1))

    with pytest.raises(RecordingError, match=r"has a header that was damaged or altered \(its SHA-256 differs\)"):
        read_recording(path)


def test_a_header_of_this_format_without_its_hash_is_refused(tmp_path, monkeypatch):
    strings = {name: text for name, text in header_to_strings(HEADER).items() if name != "header_sha256"}
    monkeypatch.setattr("tumble.procedures.recording.writer.header_to_strings", lambda header: strings)

    with pytest.raises(RecordingError, match="was damaged or altered"):
        read_recording(record(tmp_path / "run.mcap", []))


def test_a_programme_belongs_to_its_header():
    strings = header_to_strings(HEADER)

    assert is_intact(strings, HEADER.programme_text)
    assert not is_intact(strings, HEADER.programme_text + " ")


def test_a_recording_of_an_older_format_says_that_its_header_is_not_protected(run):
    assert read_header(run).protected
    assert not read_header(FIRST_FORMAT).protected


def test_a_killed_run_has_its_header_protected_from_the_first_moment(tmp_path):
    path = record(tmp_path / "run.mcap", [])
    place = [place for place in places(path.read_bytes()) if place.kind == "header"][-1]
    os.truncate(path, place.end)
    assert read_recording(path).header == HEADER

    flip(path, place.end - 100)

    with pytest.raises(RecordingError):
        read_recording(path)


def chunk(data, *, says, crc=0):
    """A chunk record as a file would hold it."""
    body = struct.pack("<QQQI", 0, 0, says, crc) + struct.pack("<I", 4) + b"zstd" + struct.pack("<Q", len(data)) + data
    return struct.pack("<BQ", Opcode.CHUNK, len(body)) + body


def with_chunk(path, made):
    """Put a chunk in front of the first one."""
    content, place = path.read_bytes(), chunks(path)[0].place
    path.write_bytes(content[:place] + made + content[place:])
    return path


def packed_zeros(size):
    compressor = zstandard.ZstdCompressor().compressobj(size=size)
    block = bytes(2**20)
    return b"".join(compressor.compress(block) for _ in range(size // len(block))) + compressor.flush()


def peak_of(action):
    tracemalloc.start()
    try:
        action()
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_a_chunk_that_would_burst_memory_is_refused_unopened(run):
    size = 256 * 2**20
    with_chunk(run, chunk(packed_zeros(size), says=size))

    def read():
        with pytest.raises(RecordingError, match=r"holds a chunk of 256 MiB, packed into \d+ bytes"):
            read_recording(run)

    assert peak_of(read) < 20e6


@pytest.mark.parametrize("says", [100, 2**40])
def test_a_chunk_that_lies_about_its_size_is_damage(run, says):
    with_chunk(run, chunk(packed_zeros(64 * 2**20), says=says))

    def read():
        recording = read_recording(run)
        assert recording.damage
        assert len(recording.points) == 5

    assert peak_of(read) < 20e6


def test_a_record_that_is_longer_than_any_is_not_read(run):
    place = chunks(run)[0].place
    with run.open("r+b") as file:
        file.seek(place)
        file.write(struct.pack("<BQ", Opcode.CHUNK, LARGEST_RECORD + 1))
        file.truncate(2**36)  # sparse: it takes no room on the disk

    assert peak_of(lambda: read_recording(run)) < 20e6
    assert not read_recording(run).closed


def test_a_file_of_nothing_but_room_is_no_recording(tmp_path):
    path = tmp_path / "run.mcap"
    path.touch()
    os.truncate(path, 2**40)

    with pytest.raises(RecordingError, match="is not a recording"):
        read_recording(path)


@pytest.mark.skipif(os.name == "nt", reason="devices of POSIX")
@pytest.mark.parametrize("make", [os.mkfifo, lambda path: path.symlink_to("/dev/zero")], ids=["pipe", "device"])
def test_a_pipe_or_a_device_is_no_recording(tmp_path, make):
    path = tmp_path / "run.mcap"
    make(path)

    with pytest.raises(RecordingError, match="is no file; name a recording"):
        read_recording(path)


def test_a_run_that_says_more_than_any_does_is_refused(run, monkeypatch):
    monkeypatch.setattr("tumble.procedures.recording.reader._LARGEST_JOURNAL", 1000)

    with pytest.raises(RecordingError, match="more than 0 MiB of its run, samples left out"):
        read_recording(run)


def test_what_stands_behind_the_end_of_a_recording_is_noticed(run):
    run.write_bytes(run.read_bytes() + b"\0")

    assert not read_recording(run).closed


def test_a_new_recording_has_a_checksum_of_all_its_data(run):
    (end,) = (frame for frame in frames(BytesIO(run.read_bytes())) if frame.opcode == Opcode.DATA_END)

    assert end.body == struct.pack("<I", zlib.crc32(run.read_bytes()[: end.place]))


def test_a_point_that_was_recorded_out_of_turn_is_not_missing(tmp_path):
    assert read_recording(record(tmp_path / "run.mcap", [completed(1), completed(0)])).missing == ()


def test_headers_of_all_formats_have_a_version():
    assert Header.format_version == header_module.FORMAT_VERSION == 3
