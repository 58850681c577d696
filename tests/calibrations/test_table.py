import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from tables import FLIPS, sweep, table

from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.table import write_table
from tumble.calibrations.methods.dividing_head.table import read_table

HEADER = "realisation,procedure,mount,angle_deg,voltage_V\n"


def write(tmp_path, text, encoding="utf-8"):
    path = tmp_path / "unit.csv"
    path.write_bytes(text.encode(encoding))
    return path


def refused(tmp_path, text, encoding="utf-8"):
    with pytest.raises(TableError) as caught:
        read_table(write(tmp_path, text, encoding))
    return str(caught.value).replace(str(tmp_path), "").lstrip("/\\")


def test_the_smallest_table_has_angle_and_voltage(tmp_path):
    rows = read_table(write(tmp_path, "angle_deg,voltage_V\n0,2.5\n90,1.5\n"))

    assert rows.angle_deg.tolist() == [0.0, 90.0]
    assert rows.mounts.tolist() == ["face-up", "face-up"]
    assert rows.realisations.tolist() == [1, 1]


def test_comments_blank_lines_and_a_byte_order_mark_are_passed_over(tmp_path):
    rows = read_table(write(tmp_path, "\ufeff# made by hand\nangle_deg,voltage_V\n\n0,2.5\n# half way\n90,1.5\n"))

    assert rows.row.tolist() == [1, 2]


def test_unknown_columns_are_kept(tmp_path):
    rows = read_table(write(tmp_path, "angle_deg,voltage_V,humidity,note\n0,2.5,41.5,door open\n"))

    assert rows.extra["humidity"].tolist() == [41.5]
    assert rows.extra["note"].tolist() == ["door open"]


def test_bad_values_set_the_row_aside_and_keep_the_rest(tmp_path):
    rows = read_table(write(tmp_path, "angle_deg,voltage_V\n0,nan\n5,2.5\n10,9.9e37\n15,inf\n20,2.4\n"))

    assert rows.voltage_v.tolist() == [2.5, 2.4]
    assert [entry.row for entry in rows.set_aside] == [1, 3, 4]


def test_a_last_line_without_an_end_is_read_with_a_warning(tmp_path):
    rows = read_table(write(tmp_path, "angle_deg,voltage_V\n0,2.5\n90,1.5"))

    assert len(rows) == 2
    assert "no line end" in rows.warnings[0]


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "unit.csv: the file is empty; expected a header line and one row per dwell"),
        (HEADER, "unit.csv: there is a header but no row; expected one row per dwell"),
        (
            "angle,voltage_V\n0,2.5\n",
            "unit.csv, line 1: column angle_deg is missing; is it angle? Rename it and check its unit",
        ),
        (
            "angle_deg,u\n0,2.5\n",
            "unit.csv, line 1: column voltage_V (or reference_deg) is missing; the columns are angle_deg, u",
        ),
        (
            "angle_deg,voltage_V\n0,2.5\n5,two\n",
            "unit.csv, line 3, column voltage_V: 'two' is not a number; "
            "write it with a decimal point, or nan where there is none",
        ),
        (
            "angle_deg,voltage_V\n0,2_5\n",
            "unit.csv, line 2, column voltage_V: '2_5' is not a number; "
            "write it with a decimal point, or nan where there is none",
        ),
        (
            "angle_deg,voltage_V\n0,2,5\n",
            "unit.csv, line 2: 3 values where the header has 2 columns; complete the line or remove it",
        ),
        (
            "angle_deg,mount,voltage_V\n0,upside-down,2.5\n",
            "unit.csv, line 2, column mount: 'upside-down' is no mount; "
            "known are face-up, face-up-90, face-down, edge, edge-back, end",
        ),
        (
            "angle_deg,direction,voltage_V\n0,2,2.5\n",
            "unit.csv, line 2, column direction: 2 where 1, -1 or 0 is expected",
        ),
        (
            "angle_deg,realisation,voltage_V\n0,1,2.5\n0,1.5,2.5\n",
            "unit.csv, line 3, column realisation: 1.5 where a whole number from 1 is expected",
        ),
        (
            "angle_deg,realisation,voltage_V\n0,1e300,2.5\n",
            "unit.csv, line 2, column realisation: 1e+300 where a whole number from 1 is expected",
        ),
        (
            "angle_deg,realisation,voltage_V\n0,1e300,2.5\n",
            "unit.csv, line 2, column realisation: 1e+300 where a whole number from 1 is expected",
        ),
        (
            "angle_deg,angle_deg,voltage_V\n0,0,2\n",
            "unit.csv, line 1, column angle_deg: named twice; rename or remove one",
        ),
        (
            'angle_deg,voltage_V\n0,"2.5\n5,2.4\n',
            "unit.csv, line 2: unexpected end of data; expected plain values between commas",
        ),
        (
            "angle_deg,voltage_V\n0," + "2" * 200_000 + "\n",
            "unit.csv, line 2: field larger than field limit (131072); expected plain values between commas",
        ),
    ],
)
def test_a_malformed_table_gets_one_sentence(tmp_path, text, sentence):
    assert refused(tmp_path, text) == sentence


def test_another_encoding_is_named_with_its_line(tmp_path):
    sentence = refused(tmp_path, "angle_deg,voltage_V,note\n0,2.5,кут\n", "cp1251")

    assert sentence == "unit.csv, line 2: not UTF-8 (byte 0xea); save the table as UTF-8"


def test_a_missing_file_is_named(tmp_path):
    with pytest.raises(TableError, match=r"nowhere\.csv: cannot be read"):
        read_table(tmp_path / "nowhere.csv")


def test_what_is_written_comes_back_to_the_last_digit(tmp_path):
    rows = table(*FLIPS, sweep("face-up"))
    write_table(rows, tmp_path / "out.csv")
    back = read_table(tmp_path / "out.csv")

    assert np.array_equal(back.voltage_v, rows.voltage_v)
    assert np.array_equal(back.mount, rows.mount)


@settings(max_examples=100, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.binary(max_size=200))
def test_any_bytes_are_read_or_refused_in_one_sentence(tmp_path, raw):
    path = tmp_path / "any.csv"
    path.write_bytes(b"angle_deg,voltage_V\n" + raw)
    try:
        read_table(path)
    except TableError as error:
        assert "\n" not in str(error)
