import json
import shutil

import pytest
from app_jobs import STAND, tumble

from tumble.calibrations.methods.dividing_head.loop.loop import explain_questioned


def listed(store, *arguments):
    return json.loads(tumble("records", "list", "--store", store, "--json", "-", *arguments).out)["records"]


def refitted(done, *arguments):
    ran = tumble("fit", done.recording, "--store", done.store, "--json", "-", *arguments)
    return json.loads(ran.out)["record"]


def test_a_list_has_a_line_for_every_record(calibrated):
    ran = tumble("records", "list", "--store", calibrated.store)

    (line,) = [line for line in ran.out.splitlines() if calibrated.document["record"] in line]
    assert [word in line for word in ("SN-7", "quick", "not judged", "1.0000")] == [True] * 4


@pytest.mark.parametrize(
    "question", [("--serial", "SN-7"), ("--programme", "quick"), ("--since", "2020-01-01"), ("--verdict", "not judged")]
)
def test_a_list_finds_what_fits(calibrated, question):
    assert [record["id"] for record in listed(calibrated.store, *question)] == [calibrated.document["record"]]


@pytest.mark.parametrize(
    "question", [("--serial", "SN-8"), ("--programme", "seed"), ("--until", "2020-01-01"), ("--verdict", "inside")]
)
def test_a_list_leaves_out_what_does_not_fit(calibrated, question):
    assert listed(calibrated.store, *question) == []


def test_a_second_analysis_is_a_revision_that_supersedes_the_first(copied):
    second = refitted(copied)

    (record,) = listed(copied.store)
    assert record["id"] == second
    assert (record["revision"], record["supersedes"]) == (2, copied.document["record"])


def test_a_third_analysis_supersedes_the_second(copied):
    second = refitted(copied)
    refitted(copied)

    (record,) = listed(copied.store)
    assert (record["revision"], record["supersedes"]) == (3, second)


def test_a_record_is_shown_by_the_beginning_of_its_id(copied):
    first, second = copied.document["record"], refitted(copied)

    text = tumble("records", "show", second, "--store", copied.store).out

    assert f"record     {second}, revision 2, not judged" in text
    assert f"supersedes {first}" in text
    assert "unit       SN-7" in text
    assert "kx     1.0000" in text


def test_show_says_what_cannot_be_told_and_for_which_alpha0_a_value_stands(write, tmp_path):
    flips = "".join(f"{angle},{volts}\n" for angle, volts in [(-90, 3.5), (90, 1.5), (180, 2.51), (0, 2.49)] * 2)
    table = write("flips.csv", f"angle_deg,voltage_V\n{flips.replace('3.5', '3.5001', 1)}")
    record = json.loads(tumble("fit", table, "--store", tmp_path / "s", "--json", "-").out)["record"]

    text = tumble("records", "show", record, "--store", tmp_path / "s").out

    assert "alpha0 not identifiable: its 95% interval reaches 45 deg" in text
    assert any(line.startswith("  ky ") and line.endswith("given alpha0 = 0°") for line in text.splitlines())


def test_an_exported_record_is_a_document_of_its_own(calibrated, tmp_path):
    tumble(
        "records", "export", calibrated.document["record"], "--store", calibrated.store, "--json", tmp_path / "r.json"
    )

    document = json.loads((tmp_path / "r.json").read_text("utf-8"))
    assert document["schema"] == "tumble.record/5"
    assert document["result"]["parameters"] == calibrated.document["parameters"]
    assert document["provenance"]["sources"][0]["path"] == calibrated.recording.relative_to(calibrated.store).as_posix()
    assert document["provenance"]["operator"] == "Оксана"
    assert document["provenance"]["lot"] == "L 26/3"


def test_records_are_listed_by_lot_and_say_it(calibrated):
    assert [each["id"] for each in listed(calibrated.store, "--lot", "L 26/3")] == [calibrated.document["record"]]
    assert listed(calibrated.store, "--lot", "L 26") == []
    said = tumble("records", "show", calibrated.document["record"], "--store", calibrated.store).out
    assert "lot        L 26/3" in said.splitlines()


