"""What spreadsheets leave in a table: errors of formulas, empty cells, columns and rows, typographic signs, separators.

The 18 rows are those of public reports of CSV files that programs of others could not read: temperature with `#N/A`
in the first column, nameless columns, rows of commas, U+2212 for minus, one empty temperature.
"""

import numpy as np
import pytest

from tumble.calibrations.core.cells import TableError
from tumble.calibrations.methods.dividing_head.table import read_table

VOLTS = (
    1.604000, 1.709765, 1.802322, 1.870485, 1.905998, 1.904583, 1.866451, 1.796207, 1.702287,
    1.596000, 1.490195, 1.397665, 1.329550, 1.294027, 1.295391, 1.333515, 1.403807, 1.497752,
)  # fmt: skip
ROWS = [(angle, f"{volts:.6f}") for angle, volts in zip(range(-180, 180, 20), VOLTS, strict=True)]


@pytest.fixture
def read(tmp_path):
    def read_text(text):
        path = tmp_path / "t.csv"
        path.write_text(text, encoding="utf-8", newline="")
        return read_table(path)

    return read_text


def told(table):
    """Warnings without the folder."""
    return [sentence.split("t.csv", 1)[1] for sentence in table.warnings]


def test_error_of_a_formula_in_the_first_column_is_a_missing_value_and_no_comment(read):
    lines = [f"{'#N/A' if angle in (-140, -40, 60, 160) else '22.4'},{angle},{volts}" for angle, volts in ROWS]

    table = read("temperature_degC,angle_deg,voltage_V\n" + "\n".join(lines) + "\n")

    assert len(table) == 18
    assert np.isnan(table.temperature_degc).sum() == 4
    assert told(table) == [": 4 rows (lines 4, 9, 14, 19) have no temperature_degC; they are used without it"]


@pytest.mark.parametrize(
    "error",
    ["#N/A", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#NULL!", "#Н/Д", "#ДЕЛ/0!", "#ЗНАЧ!", "#ИМЯ?", "#ІМ'Я?",
     "#NV", "#WERT!", "#BEZUG!", "#ZAHL!", "Err:502", "", "n/a", "NaN", "NULL", "-"],
)  # fmt: skip
def test_what_a_spreadsheet_writes_for_no_value_sets_the_row_aside(read, error):
    table = read(f"voltage_V,angle_deg\n2.5,0\n{error},5\n2.4,10\n")

    assert table.voltage_v.tolist() == [2.5, 2.4]
    assert [(entry.row, entry.reason) for entry in table.set_aside] == [(2, "voltage_v is nan")]


@pytest.mark.parametrize("comment", ["# 22.4,0", "#N/A is what the sensor gives", "#note,5", "#1,2", "#"])
def test_comment_stays_a_comment(read, comment):
    assert len(read(f"voltage_V,angle_deg\n2.5,0\n{comment}\n2.4,10\n")) == 2


def test_nameless_empty_columns_and_rows_of_commas_are_passed_over(read):
    lines = "".join(f"{angle},{volts},,\n" for angle, volts in ROWS)

    table = read(f"angle_deg,voltage_V,,\n{lines},,,\n,\n")

    assert table.voltage_v.tolist() == list(VOLTS)
    assert (table.extra, table.warnings) == ({}, ())


def test_value_in_a_column_without_a_name_is_named_with_its_line(read):
    with pytest.raises(TableError, match=r"t\.csv, line 3: '7' stands in column 3, which has no name; name the column"):
        read("angle_deg,voltage_V,\n0,2.5,\n5,2.4,7\n")


def test_known_column_without_any_value_is_left_out(read):
    table = read("angle_deg,voltage_V,temperature_degC\n0,2.5,\n5,2.4,\n")

    assert table.temperature_degc is None
    assert told(table) == [": column temperature_degC holds no value and is left out"]


@pytest.mark.parametrize("empty", ["angle_deg", "voltage_V"])
def test_table_without_any_angle_or_output_is_refused(read, empty):
    cells = {"angle_deg": "0", "voltage_V": "2.5"} | {empty: "#REF!"}

    with pytest.raises(TableError, match=f"column {empty}: holds no value in any row"):
        read(f"angle_deg,voltage_V\n{cells['angle_deg']},{cells['voltage_V']}\n")


def test_typographic_minus_is_a_minus(read):
    lines = "".join(f"{str(angle).replace('-', chr(0x2212))},{volts}\n" for angle, volts in ROWS)

    assert read("angle_deg,voltage_V\n" + lines).angle_deg.tolist() == [float(angle) for angle, _ in ROWS]


def test_one_empty_temperature_leaves_the_row(read):
    table = read("angle_deg,voltage_V,temperature_degC\n0,2.5,22.4\n5,2.4,\n")

    assert len(table) == 2
    assert told(table) == [": line 3 has no temperature_degC; it is used without it"]


def test_missing_direction_is_an_unknown_one_and_a_missing_realisation_sets_the_row_aside(read):
    table = read("angle_deg,voltage_V,direction,realisation,mount\n0,2.5,,1,edge\n5,2.4,1,,edge\n9,2.3,1,1,\n")

    assert table.direction.tolist() == [0]
    assert [(entry.row, entry.reason) for entry in table.set_aside] == [
        (2, "realisation is missing"),
        (3, "mount is missing"),
    ]


def test_semicolons_and_decimal_commas_as_a_spreadsheet_of_such_a_language_saves_them(read):
    table = read("\ufeffsep=;\r\ntime_s;angle_deg;voltage_V\r\n5,39;-90,0;3,50015\r\n15,8;9,5e1;1\r\n")

    assert table.time_s.tolist() == [5.39, 15.8]
    assert table.angle_deg.tolist() == [-90.0, 95.0]
    assert table.voltage_v.tolist() == [3.50015, 1.0]


def test_tabs_between_values(read):
    assert read("angle_deg\tvoltage_V\n0\t2.5\n5\t2,5\n".replace("2,5", "2.5")).voltage_v.tolist() == [2.5, 2.5]


def test_decimal_points_beside_decimal_commas_are_refused_by_line(read):
    with pytest.raises(TableError, match=r"line 3: numbers with a decimal point and numbers with a decimal comma"):
        read("angle_deg;voltage_V\n0;2,5\n5;2.4\n")


def test_thousands_are_no_number(read):
    with pytest.raises(TableError, match=r"line 2, column angle_deg: '1\.234,5' is not a number"):
        read("angle_deg;voltage_V\n1.234,5;2\n")


@pytest.mark.parametrize("raw", ["\0" * 10_000, "angle_deg,voltage_V\n0,2.5\0\n"])
def test_nul_bytes_are_named_and_not_repeated(read, raw):
    with pytest.raises(TableError, match=r"line [12]: holds a NUL byte; this is no text table"):
        read(raw)


def test_message_repeats_neither_control_characters_nor_any_length_of_a_cell(read):
    with pytest.raises(TableError) as caught:
        read("angle_deg,voltage_V\n0,\x1b[2J" + "x" * 5000 + "\n")

    assert "\x1b" not in str(caught.value)
    assert len(str(caught.value)) < 300
