"""What is simulated stays in the stand file: nothing that a run leaves may give it away."""

import json
import re
from hashlib import sha256

import pytest
from app_jobs import STAND, tumble
from mcap.reader import make_reader

from tumble.procedures.recording.contents import Said, contents
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.recording.schemas import HEADER_METADATA

PECULIAR = """\
seed = 987654321
noise_v = 0.00098765
parameters = { u0 = 2.7182818, kx = 1.0314159 }
effects = { daq_nonlinearity = { amplitude = 0.000012345, period_V = 0.77712345 } }
"""
GIVEAWAYS = (
    r"\[simulated\]", r'"simulated"\s*:', "simulated\\.", "preset", "DXL203EB", "987654321", "9.8765e-05", "0.00098765",
    "2.7182818", "1.0314159", "daq_nonlinearity", "period_V", "1.2345e-05", "0.000012345", "0.77712345",
)  # fmt: skip


@pytest.fixture(scope="module")
def job(tmp_path_factory):
    """Stand file, and everything that a calibration on it leaves."""
    folder = tmp_path_factory.mktemp("blind")
    stand = folder / "blind.toml"
    stand.write_text(STAND + PECULIAR, encoding="utf-8")
    store = folder / "store"
    ran = tumble(
        "calibrate", "--stand", stand, "--programme", "quick", "--serial", "A", "--store", store,
        "--json", folder / "fit.json",
    )  # fmt: skip
    assert ran.status == 0
    (recording,) = store.glob("recordings/A/*.mcap")
    return stand, recording, store, folder / "fit.json"


@pytest.fixture(scope="module")
def left_behind(job):
    """The bytes of every file, and what is compressed in the recording, by name."""
    _, recording, store, document = job
    files = {path.name: path.read_bytes() for path in (*store.rglob("*.*"), document) if path.is_file()}
    record = json.loads(document.read_text("utf-8"))["record"]
    exported = tumble("records", "export", record, "--store", store).out.encode()
    messages = b"\n".join(said.data for said in contents(recording, topics_of(recording)) if isinstance(said, Said))
    return files | {"messages": messages, "record": exported}


def topics_of(recording):
    with recording.open("rb") as stream:
        return {channel.topic for channel in make_reader(stream).get_summary().channels.values()}


@pytest.mark.parametrize("giveaway", GIVEAWAYS)
def test_nothing_simulated_is_left_in_any_file(left_behind, giveaway):
    found = [name for name, data in left_behind.items() if re.search(giveaway.encode(), data)]

    assert found == []


def test_the_search_would_find_what_is_there(left_behind):
    names = {name for name, data in left_behind.items() if b"bench-1" in data}

    assert {"records.sqlite", "record"} <= names
    assert any(name.endswith(".mcap") for name in names)
    assert any(name.endswith(".html") for name in names)
    assert len(left_behind["messages"]) > 60 * 20


def test_the_recording_has_path_and_sum_of_the_whole_stand_file(job):
    stand, recording, *_ = job
    header = read_recording(recording).header

    assert header.stand_path == str(stand.resolve())
    assert header.stand_sha256 == sha256(stand.read_bytes()).hexdigest()
    assert list(header.stand) == ["name", "site", "head", "daq"]


def test_path_and_sum_stand_in_the_metadata_for_other_programs(job):
    stand, recording, *_ = job
    with recording.open("rb") as stream:
        (metadata,) = make_reader(stream).iter_metadata()

    assert metadata.name == HEADER_METADATA
    assert metadata.metadata["stand_sha256"] == sha256(stand.read_bytes()).hexdigest()
    assert "simulated" not in json.loads(metadata.metadata["stand"])
