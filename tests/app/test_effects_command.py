"""`tumble effects`, and what the other commands do with an effect that was adopted."""

import json
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from app_jobs import STAND, Ran, tumble

from tumble.app.adopted_effects import with_what_is_known
from tumble.app.measurements import read_measurement

SIZES = (0.8, 1.0, 1.2)
_FLIPS_DEG = (-90.0, 90.0, 180.0, 0.0)


def unit_table(path, size, seed):
    """A table of 240 dwells, 100 µV of noise each, and so many times 1 mV near ax = 0.3 g."""
    generator = np.random.default_rng(seed)
    lines = ["realisation,mount,angle_deg,voltage_V"]
    for realisation in (1, 2, 3):
        for mount, sign in (("face-up", -1.0), ("face-down", 1.0)):
            for angle_deg in (*_FLIPS_DEG, *range(0, 360, 10)):
                ax, c = -math.sin(math.radians(angle_deg)), sign * math.cos(math.radians(angle_deg))
                bump = 1e-3 * size * math.exp(-0.5 * ((ax - 0.3) / 0.2) ** 2)
                volts = 2.5 + ax + 0.01 * c + 0.001 * ax * c + bump + 1e-4 * generator.normal()
                lines.append(f"{realisation},{mount},{angle_deg},{volts:.7f}")
    path.write_text("\n".join([*lines, ""]), "utf-8")
    return path


@dataclass(frozen=True, kw_only=True)
class Adopted:
    """A store in which an effect was adopted from three tables."""

    ran: Ran
    tables: tuple[Path, ...]
    store: Path

    @property
    def file(self):
        return self.store / "effects" / "odd_bump.json"


@pytest.fixture(scope="module")
def adopted(tmp_path_factory):
    folder = tmp_path_factory.mktemp("adopted")
    tables = tuple(unit_table(folder / f"unit-{n}.csv", size, n) for n, size in enumerate(SIZES))
    ran = tumble(
        "effects", "adopt", *tables, "--name", "odd_bump", "--unit-type", "QX-1",
        "--operator", "Оксана", "--store", folder / "store", "--json", folder / "effect.json",
    )  # fmt: skip
    return Adopted(ran=ran, tables=tables, store=folder / "store")


@pytest.fixture
def copied(adopted, tmp_path):
    """The file of the effect in a folder of its own."""
    path = tmp_path / "store" / "effects" / adopted.file.name
    path.parent.mkdir(parents=True)
    path.write_bytes(adopted.file.read_bytes())
    return path


def test_what_was_unexplained_is_adopted(adopted):
    content = json.loads(adopted.file.read_text("utf-8"))

    assert adopted.ran.status == 0
    assert adopted.ran.out.startswith("odd_bump: offset × acceleration ax, up to ")
    assert adopted.ran.err == f"effect {adopted.file}\n"
    assert (content["channel"], content["variable"], content["detail"]) == ("offset", "acceleration", "ax")


def test_its_file_says_from_what_it_was_adopted_and_by_whom(adopted):
    content = json.loads(adopted.file.read_text("utf-8"))

    assert content["operator"] == "Оксана"
    assert content["kept_with"] == {"unit_type": "QX-1"}
    assert [Path(unit["sources"][0]["path"]).name for unit in content["units"]] == [p.name for p in adopted.tables]
    assert all(len(unit["sources"][0]["sha256"]) == 64 for unit in content["units"])


def test_the_units_have_their_sizes(adopted):
    content = json.loads(adopted.file.read_text("utf-8"))

    assert [unit["size"] for unit in content["units"]] == pytest.approx(SIZES, abs=0.08)
    assert content["spread"] == pytest.approx(0.2, abs=0.06)


