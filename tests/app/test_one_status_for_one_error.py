"""One kind of error has one exit status and one sentence, in every command: the table of docs/files.md."""

import errno
import os
import sys

import pytest
from app_jobs import STAND, TINY, tumble

from tumble.app.stand import load_stand
from tumble.app.stand_lock import holding

TABLE = "angle_deg,voltage_V\n" + "".join(f"{10 * n},{2.5 + 0.01 * n}\n" for n in range(37))
AT = ["--serial", "A", "--store", "s"]
READING = {
    "fit": (".csv", ["fit", "FILE"]),
    "fit of a recording": (".mcap", ["fit", "FILE"]),
    "fit --stand": (".toml", ["fit", "t.csv", "--stand", "FILE"]),
    "close-loop": (".csv", ["close-loop", "FILE"]),
    "close-loop of two": (".csv", ["close-loop", "t.csv", "FILE"]),
    "close-loop --stand": (".toml", ["close-loop", "--stand", "FILE", *AT]),
    "report": (".csv", ["report", "FILE", "--store", "s"]),
    "export": (".mcap", ["export", "FILE"]),
    "resume": (".mcap", ["resume", "FILE"]),
    "stand learn": (".csv", ["stand", "learn", "FILE", "--stand", "bench.toml", "--store", "s"]),
    "plan": (".toml", ["plan", "FILE"]),
    "plan --stand": (".toml", ["plan", "quick", "--stand", "FILE"]),
    "run --programme": (".toml", ["run", "--programme", "FILE", *AT]),
    "run --stand": (".toml", ["run", "--stand", "FILE", "--programme", "tiny.toml", *AT]),
    "run --answers": (".toml", ["run", "--answers", "FILE", "--programme", "tiny.toml", *AT]),
    "calibrate": (".toml", ["calibrate", "--stand", "FILE", *AT]),
    "emulate": (".toml", ["emulate", "--stand", "FILE"]),
    "emulate --faults": (".toml", ["emulate", "--faults", "FILE"]),
}
CONTENTS = {
    "missing": None,
    "a folder": None,
    "a name too long for a file": None,
    "not UTF-8": "Björn = 7\n".encode("latin-1"),
    "UTF-16": STAND.encode("utf-16"),
    "a picture": b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(range(256)) * 4,
    "zeros": b"\0" * 10_000,
    "brackets without an end": b'name = "p"\na=' + b"[" * 10_000,
    "a number without an end": b'name = "p"\nrealisations = ' + b"9" * 5_000,
    "a letter": b"Dear all,\n\nsee below.\n",
}


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    for name, text in {"t.csv": TABLE, "tiny.toml": TINY, "bench.toml": STAND}.items():
        (tmp_path / name).write_text(text)
    return tmp_path


def put(folder, kind, suffix):
    if kind == "a name too long for a file":
        return folder / ("x" * 300 + suffix)
    path = folder / f"file{suffix}"
    if kind == "a folder":
        path.mkdir()
    elif CONTENTS[kind] is not None:
        path.write_bytes(CONTENTS[kind])
    return path


def told(ran, status):
    """One sentence that a terminal can show, and a status."""
    assert ran.status == status, ran.err
    assert ran.complaint.isprintable()
    assert len(ran.complaint) < 2500
    return ran.complaint


@pytest.mark.parametrize("kind", CONTENTS)
@pytest.mark.parametrize(("suffix", "arguments"), READING.values(), ids=READING)
def test_a_file_that_cannot_be_used_is_bad_input(folder, kind, suffix, arguments):
    file = put(folder, kind, suffix)

    assert file.name[:9] in told(tumble(*(file if each == "FILE" else each for each in arguments)), 2)


@pytest.mark.skipif(sys.platform == "win32" or os.geteuid() == 0, reason="root may read everything")
@pytest.mark.parametrize(("suffix", "arguments"), READING.values(), ids=READING)
def test_a_file_that_may_not_be_read_is_bad_input(folder, suffix, arguments):
    file = put(folder, "a letter", suffix)
    file.chmod(0)

    told(tumble(*(file if each == "FILE" else each for each in arguments)), 2)


