"""The values to use: in words, against their limits as a bar that needs no colours, and since the last calibration."""

import pytest
from PySide6.QtCore import QRectF
from PySide6.QtGui import QColor, QImage, QPainter

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.verdict import Outcome
from tumble.calibrations.report.limit_bar import limit_bar
from tumble.calibrations.report.values import stated
from tumble.messages import Language
from tumble.window.generic import presenting
from tumble.window.look.language import speak
from tumble.window.look.shades import LIGHT
from tumble.window.widgets.limit_bar import draw_bar
from tumble.window.widgets.values_table import ValuesTable
from tumble.window.work.presentation import ParameterLine
from tumble.window.work.preview import value_text


def line(name="kx", **said):
    return ParameterLine(name=name, value="(1.0 ± 0.1) V/g", interval="0.9 to 1.1 V/g", standard="0.05 V/g", **said)


def bar(value=1.0, outcome=Outcome.PASS, interval=(0.95, 1.05)):
    parameter = Parameter(name="kx", unit="V/g", value=value, interval_95=interval)
    return limit_bar(parameter, LimitCheck(name="kx", minimum=0.9, maximum=1.1, inside=True), outcome)


@pytest.fixture
def table(qtbot, qapp):
    speak(Language.ENGLISH)
    table = ValuesTable()
    qtbot.addWidget(table)
    table.resize(900, 300)
    return table


def shown(table):
    return [
        table.table.horizontalHeaderItem(column).text()
        for column in range(table.table.columnCount())
        if not table.table.isColumnHidden(column)
    ]


def test_columns_in_which_nothing_stands_are_left_out(table):
    table.show_lines([line(note="")])
    assert shown(table) == ["parameter", "Value ± U"]


def test_further_columns_are_shown_on_request(table):
    table.show_lines([line(note="", declared="(1.1 ± 0.1) V/g")])
    table.further.click()
    assert shown(table)[2:] == ["95% interval", "standard uncertainty", "declared model"]


def test_the_day_of_the_last_calibration_stands_above_the_changes(table):
    table.show_lines([line(note="", change="(+0.1 ± 0.2) V/g", since="2026-11-20")])
    assert shown(table)[2:] == ["change since 2026-11-20"]
    assert table.texts()[0][5] == "(+0.1 ± 0.2) V/g"


def test_days_that_differ_stand_beside_their_changes(table):
    days = ("2026-11-20", "2026-11-21")
    table.show_lines([line(note="", change="(+0.1 ± 0.2) V/g", since=day) for day in days])
    assert shown(table)[2:] == ["change"]
    assert [each[5] for each in table.texts()] == [f"(+0.1 ± 0.2) V/g since {day}" for day in days]


def test_what_has_no_value_says_why(table):
    table.show_lines([ParameterLine(name="kz", value="", interval="", standard="", note="", reason="one mount")])
    assert table.texts()[0][2] == "not identifiable"
    assert table.reasons.text() == "kz is not identifiable: one mount"


def test_a_limited_value_has_a_bar_before_its_limits(table):
    table.show_lines([line(note="", limits="0.9 to 1.1 V/g", verdict="inside", bar=bar())])
    bare = picture(table)
    table.show_lines([line(note="", limits="0.9 to 1.1 V/g", verdict="inside")])
    assert has_colour(bare, LIGHT.good)
    assert not has_colour(picture(table), LIGHT.good)


def test_the_bar_grows_with_the_text(table):
    wide = bar_width(table)
    font = table.font()
    font.setPointSizeF(2 * font.pointSizeF())
    table.table.setFont(font)
    assert bar_width(table) > 1.7 * wide


def bar_width(table):
    """How much wider the limits are with a bar than without."""
    widths = []
    for drawn in (bar(), None):
        table.show_lines([line(note="", limits="0.9 to 1.1 V/g", verdict="inside", bar=drawn)])
        widths.append(table.table.columnWidth(3))
    return widths[0] - widths[1]


def test_the_mark_says_the_outcome_without_colours():
    outcomes = (Outcome.PASS, Outcome.FAIL, Outcome.NOT_DECIDED)
    assert len({painted(bar(outcome=outcome)) for outcome in outcomes}) == 3


def test_an_arrow_stands_where_the_value_lies_beyond_the_bar():
    near, far = painted(bar(1.12, Outcome.FAIL, (1.12, 1.12))), painted(bar(9.0, Outcome.FAIL, (9.0, 9.0)))
    assert near != far


def test_a_bar_without_a_value_shows_the_limits_alone():
    assert painted(bar(None, Outcome.NOT_DECIDED, None)) != painted(bar(outcome=Outcome.NOT_DECIDED))


def painted(described):
    """The bytes of a bar in one colour."""
    image = QImage(120, 20, QImage.Format.Format_RGB32)
    image.fill(QColor("white"))
    painter = QPainter(image)
    draw_bar(painter, QRectF(0, 0, 120, 20), described, LIGHT, ink="#000000")
    painter.end()
    return bytes(image.constBits())


def picture(table):
    return table.table.viewport().grab().toImage()


def has_colour(image, name):
    colour = QColor(name).rgb()
    return any(image.pixel(x, y) == colour for x in range(image.width()) for y in range(image.height()))


def test_a_second_calibration_of_a_unit_is_held_against_the_first(driver, tiny, no_report):
    driver.start(tiny)
    first = driver.wait_for_result()
    assert not any(each.change for each in first.table)
    driver.start(tiny)
    driver.wait(lambda: driver.window.result.presentation is not first)
    changed = {each.name: each for each in driver.window.result.presentation.table if each.change}
    assert {"u0", "kx"} <= set(changed)
    assert all(" ± " in each.change and each.since for each in changed.values())


def test_window_preview_and_report_state_a_lopsided_interval_alike():
    lopsided = Parameter(name="alpha0", unit="deg", value=0.1, standard_uncertainty=0.4, interval_95=(-1.2, 0.5))
    told = "0.10 (+0.40 / -1.30) °"
    assert [presenting._line(lopsided, None, None).value, value_text(lopsided), stated(lopsided)] == [told] * 3