def test_a_further_unit_has_it_by_its_name(adopted, tmp_path):
    table, out = unit_table(tmp_path / "next.csv", 1.1, 7), tmp_path / "loop.json"
    ran = tumble("close-loop", table, "--effects", adopted.file, "--json", out, "--store", tmp_path / "none")
    document = json.loads(out.read_text("utf-8"))

    assert ran.status == 0
    assert "odd_bump" in ran.out
    assert [effect["name"] for effect in document["effects"]] == ["odd_bump"]
    assert document["effects"][0]["coefficients"]["size"]["value"] == pytest.approx(1.1, abs=0.1)
    assert [(each["name"], each["contradicted"]) for each in document["adopted_effects"]] == [("odd_bump", [])]


def test_a_unit_that_lacks_it_contradicts_it(adopted, tmp_path):
    table = unit_table(tmp_path / "next.csv", 0.0, 8)
    ran = tumble("close-loop", table, "--effects", adopted.store, "--store", tmp_path / "none")

    assert ran.status == 0
    assert "this run contradicts the adopted effect odd_bump: it is not there: its size is " in ran.err
    assert "(tumble effects retire odd_bump)" in ran.err


def test_a_record_comes_back_with_the_effects_that_were_offered_to_it(adopted, tmp_path):
    table, store = unit_table(tmp_path / "next.csv", 1.1, 7), tmp_path / "store"
    (store / "effects").mkdir(parents=True)
    (store / "effects" / "odd_bump.json").write_bytes(adopted.file.read_bytes())
    tumble("close-loop", table, "--effects", store, "--record", "--store", store)

    assert tumble("records", "verify", "--store", store).status == 0

    (store / "effects" / "odd_bump.json").unlink()
    gone = tumble("records", "verify", "--store", store)
    assert "does not hold the adopted effect odd_bump that was offered to this record" in gone.out + gone.err


def test_a_bare_table_is_of_no_unit_type(adopted):
    measurement = read_measurement(adopted.tables[0])

    assert with_what_is_known(measurement, adopted.store).adopted == ()


def test_a_run_of_its_unit_type_has_it_sought(adopted, tmp_path):
    (tmp_path / "stand.toml").write_text(STAND, "utf-8")
    for name in ("QX-1", "QX-2"):
        programme = f'name = "p"\nunit_type = "{name}"\ndwell_s = 0.1\n[[procedure]]\nkind = "flip"\naxes = ["x"]\n'
        (tmp_path / f"{name}.toml").write_text(programme, "utf-8")
        ran = tumble(
            "run", "--programme", tmp_path / f"{name}.toml", "--serial", "S-1", "--stand", tmp_path / "stand.toml",
            "--out", tmp_path / f"{name}.mcap",
        )  # fmt: skip
        assert ran.status == 0, ran.err
    sought = [
        [each.name for each in with_what_is_known(read_measurement(tmp_path / f"{name}.mcap"), adopted.store).adopted]
        for name in ("QX-1", "QX-2")
    ]

    assert sought == [["odd_bump"], []]


def test_a_list_has_a_line_for_every_effect(adopted, tmp_path):
    ran = tumble("effects", "list", "--store", adopted.store, "--json", tmp_path / "list.json")
    content = json.loads((tmp_path / "list.json").read_text("utf-8"))

    assert (ran.status, ran.out.count("odd_bump")) == (0, 1)
    assert [each["name"] for each in content["effects"]] == ["odd_bump"]


def test_an_effect_is_shown_with_its_course(adopted, tmp_path):
    ran = tumble("effects", "show", "odd_bump", "--store", adopted.store, "--report", tmp_path / "page.html")
    page = (tmp_path / "page.html").read_text("utf-8")

    assert ran.status == 0
    assert "variable (g)" in ran.out
    assert "unit-2.csv" in ran.out
    assert "<svg" in page