WRITING = {
    "fit --json": ["fit", "t.csv", "--json", "OUT"],
    "plan --json": ["plan", "quick", "--json", "OUT"],
    "records list --json": ["records", "list", "--store", "STORE", "--json", "OUT"],
    "stand list --json": ["stand", "list", "--store", "STORE", "--json", "OUT"],
    "export --out": ["export", "RECORDING", "--out", "OUT"],
    "run --out": ["run", "--programme", "tiny.toml", "--serial", "A", "--out", "OUT.mcap"],
    "run --store": ["run", "--programme", "tiny.toml", "--serial", "A", "--store", "OUT"],
    "calibrate --store": ["calibrate", "--programme", "tiny.toml", "--serial", "A", "--store", "OUT"],
}


@pytest.mark.parametrize("arguments", WRITING.values(), ids=WRITING)
def test_what_cannot_be_written_is_a_matter_of_storage(folder, calibrated, tiny_recording, arguments):
    (folder / "file").write_text("")
    known = {"OUT": "file/x", "OUT.mcap": "file/x.mcap", "STORE": calibrated.store, "RECORDING": tiny_recording}

    told(tumble(*(known.get(each, each) for each in arguments)), 5)


@pytest.mark.parametrize("arguments", list(WRITING.values())[:4], ids=list(WRITING)[:4])
def test_a_full_disk_is_a_matter_of_storage(folder, calibrated, monkeypatch, arguments):
    def full(*_places):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("tumble.app.files._put_in_place", full)
    known = {"OUT": "new", "STORE": calibrated.store}

    ran = tumble(*(known.get(each, each) for each in arguments))

    assert (ran.status, "No space left on device" in ran.err.splitlines()[-1]) == (5, True)
    assert not (folder / "new").exists()


STORES = {
    "records list": ["records", "list"],
    "records show": ["records", "show", "x"],
    "records compare": ["records", "compare", "x", "y"],
    "records export": ["records", "export", "x"],
    "records verify": ["records", "verify"],
    "stand list": ["stand", "list"],
    "stand show": ["stand", "show", "x"],
    "stand verify": ["stand", "verify"],
    "report": ["report", "x"],
}


@pytest.mark.parametrize("arguments", STORES.values(), ids=STORES)
def test_a_store_that_is_not_there_is_bad_input(arguments):
    assert told(tumble(*arguments, "--store", "none"), 2).startswith("none: ")


@pytest.mark.parametrize("arguments", STORES.values(), ids=STORES)
def test_a_store_that_is_none_is_a_matter_of_storage(folder, arguments):
    (folder / "s").mkdir()
    (folder / "s" / "records.sqlite").write_bytes(b"garbage" * 1000)

    assert "this is not a database" in told(tumble(*arguments, "--store", "s"), 5)


MOVING = {"run": ["run"], "calibrate": ["calibrate"], "close-loop": ["close-loop"]}


@pytest.mark.parametrize("arguments", MOVING.values(), ids=MOVING)
def test_a_stand_that_is_in_use_is_a_fault_of_the_instrument(stand, arguments):
    with holding(load_stand(stand), "B"):
        complaint = told(tumble(*arguments, "--stand", stand, "--programme", "tiny.toml", *AT), 3)
    assert f"the stand at {stand.resolve()} is in use by process" in complaint


COMMANDS = [
    "fit",
    "plan",
    "run",
    "emulate",
    "resume",
    "export",
    "report",
    "calibrate",
    "close-loop",
    "records",
    "stand",
]


@pytest.mark.parametrize("command", COMMANDS)
def test_an_option_that_nobody_knows_is_wrong_usage(command):
    ran = tumble(command, "--\x1b[31mwrong")

    assert ran.status == 2
    assert "No such option" in ran.err
    assert "--\\x1b[31mwrong" in ran.err


@pytest.mark.parametrize("arguments", [["plan", "quick"], ["plan", "quick", "--json", "-"], ["fit", "t.csv"]])
def test_a_pipe_that_was_closed_changes_no_status(monkeypatch, arguments):
    reading, writing = os.pipe()
    os.close(reading)
    from tumble.app.cli import main

    with os.fdopen(writing, "w") as left:
        monkeypatch.setattr(sys, "stdout", left)
        monkeypatch.setattr(sys, "argv", ["tumble", *arguments])
        main()
