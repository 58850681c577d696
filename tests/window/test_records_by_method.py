"""Records of several methods in one list."""

from dataclasses import replace
from datetime import datetime
from types import SimpleNamespace

import pytest
from records_examples import provenance
from test_records_any_method import pendulum

from tumble.app.headline import chosen
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.records.store import Store
from tumble.window.look.moments import day_text


@pytest.fixture
def records(lent_driver, tmp_path):
    """The screen, and a store with two pendulums and a clock of a method that is not installed."""
    store = Store(tmp_path / "store")
    for day, serial_number in enumerate(("P-1", "P-2"), 1):
        measured_at = f"2026-11-0{day}T10:00:00+00:00"
        store.add(pendulum(), provenance(serial_number=serial_number, lot=f"lot {day}", measured_at=measured_at))
    late = {"value": 2.0, "standard_uncertainty": 0.1, "unit": "s", "interval_95": [1.8, 2.2]}
    store.add(
        pendulum(method="clock", parameters={"late": late}),
        provenance(serial_number="C-1", measured_at="2026-11-03T10:00:00+00:00"),
    )
    screen = lent_driver.window.records
    screen.refresh()
    lent_driver.wait(lambda: len(screen.records) == 3 and screen.trend.records == screen.records)
    return screen


def test_the_list_says_the_method_of_every_record_and_its_first_value(records):
    assert records.table.horizontalHeaderItem(8).text() == "method"
    listed = {row[0]: (row[8], row[4]) for row in records.table.texts()}
    assert listed["P-1"] == ("pendulum", "period = 2.0070(10) s")
    assert listed["C-1"] == ("clock", "late = 2.00(10) s")


def test_a_trend_offers_the_parameters_of_the_records(records):
    trend = records.trend
    assert [trend.parameter.itemText(place) for place in range(trend.parameter.count())] == [
        "period",
        "length",
        "damping",
        "late",
    ]
    assert (trend.parameter.currentText(), trend.drawn) == ("period", 2)
    trend.parameter.setCurrentText("late")
    assert trend.drawn == 1


def test_the_parameter_that_is_chosen_stays_chosen_with_other_records(records):
    records.trend.parameter.setCurrentText("late")
    records.trend.show_records(records.records[1:])
    assert records.trend.parameter.currentText() == "late"


def test_a_trend_tells_values_intervals_and_moments(records):
    trend = records.trend
    trend.parameter.setCurrentText("period")
    (headings, *rows) = trend.plot.values().rows()
    assert headings[0] == "series"
    assert headings[-2:] == ("lower end", "upper end")
    assert len(rows) == trend.drawn == 2
    for _, moment, value, low, high in rows:
        assert datetime.fromisoformat(moment).tzinfo is not None
        assert float(low) <= float(value) <= float(high)


def test_without_records_there_is_no_trend(records):
    records.trend.show_records(())
    assert (records.trend.parameter.count(), records.trend.drawn) == (1, 0)


def test_the_time_axis_of_one_record_says_its_day(records):
    trend = records.trend
    trend.show_records(records.records[:1])
    trend.parameter.setCurrentText("period")
    assert trend.drawn == 1
    low, high = trend.plot.getViewBox().viewRange()[0]
    assert high - low >= 3600.0
    assert trend.plot.getAxis("bottom").labelText == f"time, {day_text(datetime(2026, 11, 1))}"


def test_the_time_axis_says_the_first_and_the_last_day(records):
    records.trend.parameter.setCurrentText("period")
    assert records.trend.plot.getAxis("bottom").labelText == "time, " + " – ".join(
        day_text(datetime(2026, 11, day)) for day in (1, 2)
    )


def parameter(name, value, uncertainty):
    return SimpleNamespace(name=name, value=value, standard_uncertainty=uncertainty)


