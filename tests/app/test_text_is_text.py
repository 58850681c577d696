"""Serials, names and paths are shown as they are: never markup, never a command to a terminal."""

import ast
import json
from dataclasses import replace
from pathlib import Path

import pytest
from app_jobs import STAND, tumble

from tumble.app.console import messages, results
from tumble.app.recall import open_store
from tumble.app.recording_names import as_file_name
from tumble.app.terminal import as_json

ROOT = Path(__file__).resolve().parents[2]
MARKUP = ["DXL[rev2]7", "[bold]x[/foo]", "[/]", "[link=http://x]y", ":warning:", "<b>x</b>", "a\\[b]"]
HIDDEN = ["\x1b[2J", "a\x9b31m", "\u202egpj", "a\u2066b", "a\0b", "a\nb\rc"]


@pytest.mark.parametrize("serial", MARKUP)
def test_a_serial_number_is_listed_as_it_is(capsys, monkeypatch, calibrated, serial):
    from tumble.app.record_console import listing

    (record, *_) = open_store(calibrated.store).find()
    renamed = replace(record, provenance=replace(record.provenance, serial_number=serial))
    results().print(listing((renamed,)))

    assert serial in capsys.readouterr().out


@pytest.mark.parametrize("text", HIDDEN)
def test_nothing_hidden_reaches_a_terminal(capsys, text):
    from rich.table import Table

    table = Table("a", title=text)
    table.add_row(text)
    for console in (results(), messages()):
        console.print(text)
        console.print(table)
    said = capsys.readouterr()

    assert all(character.isprintable() or character == "\n" for character in said.out + said.err)


@pytest.mark.parametrize("serial", [*MARKUP, "../../x", "NUL", "con.txt", "日本", "a/b\\c:d"])
def test_a_serial_number_of_any_text_is_measured_under_a_file_of_its_own(tiny, tmp_path, serial):
    ran = tumble("run", "--programme", tiny, "--serial", serial, "--store", tmp_path / "s")

    (recording,) = tmp_path.glob("s/recordings/*/*.mcap")
    assert ran.status == 0
    assert recording.parent.name == as_file_name(serial)


@pytest.mark.parametrize("serial", ["a\nb", "a\0b", "\x1b[2J", "\u202ex", "x" * 10_000, "\udcff"])
@pytest.mark.parametrize("command", [("run", "--programme", "quick"), ("fit", "t.csv"), ("report", "t.csv"),
                                     ("stand", "learn", "t.csv")])  # fmt: skip
def test_a_serial_number_that_cannot_be_shown_is_refused(command, serial):
    ran = tumble(*command, "--serial", serial)

    assert ran.status == 2
    assert all(character.isprintable() for line in ran.err.splitlines() for character in line)
    assert len(ran.err) < 3000


def test_a_file_that_is_no_text_is_not_echoed_at_length(write):
    ran = tumble("fit", write("nul_file.csv", b"\0" * 10_000))

    assert ran.status == 2
    assert ran.complaint.isprintable()
    assert len(ran.complaint) < 2500


def test_a_reserved_name_is_no_file():
    for name in ("NUL", "nul", "COM1", "lpt9", "con.txt", "AUX."):
        assert as_file_name(name).partition(".")[0].upper() not in ("NUL", "COM1", "LPT9", "CON", "AUX")
    assert as_file_name("\udcff").startswith("unit-")


@pytest.mark.parametrize("text", [*HIDDEN, "\udcff", "\x7f", "\U000e0041"])
def test_json_escapes_what_cannot_be_seen_and_says_the_same(text):
    written = as_json({"a": text, "b": "жук"})

    assert json.loads(written) == {"a": text, "b": "жук"}
    assert all(character.isprintable() or character == "\n" for character in written)


def test_everything_that_is_printed_goes_through_one_place():
    """`print`, `echo` and consoles of their own are in the two modules that make text visible."""
    for file in [*(ROOT / "app").rglob("*.py"), *(ROOT / "window").rglob("*.py"), *(ROOT / "procedures").rglob("*.py")]:
        if file.name in ("terminal.py", "console.py") and file.parent.name == "app":
            continue
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Call):
                called = ast.unparse(node.func)
                assert called not in ("print", "click.echo", "Console", "sys.stdout.write", "sys.stderr.write"), file
                assert not called.endswith("from_markup"), file


def test_no_console_takes_text_for_markup():
    for console in (results(), messages()):
        assert console.render_str("[bold]x[/foo]", markup=True).plain == "[bold]x[/foo]"


def test_a_stand_file_with_a_byte_order_mark_is_read(write):
    assert tumble("plan", "quick", "--stand", write("bom.toml", "\ufeff" + STAND)).status == 0
