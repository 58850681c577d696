"""What `import tumble` gives a notebook."""

import subprocess
import sys

import pytest

import tumble
from tumble.procedures.errors import InputError

TURN = "angle_deg,voltage_V\n" + "".join(
    f"{angle},{2.5 + volts}\n"
    for angle, volts in zip(
        range(0, 360, 30),
        [0.01, 0.51, 0.87, 1.0, 0.87, 0.5, 0.0, -0.49, -0.86, -1.0, -0.86, -0.5],
        strict=True,
    )
)
HEAD = "angle_deg,reference_deg\n" + "".join(f"{angle},{angle + 0.001}\n" for angle in range(0, 360, 30))


@pytest.fixture(scope="module", autouse=True)
def figures():
    """They are drawn here."""


@pytest.fixture(scope="module")
def calibrated(tmp_path_factory):
    store = tmp_path_factory.mktemp("store")
    return store, tumble.calibrate("quick", "SN-1", store)


def test_importing_it_loads_nothing_heavy():
    asked = "import sys, tumble; print(sorted({'numpy', 'scipy', 'pydantic', 'tumble.app'} & sys.modules.keys()))"

    assert subprocess.run([sys.executable, "-c", asked], capture_output=True, text=True, check=True).stdout == "[]\n"


def test_every_public_name_is_there():
    assert all(callable(getattr(tumble, name)) for name in tumble.__all__)
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = tumble.nothing


def test_a_calibration_has_values_with_units(calibrated):
    _, result = calibrated

    kx = next(value for value in result.values if value["name"] == "kx")

    assert kx["unit"] == "V/g"
    assert abs(kx["value"] - 1.0) < 3 * kx["standard_uncertainty"]


def test_a_calibration_is_recorded(calibrated):
    store, _ = calibrated

    assert tumble.records(store).latest("SN-1").provenance.programme_name == "quick"


def test_a_result_shows_itself_as_a_table(calibrated):
    _, result = calibrated
    page = result._repr_html_()

    assert page.startswith("<table><caption>SN-1</caption>")
    assert "V/g" in page


def test_a_serial_number_is_no_markup_there(tmp_path):
    (tmp_path / "t.csv").write_text(TURN)

    result = tumble.fit(tmp_path / "t.csv", serial_number="<b>7</b>")

    assert "<caption>&lt;b&gt;7&lt;/b&gt;</caption>" in result._repr_html_()


def test_what_is_not_identifiable_has_its_reason(tmp_path):
    (tmp_path / "t.csv").write_text(TURN)

    kz = next(value for value in tumble.fit(tmp_path / "t.csv").values if value["name"] == "kz")

    assert kz["value"] is None
    assert kz["reason"]


def test_a_result_becomes_a_table_of_pandas(calibrated):
    pytest.importorskip("pandas")
    _, result = calibrated

    table = result.to_dataframe()

    assert list(table.columns) == ["value", "standard_uncertainty", "unit", "reason"]
    assert list(table.index[:6]) == ["u0", "kx", "ky", "kz", "kxy", "alpha0"]


def test_a_result_is_drawn(calibrated, tmp_path):
    _, result = calibrated

    result.plot().save(tmp_path / "left.svg")

    assert (tmp_path / "left.svg").read_text("utf-8").startswith("<svg")


def test_a_head_against_a_reference_is_traced_likewise(tmp_path):
    (tmp_path / "head.csv").write_text(HEAD)

    result = tumble.close_loop(tmp_path / "head.csv")

    assert result.to_dict()["method"] == "head_reference"
    assert result.values[0]["name"] == "offset"


def test_tables_of_different_kinds_are_refused(tmp_path):
    (tmp_path / "t.csv").write_text(TURN)
    (tmp_path / "head.csv").write_text(HEAD)

    with pytest.raises(InputError, match="tables of different kinds"):
        tumble.close_loop(tmp_path / "t.csv", tmp_path / "head.csv")


def test_two_heads_are_given_one_by_one(tmp_path):
    (tmp_path / "head.csv").write_text(HEAD)

    with pytest.raises(InputError, match="one table of this kind at a time"):
        tumble.close_loop(tmp_path / "head.csv", tmp_path / "head.csv")


def test_a_head_that_cannot_be_read_is_told_as_any_other_table(tmp_path):
    (tmp_path / "head.csv").write_text(HEAD + "nonsense,1\n")

    with pytest.raises(InputError, match=r"head.csv"):
        tumble.close_loop(tmp_path / "head.csv")


def test_a_programme_is_planned_and_run(tmp_path):
    assert tumble.plan("quick").dwells == 60
    recording = tumble.run("probe-end", "SN-2", tmp_path / "run.mcap")
    assert {"u0", "kx"} < {value["name"] for value in tumble.close_loop(recording).values}


@pytest.mark.parametrize("name", [{"lot": "A\nB"}, {"operator": "x" * 101}, {"serial_number": "\u202e"}])
def test_what_cannot_serve_as_a_name_is_refused_before_anything_is_measured(tmp_path, name):
    with pytest.raises(InputError, match=f"{next(iter(name))}: "):
        tumble.run("probe-end", **{"serial_number": "SN-2", **name}, recording=tmp_path / "run.mcap")
    assert not (tmp_path / "run.mcap").exists()


def test_a_unit_without_a_serial_number_is_refused(tmp_path):
    with pytest.raises(InputError, match="serial_number"):
        tumble.run("probe-end", "  ", tmp_path / "run.mcap")