def test_a_comparison_says_what_changed_significantly(copied, write, tmp_path):
    stand = write("b.toml", STAND + "seed = 2\nparameters = { kx = 1.1 }\n")
    recording = tmp_path / "second.mcap"
    tumble("run", "--stand", stand, "--programme", "quick", "--serial", "SN-7", "--out", recording)
    second = json.loads(tumble("fit", recording, "--store", copied.store, "--json", "-").out)["record"]

    lines = tumble("records", "compare", copied.document["record"], second, "--store", copied.store).out.splitlines()

    assert [line.split()[0] for line in lines[:2]] == ["first", "second"]
    assert lines[1].endswith(f"record {second}")
    assert "Only one of them names a lot: L 26/3." in lines
    sentences = {line.split()[0]: line for line in lines if " changed by " in line}
    assert set(sentences) == {"u0", "kx", "ky", "kz", "kxy", "alpha0"}
    change, unit = sentences["kx"].removeprefix("kx changed by ").split(",")[0].split()
    assert (float(change), unit) == (pytest.approx(100.0, abs=0.3), "mV/g")
    assert ": significant (p = " in sentences["kx"]
    assert ": not significant (p = " in sentences["u0"]


def test_a_comparison_knows_two_analyses_of_the_same_raw_data(copied):
    second = refitted(copied)

    text = tumble("records", "compare", copied.document["record"], second, "--store", copied.store).out

    assert "kx did not change: both records come from the same raw data." in text


def test_an_untouched_record_is_verified(calibrated, monkeypatch):
    monkeypatch.setattr("tumble.app.methods.dividing_head.job.explain_questioned", explain_questioned)

    ran = tumble("records", "verify", "--store", calibrated.store)

    assert ran.status == 0
    assert f"{calibrated.document['record']}: verified" in ran.out
    assert "1 of 1 record agrees with its raw files" in ran.out


def test_a_store_that_was_moved_is_verified(copied, tmp_path):
    shutil.move(copied.store, tmp_path / "elsewhere")

    assert tumble("records", "verify", "--store", tmp_path / "elsewhere").status == 0


@pytest.mark.parametrize(
    ("spoil", "word"),
    [
        (lambda path: path.write_bytes(path.read_bytes() + b"\0"), "changed"),
        (lambda path: path.write_bytes(path.read_bytes()[:-1]), "changed"),
        (lambda path: path.unlink(), "missing"),
    ],
    ids=["longer", "shorter", "gone"],
)
def test_a_record_whose_raw_file_was_altered_is_not_verified(copied, spoil, word):
    recording = copied.recording
    spoil(recording)

    ran = tumble("records", "verify", copied.document["record"], "--store", copied.store)

    assert ran.status == 2
    assert f"{copied.document['record']}: NOT VERIFIED" in ran.out
    assert f"{recording}: {word}." in ran.out
    assert "0 of 1 record agrees with its raw files" in ran.out


@pytest.mark.parametrize("command", ["show", "export", "verify"])
def test_an_id_that_no_record_has_is_bad_input(calibrated, command):
    ran = tumble("records", command, "1999", "--store", calibrated.store)

    assert ran.status == 2
    assert "no record has an id that begins with '1999'; list the records" in ran.complaint


@pytest.mark.parametrize(
    "arguments",
    [
        ("records", "list"),
        ("records", "show", "2026"),
        ("records", "compare", "2026", "2027"),
        ("records", "export", "2026"),
        ("records", "verify"),
        ("report", "2026"),
    ],
    ids=" ".join,
)
def test_a_folder_without_a_store_is_bad_input_and_stays_as_it_is(tmp_path, arguments):
    ran = tumble(*arguments, "--store", tmp_path)

    assert ran.status == 2
    assert ran.complaint == f"{tmp_path}: there is no records.sqlite in this folder; name the folder of a store"
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("group", "said"),
    [("records", "No record matches."), ("stand", "No stand record yet; tumble stand learn makes one.")],
)
def test_a_list_of_nothing_says_so(calibrated, group, said):
    arguments = ["--serial", "NOBODY"] if group == "records" else []

    assert tumble(group, "list", "--store", calibrated.store, *arguments).out.strip() == said


def test_a_list_says_when_to_the_minute(calibrated):
    measured = listed(calibrated.store)[0]["provenance"]["measured_at"]

    assert f" {measured[:10]} {measured[11:16]} " in tumble("records", "list", "--store", calibrated.store).out
