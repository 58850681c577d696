"""Recordings before readers that nobody here wrote: `pymcap-cli doctor` and `@mcap/core`."""

import json
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from mcap.reader import make_reader
from recording_examples import FINISHED, HEADER, STARTED_NS, completed, record, run_of, samples

from tumble.drivers.clock import VirtualClock
from tumble.procedures.recording.header import header_to_strings
from tumble.procedures.recording.reader import read_recording
from tumble.procedures.recording.writer import Recorder

JAVASCRIPT = Path(__file__).parent / "mcap_js"


@pytest.fixture(scope="session")
def node():
    """Node with the packages pinned in `mcap_js/package-lock.json`, installed where they are not yet."""
    node, npm = shutil.which("node"), shutil.which("npm")
    if node is None or npm is None:
        pytest.fail("this test reads recordings with @mcap/core: install Node.js 20 or newer, with npm")
    installed = JAVASCRIPT / "node_modules" / ".package-lock.json"
    pinned = JAVASCRIPT / "package-lock.json"
    if not installed.exists() or installed.stat().st_mtime < pinned.stat().st_mtime:
        subprocess.run([npm, "ci", "--no-audit", "--no-fund", "--ignore-scripts"], cwd=JAVASCRIPT, check=True)
    return node


def doctor(path):
    findings = subprocess.run(
        [sys.executable, "-m", "pymcap_cli.cli", "doctor", "--format", "jsonl", str(path)],
        capture_output=True,
        text=True,
        check=False,
    )
    *details, summary = [json.loads(line) for line in findings.stdout.splitlines()]
    return summary, details


@pytest.fixture
def run(tmp_path):
    return record(tmp_path / "run.mcap", [samples(0, (k / 7 for k in range(2500))), *run_of(3)])


def test_the_doctor_finds_nothing_in_a_recording(run):
    summary, findings = doctor(run)

    assert findings == []
    assert summary["messages"] == 24


def test_the_doctor_finds_nothing_in_a_recording_without_points(tmp_path):
    summary, findings = doctor(record(tmp_path / "run.mcap", [FINISHED]))

    assert findings == []
    assert summary["messages"] == 1


def test_another_reader_finds_the_same_with_checksums_on(run, node):
    script = JAVASCRIPT / "validate_mcap.mjs"
    output = subprocess.run([node, script, run], capture_output=True, text=True, encoding="utf-8", check=True).stdout
    found = json.loads(output)

    counts = {topic: len(messages) for topic, messages in found["streamed"].items()}
    assert counts == {
        "/samples": 6,
        "/head": 3,
        "/temperature": 3,
        "/point": 3,
        "/step": 4,
        "/event": 4,
        "/answer": 1,
    }
    assert found["done"]
    assert found["indexed"] == sum(counts.values())
    assert found["metadata"] == {"tumble": header_to_strings(HEADER)}
    assert found["attachments"] == {"programme.toml": HEADER.programme_text}
    assert found["streamed"]["/samples"][0]["voltage_v"] == [k / 7 for k in range(1000)]
    assert [row["voltage_v"] for row in found["streamed"]["/point"]] == [
        point.readings["voltage_v"].mean for point in read_recording(run).points
    ]


class JumpingClock(VirtualClock):
    """Somebody sets the wall clock back by an hour after ten seconds."""

    def wall_ns(self):
        return super().wall_ns() - (3600 * 10**9 if self.monotonic_s() > 10 else 0)


def test_a_wall_clock_that_is_set_back_changes_neither_order_nor_validity(tmp_path):
    path = tmp_path / "run.mcap"
    clock = JumpingClock(wall_start_ns=STARTED_NS)
    with Recorder(path, HEADER, clock) as recorder:
        for index in range(4):
            clock.sleep(4.0)
            recorder.record(completed(index))
        recorder.record(FINISHED)

    with path.open("rb") as stream:
        messages = [message for *_, message in make_reader(stream).iter_messages("/point", log_time_order=False)]
    seconds = [(message.log_time - STARTED_NS) / 1e9 for message in messages]
    assert seconds == [4.0, 8.0, -3588.0, -3584.0]
    assert [json.loads(message.data)["monotonic_s"] for message in messages] == [4.0, 8.0, 12.0, 16.0]
    assert [point.index for point in read_recording(path).points] == [0, 1, 2, 3]
    assert doctor(path)[1] == []
