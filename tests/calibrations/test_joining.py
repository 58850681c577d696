"""Several tables of one unit as one."""

import numpy as np
import pytest

from tumble.calibrations.core.joining import PAUSE_S, appended, joined
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.poses import mountings


def rows(source="a.csv", angle_deg=(0.0, 90.0), **columns):
    angle_deg = np.asarray(angle_deg)
    count = len(angle_deg)
    return Observations(
        row=np.arange(1, count + 1), angle_deg=angle_deg, voltage_v=np.full(count, 2.5), source=source, **columns
    )


def together(*tables, starts_s=None):
    return joined(tables, starts_s or [None] * len(tables))


def test_one_table_stays_as_it_is():
    table = rows()
    assert together(table) is table


def test_rows_realisations_and_runs_are_numbered_on():
    table = together(rows(realisation=np.array([1, 2])), rows("b.csv"), rows("c.csv", realisation=np.array([1, 2])))
    assert table.row.tolist() == [1, 2, 3, 4, 5, 6]
    assert table.realisations.tolist() == [1, 2, 3, 3, 4, 5]
    assert table.runs.tolist() == [0, 0, 1, 1, 2, 2]
    assert table.source == "a.csv, b.csv and c.csv"
    assert table.warnings == ("rows 1 to 2 from a.csv, 3 to 4 from b.csv and 5 to 6 from c.csv are taken together",)


def test_rows_set_aside_keep_their_place():
    first = rows(set_aside=(SetAside(row=3, reason="voltage_v is nan"),))
    second = rows("b.csv", set_aside=(SetAside(row=3, reason="voltage_v is nan"),))
    table = together(first, second)
    assert table.row.tolist() == [1, 2, 4, 5]
    assert [entry.row for entry in table.set_aside] == [3, 6]
    assert table.rows_read == 6


def test_the_unit_is_seated_anew_for_each_run_and_each_mount():
    edge = np.array(["edge", "face-up"])
    table = together(rows(), rows("b.csv"), rows("c.csv", mount=edge))
    assert table.mounts.tolist() == ["face-up"] * 4 + ["edge", "face-up"]
    assert mountings(table).tolist() == [0, 0, 1, 1, 2, 3]


def test_where_no_table_names_a_mount_none_is_made_up():
    assert together(rows(), rows("b.csv")).mount is None


def times(*starts_s):
    tables = [rows(f"{number}.csv", time_s=np.array([5.0, 15.0])) for number in range(len(starts_s))]
    return joined(tables, starts_s).time_s.tolist()


def test_times_follow_the_clock_where_it_is_known():
    assert times(1000.0, 8000.0) == [5.0, 15.0, 7005.0, 7015.0]


def test_times_follow_after_a_pause_where_the_clock_is_not_known_for_both():
    assert times(1000.0, None) == times(None, 8000.0) == times(None, None)
    assert times(None, None) == [5.0, 15.0, 15.0 + PAUSE_S, 25.0 + PAUSE_S]


def test_a_clock_that_is_known_from_the_second_table_on_holds_from_there_on():
    assert times(None, 8000.0, 9000.0)[-2:] == [1015.0 + PAUSE_S, 1025.0 + PAUSE_S]


def test_a_clock_that_would_have_runs_overlap_is_not_believed():
    assert times(1000.0, 1000.0) == times(None, None)


@pytest.mark.parametrize(
    ("name", "column", "known", "expected"),
    [
        ("temperature_degc", "temperature_degC", [22.0, 23.0], ["22.0", "23.0", "nan", "nan"]),
        ("voltage_sd_v", "voltage_sd_V", [0.1, 0.2], ["0.1", "0.2", "nan", "nan"]),
        ("direction", "direction", [1, -1], ["1", "-1", "0", "0"]),
        ("procedure", "procedure", ["flip", "sweep"], ["flip", "sweep", "", ""]),
    ],
)
def test_what_only_one_table_says_is_unknown_in_the_other(name, column, known, expected):
    table = together(rows(**{name: np.array(known)}), rows("b.csv"))
    assert [str(value) for value in getattr(table, name).tolist()] == expected
    assert table.warnings[-1] == f"b.csv: there is no column {column}; it is unknown there"


def test_times_that_only_one_table_has_are_left_out():
    table = together(rows(), rows("b.csv", time_s=np.array([1.0, 2.0])), rows("c.csv"))
    assert table.time_s is None
    assert table.warnings[-1] == "a.csv and c.csv: there is no column time_s; it is left out"


def test_further_columns_are_kept_where_all_tables_have_them():
    def lamp(*values):
        return {"lamp": np.array(values), "air": np.array(values)}

    first, second = rows(extra=lamp(1.0, 2.0)), rows("b.csv", extra={"lamp": np.array([3.0, 4.0])})
    table = together(first, second)
    assert {name: values.tolist() for name, values in table.extra.items()} == {"lamp": [1.0, 2.0, 3.0, 4.0]}
    assert table.warnings[-1] == "b.csv: there is no column air; it is left out"


def test_warnings_of_the_tables_are_kept_and_a_cut_table_makes_all_incomplete():
    table = together(rows(warnings=("cut",), complete=False), rows("b.csv", warnings=("cut", "wet")))
    assert table.warnings[:2] == ("cut", "wet")
    assert not table.complete


def test_appended_times_are_taken_as_they_are():
    first, second = rows(time_s=np.array([1.0, 2.0])), rows(time_s=np.array([30.0, 40.0]))
    assert appended(first, second).time_s.tolist() == [1.0, 2.0, 30.0, 40.0]
