"""A stand that three units get to know: `tumble calibrate`, `tumble stand`, and the runs after it."""

import json
import shutil

import pytest
from app_jobs import cheaply, tumble

from tumble.app.stand_records import head_map_curve, list_stand_records
from tumble.calibrations.methods.dividing_head.loop.loop import explain_questioned

STAND = """\
name = "bench-1"
[head]
driver = "simulated"
limits_deg = [-180.0, 760.0]
serial = "{serial}"
[daq]
driver = "simulated"
[stand_record]
use = true
[simulated]
seed = {seed}
parameters = {{ kx = {kx} }}
effects = {{ head_eccentricity = {{ amplitude_deg = {amplitude_deg}, phase_deg = 30 }} }}
"""
SWEEPS = """\
name = "sweeps"
realisations = 2
dwell_s = 1.0
settle_s = 0.0
""" + "".join(
    f'[[procedure]]\nkind = "sweep"\nmount = "{mount}"\nstep_deg = 20.0\npoints = 18\norder = "there-and-back"\n'
    for mount in ("face-up", "face-down", "face-up-90")
)
UNITS = {"A": (1, 1.0), "B": (2, 1.02), "C": (3, 0.98)}


@pytest.fixture(scope="module")
def known(tmp_path_factory, traced_once):
    """A store in which two units were calibrated, with what the terminal said of each; to be looked at only."""
    folder = tmp_path_factory.mktemp("known")
    said = {}
    for serial_number in ("A", "B"):
        with cheaply():
            ran = calibrated(folder, serial_number)
        assert ran.status == 0, ran.err
        said[serial_number] = ran.err.splitlines()
    return folder, said


@pytest.fixture(scope="module")
def third(known, tmp_path_factory):
    """The same with a third unit calibrated, and what the terminal said of it; to be looked at only."""
    folder = shutil.copytree(known[0], tmp_path_factory.mktemp("third") / "copy")
    with cheaply():
        return folder, calibrated(folder, "C")


@pytest.fixture(scope="module")
def learned(third, tmp_path_factory):
    """The same with what the third unit teaches, and what was said of that; to be looked at only."""
    folder = shutil.copytree(third[0], tmp_path_factory.mktemp("learned") / "copy")
    (recording,) = (folder / "store" / "recordings" / "C").iterdir()
    return folder, tumble("stand", "learn", recording, "--store", folder / "store")


@pytest.fixture(scope="module")
def changed(known, tmp_path_factory):
    """The third unit calibrated when the head had changed, and what the terminal said; to be looked at only."""
    folder = shutil.copytree(known[0], tmp_path_factory.mktemp("changed") / "copy")
    with cheaply(blank="figures"):
        return folder, calibrated(folder, "C", amplitude_deg=0.08)


@pytest.fixture
def copy(known, tmp_path):
    shutil.copytree(known[0], tmp_path / "copy")
    return tmp_path / "copy"


def stand(folder, serial_number, head="H-1", amplitude_deg=0.05):
    seed, kx = UNITS[serial_number]
    path = folder / f"{serial_number}.toml"
    path.write_text(STAND.format(serial=head, seed=seed, kx=kx, amplitude_deg=amplitude_deg), "utf-8")
    (folder / "sweeps.toml").write_text(SWEEPS, "utf-8")
    return path


def calibrated(folder, serial_number, **head):
    return tumble(
        "calibrate", "--stand", stand(folder, serial_number, **head), "--programme", folder / "sweeps.toml",
        "--serial", serial_number, "--store", folder / "store", "--json", folder / f"{serial_number}.json",
    )  # fmt: skip


def shown(folder, *arguments):
    return json.loads(tumble("stand", "show", "bench-1", "--store", folder / "store", "--json", "-", *arguments).out)


def test_one_unit_makes_a_provisional_record(known):
    (sentence,) = [line for line in known[1]["A"] if line.startswith("stand bench-1: ")]

    assert sentence.startswith("stand bench-1: head_eccentricity amplitude 0.0")
    assert sentence.endswith("provisional (stand record 1) until another unit agrees")


def test_a_second_unit_that_agrees_puts_it_in_force(known):
    (sentence,) = [line for line in known[1]["B"] if line.startswith("stand bench-1: ")]

    assert "units A and B agree (p = " in sentence
    assert sentence.endswith("stand record 2 is in force")


def test_a_run_that_found_none_in_force_says_so_and_goes_on(known):
    (warning,) = [line for line in known[1]["A"] if "not corrected" in line]

    assert warning.endswith(
        "A/" + warning.split("A/")[1].split(":")[0] + ": no stand record of bench-1 is in force: two units must agree "
        "on one (tumble stand learn); the run is not corrected"
    )


