"""`tumble records verify` of a whole store: everything in it is looked at, and so is what belongs to no record."""

import shutil
import sqlite3
from contextlib import closing
from pathlib import Path

import pytest
from app_jobs import tumble

FIRST_FORMAT = Path(__file__).parents[1] / "procedures" / "fixtures" / "recording_v1.mcap"


def past_the_triggers(store, *statements):
    """What somebody does who opens the database with another program."""
    with closing(sqlite3.connect(store / "records.sqlite")) as connection:
        triggers = connection.execute("SELECT name FROM sqlite_master WHERE type = 'trigger'").fetchall()
        for (name,) in triggers:
            connection.execute(f"DROP TRIGGER {name}")
        for statement in statements:
            connection.execute(statement)
        connection.commit()


def verified(store):
    return tumble("records", "verify", "--store", store)


def said_of(ran, name):
    """The sentences below the line of a thing."""
    lines = ran.out.splitlines()
    begin = next(number for number, line in enumerate(lines) if line.startswith(f"{name}: "))
    return [lines[begin], *(line.strip() for line in lines[begin + 1 : begin + 2])]


def test_a_record_that_was_removed_past_the_triggers_is_noticed_by_its_recording(copied):
    past_the_triggers(copied.store, "DELETE FROM parameters", "DELETE FROM records")
    (report,) = (copied.store / "reports").glob("*.html")

    ran = verified(copied.store)

    assert ran.status == 2
    assert said_of(ran, copied.recording) == [
        f"{copied.recording}: NO RECORD",
        "It has no record: that was removed from the store, or never came; tumble resume makes it anew.",
    ]
    assert said_of(ran, report)[1].startswith("This report has no record: that was removed from the store")
    assert ran.out.splitlines()[-1] == ("0 of 0 records agree with their raw files; 3 more findings, 3 of them wrong")


def test_a_record_that_was_removed_is_noticed_by_its_parameters(copied):
    past_the_triggers(copied.store, "DELETE FROM records")

    ran = verified(copied.store)

    assert ran.status == 2
    assert "It is not in the store, although other rows name it" in said_of(ran, copied.document["record"])[1]


def test_a_record_of_a_file_elsewhere_that_was_removed_leaves_a_gap(copied, write):
    table = write("t.csv", "angle_deg,voltage_V\n" + "".join(f"{angle},{angle % 7}\n" for angle in range(0, 360, 10)))
    assert tumble("fit", table, "--store", copied.store).status == 0
    assert tumble("fit", copied.recording, "--store", copied.store).status == 0
    past_the_triggers(
        copied.store,
        "DELETE FROM parameters WHERE record_id IN (SELECT id FROM records WHERE serial_number = 't')",
        "DELETE FROM records WHERE serial_number = 't'",
    )

    ran = verified(copied.store)

    assert ran.status == 2
    assert said_of(ran, copied.store / "records.sqlite") == [
        f"{copied.store / 'records.sqlite'}: RECORDS REMOVED",
        "A record was deleted from the database; restore it from a backup.",
    ]


def test_a_damaged_record_does_not_stop_the_check_of_the_others(copied):
    other = tumble(
        "run", "--programme", "quick", "--serial", "SN-8", "--store", copied.store, "--out", copied.store / "x.mcap"
    )
    assert other.status == 0
    assert tumble("fit", copied.store / "x.mcap", "--store", copied.store).status == 0
    past_the_triggers(copied.store, "UPDATE records SET result = '{' WHERE serial_number = 'SN-7'")

    ran = verified(copied.store)

    assert ran.status == 2
    assert said_of(ran, copied.document["record"])[0].endswith(": NOT VERIFIED")
    assert "a record is damaged" in said_of(ran, copied.document["record"])[1]
    assert "1 of 2 records agree with their raw files" in ran.out


@pytest.mark.parametrize("content", ["'null'", "'{}'", "'[1]'", '\'{"parameters": 7, "complete": true}\''])
def test_a_record_with_another_content_is_not_verified(copied, content):
    past_the_triggers(copied.store, f"UPDATE records SET result = {content}")

    ran = tumble("records", "verify", copied.document["record"], "--store", copied.store)

    assert ran.status == 2
    assert "NOT VERIFIED" in ran.out
    assert "0 of 1 record agrees" in ran.out


@pytest.mark.parametrize("content", ["[1]", '{"loop": null}', '{"loop": {"effects": [{}]}}', "[" * 100_000])
def test_a_superseded_record_with_another_content_is_not_verified(copied, content):
    assert tumble("fit", copied.recording, "--store", copied.store).status == 0
    past_the_triggers(copied.store, f"UPDATE records SET result = '{content}' WHERE id = '{copied.document['record']}'")

    ran = verified(copied.store)

    assert ran.status == 2
    assert said_of(ran, copied.document["record"])[0].endswith(": NOT VERIFIED")


@pytest.mark.parametrize("content", ["[1]", "null", "[" * 100_000])
def test_a_list_with_a_record_of_another_content_says_which_store_is_damaged(copied, content):
    past_the_triggers(copied.store, f"UPDATE records SET result = '{content}'")

    ran = tumble("records", "list", "--store", copied.store)

    assert ran.status == 5
    assert ran.complaint.startswith(f"{copied.store / 'records.sqlite'}: ")
    assert "damaged" in ran.complaint


def test_a_recording_that_is_missing_is_counted_among_the_others(copied):
    copied.recording.unlink()

    ran = verified(copied.store)

    assert ran.status == 2
    assert "missing." in said_of(ran, copied.document["record"])[1]


def test_a_run_that_was_only_measured_is_named_and_not_wrong(copied):
    measured = copied.store / "recordings" / "SN-9" / "run.mcap"
    assert tumble("run", "--programme", "quick", "--serial", "SN-9", "--out", measured).status == 0

    ran = verified(copied.store)

    assert ran.status == 0
    assert said_of(ran, measured) == [
        f"{measured}: no record",
        "It has no record: it was measured and never calibrated, or its record was removed.",
    ]
    assert ran.out.splitlines()[-1].endswith("; 1 more finding, 0 of them wrong")


def test_a_recording_that_cannot_be_read_is_named(copied):
    (copied.store / "recordings" / "junk.mcap").write_bytes(b"junk")

    ran = verified(copied.store)

    assert ran.status == 2
    assert "cannot be read" in said_of(ran, copied.store / "recordings" / "junk.mcap")[1]


def test_an_older_recording_is_said_to_be_unprotected(tmp_path):
    recording = shutil.copy(FIRST_FORMAT, tmp_path / "old.mcap")
    said = "The recording is of format 1, in which the header has no checksum"
    ran = tumble("fit", recording, "--store", tmp_path / "s")
    assert "no checksum" not in ran.out + ran.err

    assert said in verified(tmp_path / "s").out
    assert said in tumble("records", "show", "2", "--store", tmp_path / "s").out


@pytest.mark.parametrize("command", [("records", "list"), ("records", "verify"), ("fit", FIRST_FORMAT)])
def test_an_empty_file_is_no_store(tmp_path, command):
    (tmp_path / "records.sqlite").touch()

    ran = tumble(*command, "--store", tmp_path)

    assert ran.status in (2, 5)
    assert f"{tmp_path / 'records.sqlite'}: this file is empty and no store; restore it from a backup" in ran.err
    assert (tmp_path / "records.sqlite").read_bytes() == b""