def test_a_retired_effect_stays_and_is_sought_no_more(copied):
    store = copied.parent.parent
    before = copied.read_bytes()
    ran = tumble("effects", "retire", "odd_bump", "--reason", "new seals", "--operator", "me", "--store", store)

    assert (ran.status, ran.out) == (0, "odd_bump is retired: new seals\n")
    assert copied.read_bytes() == before
    assert "retired on " in tumble("effects", "show", "odd_bump", "--store", store).out
    again = tumble("effects", "retire", "odd_bump", "--reason", "once more", "--store", store)
    assert (again.status, again.complaint) == (2, "odd_bump was retired already: new seals")


def test_what_is_retired_is_offered_to_no_table(copied, adopted):
    tumble("effects", "retire", "odd_bump", "--reason", "new seals", "--store", copied.parent.parent)
    ran = tumble("close-loop", adopted.tables[0], "--effects", copied)

    assert (ran.status, "holds no adopted effect of the method dividing_head that is in force" in ran.complaint) == (
        2,
        True,
    )


@pytest.mark.parametrize(
    ("name", "complaint"),
    [
        ("odd_bump", "holds an effect odd_bump already, and none is written over; choose another name"),
        ("ODD_bump", "holds an effect ODD_bump already, and none is written over; choose another name"),
        ("k_xx", "k_xx is an effect of the catalogue; choose another name"),
        ("../x", "'../x' cannot be the name of an effect; give a letter, then letters, digits, - and _, at most 64"),
    ],
)
def test_a_name_that_cannot_be_given_is_refused_before_anything_is_traced(adopted, name, complaint):
    ran = tumble("effects", "adopt", adopted.tables[0], "--name", name, "--unit-type", "T", "--store", adopted.store)

    assert (ran.status, ran.complaint.endswith(complaint)) == (2, True)


def test_a_clean_table_gives_nothing_to_adopt(tmp_path):
    table = unit_table(tmp_path / "clean.csv", 0.0, 3)
    ran = tumble("effects", "adopt", table, "--name", "x", "--unit-type", "T", "--store", tmp_path / "store")

    assert ran.status == 2
    assert "no unexplained structure was found that could be adopted" in ran.complaint
    assert not (tmp_path / "store" / "effects").exists()


def test_with_what_it_is_kept_has_to_be_said(adopted):
    ran = tumble("effects", "adopt", *adopted.tables, "--name", "x", "--store", adopted.store)

    assert (ran.status, ran.complaint) == (
        2,
        "the programmes of the runs do not all state one unit_type; give --unit-type or --of-stand",
    )


def test_a_broken_effect_stops_a_calibration_before_it_begins(copied):
    copied.write_text(copied.read_text("utf-8").replace('"operator"', '"operatör"'), "utf-8")
    store = copied.parent.parent
    ran = tumble("calibrate", "--programme", "quick", "--serial", "S-1", "--store", store)

    assert ran.status == 2
    assert "it was altered or damaged since it was written" in ran.err
    assert not list(store.glob("recordings/**/*.mcap"))


def test_no_result_is_written_over_an_effect(copied, adopted):
    before = copied.read_bytes()
    ran = tumble("fit", adopted.tables[0], "--json", copied)

    assert (ran.status, copied.read_bytes()) == (2, before)


def test_a_table_of_another_kind_takes_no_effects(tmp_path, adopted):
    lines = [f"{angle},{angle + 0.001}" for angle in range(0, 360, 10)]
    (tmp_path / "head.csv").write_text("\n".join(["angle_deg,reference_deg", *lines, ""]), "utf-8")
    ran = tumble("close-loop", tmp_path / "head.csv", "--effects", adopted.file)

    assert (ran.status, "in a table of this kind no effect is adopted" in ran.complaint) == (2, True)


def test_a_result_that_names_no_record_is_refused(tmp_path, adopted):
    (tmp_path / "loop.json").write_text('{"schema": "tumble.loop/1"}', "utf-8")
    ran = tumble("effects", "adopt", tmp_path / "loop.json", "--name", "x", "--unit-type", "T")

    assert (ran.status, "does not say from which record it comes" in ran.complaint) == (2, True)