@pytest.mark.parametrize(
    ("wanted", "found"),
    [("c", "c"), ("", "d"), ("a", "a"), ("missing", None)],
)
def test_a_result_is_headed_by_the_named_value_or_the_first_with_an_uncertainty(wanted, found):
    each = (parameter("a", None, None), parameter("b", 1.0, None), parameter("c", 1.0, 0.1), parameter("d", 1.0, 0.1))
    values = {one.name: one for one in (each[0], each[1], each[3], each[2])}
    heading = chosen(values, wanted)
    assert (heading.name if heading else None) == found


def test_a_result_without_uncertainties_is_headed_by_its_first_value():
    values = {"a": parameter("a", None, None), "b": parameter("b", 1.0, None)}
    assert chosen(values, "").name == "b"
    assert chosen({}, "") is None


def test_units_in_a_trend_are_told_apart_by_a_key(records):
    trend = records.trend
    trend.parameter.setCurrentText("period")
    assert [unit in trend.key for unit in ("P-1", "P-2", "C-1")] == [True, True, False]
    assert len({point.brush().color().name() for point in trend._marks.points()}) == 2


def limited(record, minimum, maximum):
    return replace(record, limits=(LimitCheck(name="period", minimum=minimum, maximum=maximum, inside=True),))


def test_a_trend_shows_the_limits_of_the_newest_record(records):
    trend = records.trend
    pendulums = [each for each in records.records if each.method == "pendulum"]
    first, second = sorted(pendulums, key=lambda each: each.provenance.measured_at)
    trend.show_records((limited(first, 1.0, 3.0), limited(second, 1.5, 2.5)))
    trend.parameter.setCurrentText("period")
    assert [(line.value(), line.isVisible()) for line in trend._limits] == [(1.5, True), (2.5, True)]
    assert trend.key.endswith("limits 1.5 to 2.5 s")
    trend.show_records((limited(first, 1.0, 3.0), second))
    assert [line.isVisible() for line in trend._limits] == [False, False]
    assert "limits" not in trend.key


def test_a_trend_goes_over_stands(records):
    trend = records.trend
    trend.parameter.setCurrentText("period")
    trend.over.setCurrentText("stands")
    stand = records.records[-1].provenance.stand_name
    assert trend.plot.getAxis("bottom")._tickLevels == [[(0, stand)]]
    trend.over.setCurrentText("time")


def test_a_trend_goes_over_lots(records):
    trend = records.trend
    trend.parameter.setCurrentText("period")
    trend.over.setCurrentText("lots")
    assert trend.plot.getAxis("bottom")._tickLevels == [[(0, "lot 1"), (1, "lot 2")]]
    trend.parameter.setCurrentText("late")
    assert trend.plot.getAxis("bottom")._tickLevels == [[(0, "—")]]
    trend.over.setCurrentText("time")


def test_records_are_searched_by_lot_and_by_what_was_found(lent_driver, records):
    search = records.search
    search.lot.setText("2")
    lent_driver.wait(lambda: [row[7] for row in records.table.texts()] == ["lot 2"])
    search.lot.clear()
    search.finding.setCurrentText("none")
    assert search.wanted().finding == ""
    lent_driver.wait(lambda: len(records.records) == 3)
    search.finding.offer(("k_xx",), {"k_xx": "square term"})
    search.finding.setCurrentText("square term")
    assert search.wanted().finding == "k_xx"
    lent_driver.wait(lambda: records.records == ())
    search.finding.setCurrentIndex(0)
    lent_driver.wait(lambda: len(records.records) == 3)


def test_records_are_searched_by_method_and_stand(lent_driver, records):
    search = records.search
    search.method.setCurrentText("clock")
    lent_driver.wait(lambda: [row[0] for row in records.table.texts()] == ["C-1"])
    search.method.setCurrentIndex(0)
    search.stand.setCurrentText("bench-1")
    assert search.wanted().stand_name == "bench-1"
    lent_driver.wait(lambda: len(records.records) == 3)