def test_a_record_says_from_what_it_was_derived(known):
    document = shown(known[0])

    assert (document["schema"], document["version"], document["status"]) == ("tumble.stand-record/1", 2, "in force")
    assert [unit["serial_number"] for unit in document["contributions"]] == ["A", "B"]
    assert all(len(unit["raw_sha256"][0]) == 64 for unit in document["contributions"])
    assert document["identity"] == {"stand": "bench-1", "head": "simulated H-1", "daq": "simulated SIM-DAQ"}
    assert document["validity"]["angle_deg"] == [0.0, 340.0]


def test_the_map_is_that_of_the_head(known):
    record = list_stand_records(known[0] / "store", "bench-1")[-1]
    curve = head_map_curve(record, step_deg=60.0)

    truth_deg = [0.025, 0.05, 0.025, -0.025, -0.05, -0.025, 0.025]
    off = (curve.error_deg - truth_deg) / curve.standard_uncertainty_deg
    assert abs(off).max() < 4.0
    assert curve.standard_uncertainty_deg.max() < 0.002


def test_an_older_version_can_be_shown(known):
    text = tumble("stand", "show", "bench-1", "--version", "1", "--store", known[0] / "store").out

    assert "version 1, provisional" in text
    assert "unit       A  recordings/A/" in text
    assert "head map   true - reported, " in text


def test_a_list_has_a_line_for_every_version(known):
    listed = json.loads(tumble("stand", "list", "--store", known[0] / "store", "--json", "-").out)

    assert listed["schema"] == "tumble.stand-records/1"
    assert [record["version"] for record in listed["records"]] == [1, 2]
    assert "simulated H-1" in tumble("stand", "list", "--store", known[0] / "store").out


def test_records_are_derived_again_from_their_raw_files(known, monkeypatch):
    monkeypatch.setattr("tumble.app.methods.dividing_head.job.explain_questioned", explain_questioned)

    ran = tumble("stand", "verify", "--store", known[0] / "store")

    assert ran.status == 0
    assert "2 of 2 stand records come back from their raw files" in ran.out


def test_a_record_whose_raw_file_is_gone_is_not_verified(copy):
    next((copy / "store" / "recordings" / "B").iterdir()).unlink()

    ran = tumble("stand", "verify", "bench-1", "--store", copy / "store")

    assert ran.status == 2
    assert "NOT VERIFIED: a raw file is missing or changed" in ran.out
    assert "1 of 2 stand records come back" in ran.out


def test_a_third_unit_is_corrected_and_the_result_says_by_what(third):
    folder, ran = third

    result = json.loads((folder / "C.json").read_text("utf-8"))
    record = shown(folder)
    assert "corrected by stand record 2 of bench-1, learned from A and B" not in ran.err
    assert result["stand_record"] == {key: record[key] for key in ("id", "version", "content_sha256")}
    assert "stand record 2" in [line["name"] for line in result["budget"]]
    assert result["residual_rms_V"] < 1.2e-4
    assert result["loop"]["effects"] == []
    assert not any("contradict" in line or "this run says" in line for line in ran.err.splitlines())


def test_a_corrected_calibration_is_verified_and_reported_again_with_the_same_record(learned, tmp_path):
    folder, _ = learned
    store = folder / "store"
    record = json.loads((folder / "C.json").read_text("utf-8"))["record"]
    assert shown(folder)["version"] == 3

    assert tumble("records", "verify", record, "--store", store).status == 0
    page = tmp_path / "again.html"
    with cheaply(blank="figures"):
        tumble("report", record, "--store", store, "--out", page)
    assert "corrected by stand record 2 of bench-1" in page.read_text("utf-8")


def test_a_further_unit_that_agrees_makes_a_new_version(learned):
    folder, ran = learned

    assert "units A, B and C agree" in ran.out
    assert tumble("stand", "verify", "--store", folder / "store").status == 0


def test_a_file_that_was_learned_from_teaches_nothing_new(known):
    recording = next((known[0] / "store" / "recordings" / "A").iterdir())

    ran = tumble("stand", "learn", recording, "--store", known[0] / "store")

    assert ran.out == f"{recording}: nothing of its stand is to be learned that is not known\n"


def test_a_head_that_changed_contradicts_the_record(changed):
    folder, ran = changed

    (sentence,) = [line for line in ran.err.splitlines() if line.startswith("stand record 2 says")]
    assert ", this run says head_eccentricity amplitude 0.0" in sentence
    (page,) = [page for page in (folder / "store" / "reports").iterdir() if "this run says" in page.read_text("utf-8")]
    assert json.loads((folder / "C.json").read_text("utf-8"))["report"] == str(page)


def test_a_unit_that_disagrees_puts_nothing_in_force(copy, changed):
    (recording,) = (changed[0] / "store" / "recordings" / "C").iterdir()

    ran = tumble("stand", "learn", recording, "--store", copy / "store")

    assert "this run contradicts stand record 2 (p < 0.0001), which stays in force" in ran.out
    assert [(r.version, str(r.status)) for r in list_stand_records(copy / "store")][-2:] == [
        (2, "in force"),
        (3, "provisional"),
    ]


def test_what_a_record_does_not_have_is_provisional_beside_it(copy):
    path = stand(copy, "C")
    path.write_text(path.read_text("utf-8").replace("effects = {", "effects = { backlash = 0.05,"), "utf-8")
    recording, sweeps = copy / "c.mcap", copy / "sweeps.toml"
    tumble("run", "--stand", path, "--programme", sweeps, "--serial", "C", "--out", recording)

    ran = tumble("stand", "learn", recording, "--store", copy / "store")

    assert "stand bench-1: this run sees backlash, which stand record 2 does not have" in ran.out
    assert [str(record.status) for record in list_stand_records(copy / "store")] == [
        "provisional",
        "in force",
        "provisional",
    ]


def test_a_unit_that_sees_nothing_confirms_nothing(known, tmp_path):
    stand(tmp_path, "C", amplitude_deg=0.0)
    straight, sweeps = tmp_path / "c.mcap", tmp_path / "sweeps.toml"
    tumble("run", "--stand", tmp_path / "C.toml", "--programme", sweeps, "--serial", "C", "--out", straight)
    first = next((known[0] / "store" / "recordings" / "A").iterdir())

    ran = tumble("stand", "learn", first, straight, "--store", tmp_path / "store")

    assert ran.out.splitlines()[-1] == (
        "stand bench-1: units A and C confirm nothing of each other: nothing is in force on their word"
    )
    assert [record.version for record in list_stand_records(tmp_path / "store")] == [1]


def test_another_head_is_another_stand(copy, no_report):
    ran = calibrated(copy, "C", head="H-2")

    (warning,) = [line for line in ran.err.splitlines() if "does not apply" in line]
    assert "stand record 2 of bench-1 is for head simulated H-1" in warning
    assert "the run was made with head simulated H-2" in warning
    assert "stand_record" not in json.loads((copy / "C.json").read_text("utf-8"))


def test_an_analysis_without_a_store_says_that_it_is_not_corrected(known):
    recording = next((known[0] / "store" / "recordings" / "A").iterdir())

    ran = tumble("fit", recording, "--json", known[0] / "fit.json")

    assert (
        "its stand file wants the stand record, but no store was named (--store); the run is not corrected" in ran.err
    )


def test_the_loop_is_closed_on_corrected_rows_where_a_store_is_named(known):
    recording = next((known[0] / "store" / "recordings" / "A").iterdir())
    effects = {}
    for name, store in {"with": ("--store", known[0] / "store"), "without": ()}.items():
        effects[name] = json.loads(tumble("close-loop", recording, "--json", "-", *store).out)["effects"]

    assert effects["with"] == []
    assert [effect["name"] for effect in effects["without"]] == ["head_eccentricity"]


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("show", "bench-9"), "there is no stand record of bench-9; list them with tumble stand list"),
        (
            ("show", "bench-1", "--version", "7"),
            "there is no stand record 7 of bench-1; list them with tumble stand list",
        ),
    ],
)
def test_a_stand_that_is_not_known_is_bad_input(known, arguments, complaint):
    ran = tumble("stand", *arguments, "--store", known[0] / "store")

    assert ran.status == 2
    assert ran.complaint == f"{known[0] / 'store'}: {complaint}"


def test_a_folder_without_a_store_is_bad_input(tmp_path):
    ran = tumble("stand", "list", "--store", tmp_path)

    assert ran.status == 2
    assert ran.complaint == f"{tmp_path}: there is no records.sqlite in this folder; name the folder of a store"


def test_a_table_of_no_stand_teaches_nothing(write, tmp_path):
    table = write("t.csv", "angle_deg,voltage_V\n0,2.5\n90,1.5\n180,2.5\n270,3.5\n")

    ran = tumble("stand", "learn", table, "--store", tmp_path / "s")

    assert ran.status == 2
    assert ran.complaint.endswith("does not say on which stand it was measured; give the stand file with --stand")
