"""Described figures as SVG: what stands where, in which words, and by which rule the script of the page zooms."""

import re
import xml.etree.ElementTree as ET

import numpy as np
import pytest

from tumble.calibrations.report.correlation import correlation_picture
from tumble.calibrations.report.extent import extent, tick_texts, ticks
from tumble.calibrations.report.figure import (
    SHAPES,
    Area,
    Axis,
    Boxes,
    Figure,
    Line,
    Marks,
    Panel,
    Shades,
    Span,
    on_one_scale,
)

ONE_TO_THREE = np.array([1.0, 2.0, 3.0])


def drawn(*layers, **more):
    return Figure(name="f", description="d", panels=(Panel(layers=layers, **more),)).__html__()


def texts(svg):
    return [element.text for element in ET.fromstring(svg).iter("{http://www.w3.org/2000/svg}text")]


def paths(svg, name="plot"):
    (group,) = [each for each in ET.fromstring(svg).iter() if each.get("class") == name]
    return [each.get("d") for each in group.iter("{http://www.w3.org/2000/svg}path")]


@pytest.mark.parametrize(
    ("ends", "most", "expected"),
    [
        ((0.0, 1.0), 5, [0.0, 0.2, 0.4, 0.6, 0.8, 1.0]),
        ((-3.0, 7.0), 5, [-2.0, 0.0, 2.0, 4.0, 6.0]),
        ((1e-6, 9e-6), 4, [2e-6, 4e-6, 6e-6, 8e-6]),
        ((400.0, -400.0), 4, [-400.0, -200.0, 0.0, 200.0, 400.0]),
    ],
)
def test_numbers_along_an_axis_are_round(ends, most, expected):
    assert ticks(Axis(), tuple(sorted(ends)), most) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("places", "expected"),
    [
        ([0.0, 0.2, 0.4], ["0.0", "0.2", "0.4"]),
        ([-200.0, 0.0, 200.0], ["-200", "0", "200"]),
        ([22.95, 23.0, 23.05], ["22.95", "23.00", "23.05"]),
    ],
)
def test_they_have_as_many_places_as_their_step(places, expected):
    assert tick_texts(Axis(), places) == expected


def test_a_logarithmic_axis_has_decades():
    assert ticks(Axis(logarithmic=True), (0.5, 2000.0), 5) == pytest.approx([1.0, 10.0, 100.0, 1000.0])


def test_a_short_logarithmic_axis_has_steps_within_its_decade():
    assert ticks(Axis(logarithmic=True), (1.0, 9.0), 5) == pytest.approx([1.0, 2.0, 5.0])


def test_a_logarithmic_axis_within_one_step_has_round_numbers():
    assert ticks(Axis(logarithmic=True), (59.5, 65.6), 6) == pytest.approx([60.0, 62.0, 64.0])


def test_whole_numbers_have_no_fractions_between_them():
    assert ticks(Axis(whole=True), (0.9, 3.1), 8) == [1.0, 2.0, 3.0]


def test_names_stand_in_place_of_numbers_also_downwards():
    flips = Axis(ticks=(0.0, 1.0), names=("x flip", "y flip"), ends=(1.5, -0.5))
    assert {"x flip", "y flip"} <= set(texts(drawn(Marks(x=ONE_TO_THREE[:2], y=np.array([0.0, 1.0])), y=flips)))


def test_the_axes_hold_everything_with_its_bars():
    marks = Marks(x=ONE_TO_THREE, y=ONE_TO_THREE, y_ends=(ONE_TO_THREE - 5.0, ONE_TO_THREE + 5.0))
    (low, high) = extent(Panel(layers=(marks,)))[1]
    assert low < -4.0
    assert high > 8.0


def test_numbers_that_are_none_widen_no_axis_and_break_a_line():
    line = Line(x=np.array([0.0, 1.0, 2.0, 3.0]), y=np.array([0.0, 1.0, np.nan, 2.0]))
    assert extent(Panel(layers=(line,)))[1] == pytest.approx((-0.1, 2.1))
    (path,) = paths(drawn(line))
    assert (path.count("M"), path.count("L")) == (2, 1)


def test_a_panel_without_points_is_drawn():
    assert "<svg" in drawn(Marks(x=np.array([]), y=np.array([])))


@pytest.mark.parametrize("shape", SHAPES)
def test_a_mark_is_one_absolute_point_and_a_relative_shape(shape):
    """So the script moves it by its point alone, and it keeps its size."""
    (path,) = paths(drawn(Marks(x=ONE_TO_THREE, y=ONE_TO_THREE, shape=shape, hollow=True)))
    assert len(re.findall(r"M-?[\d.]+ -?[\d.]+", path)) == 3
    assert set(re.findall("[A-Z]", path)) == {"M"}


def test_what_is_joined_or_filled_is_absolute_throughout():
    layers = (
        Line(x=ONE_TO_THREE, y=ONE_TO_THREE),
        Area(x=ONE_TO_THREE, low=ONE_TO_THREE, high=ONE_TO_THREE + 1.0),
        Boxes(groups=[ONE_TO_THREE, ONE_TO_THREE]),
    )
    for path in paths(drawn(*layers)):
        assert re.sub(r"[ML]-?[\d.]+ -?[\d.]+|z|h\.01", "", path) == ""


def test_a_point_stands_where_its_axes_put_it():
    svg = drawn(Marks(x=np.array([2.5]), y=np.array([7.5])), x=Axis(ends=(0.0, 10.0)), y=Axis(ends=(0.0, 10.0)))
    width, height = map(float, re.search(r'data-size="([\d.]+) ([\d.]+)"', svg).groups())
    (path,) = paths(svg)
    x, y = map(float, re.match(r"M([\d.]+) ([\d.]+)", path).groups())
    assert (x / width, y / height) == pytest.approx((0.25, 0.25), abs=0.001)


def test_the_script_is_told_where_the_axes_end():
    up = Axis(ends=(1.0, 10.0), logarithmic=True)
    svg = drawn(Marks(x=ONE_TO_THREE, y=ONE_TO_THREE), x=Axis(ends=(0.5, 4.0)), y=up)
    assert 'data-x="0.5 4.0 linear" data-y="1.0 10.0 log"' in svg


def test_labels_stand_in_the_legend_once():
    panel = Panel(layers=(Marks(x=ONE_TO_THREE, y=ONE_TO_THREE, label="rows"),))
    svg = Figure(name="f", description="d", panels=(panel, panel), columns=2).__html__()
    assert texts(svg).count("rows") == 1


def titled(*texts):
    panels = tuple(Panel(layers=(), title=text) for text in texts)
    return Figure(name="f", description="d", panels=panels, width=200.0 * len(texts), columns=len(texts)).__html__()


def titles(*texts):
    return [each for each in ET.fromstring(titled(*texts)).iter() if each.get("font-weight") == "bold"]


def test_a_title_longer_than_its_panel_stands_in_two_lines():
    below, above = titles("face up, turned by 90° (240)")
    assert (above.text, below.text) == ("face up, turned", "by 90° (240)")
    assert (above.get("font-size"), below.get("font-size")) == (None, None)


def test_a_title_longer_than_two_lines_is_set_smaller():
    assert all(float(line.get("font-size")) < 8.0 for line in titles("word " * 30))


def test_beside_a_long_title_a_short_one_leaves_as_much_room():
    frames = re.findall(r'class="panel" transform="translate\([\d.]+ ([\d.]+)\)"', titled("short", "long " * 8))
    assert len(set(frames)) == 1
    assert [each.text for each in titles("short one", "long " * 8)].count("short one") == 1


def test_panels_on_one_scale_end_alike():
    near, far = (Panel(layers=(Marks(x=ONE_TO_THREE * k, y=ONE_TO_THREE * k),)) for k in (1.0, 10.0))
    assert len({(each.x.ends, each.y.ends) for each in on_one_scale([near, far])}) == 1


def test_names_from_outside_are_escaped():
    assert "<b>" not in drawn(Span(low=0.0, high=1.0), x=Axis(label="<b>"), title="<b>")


def test_correlations_have_their_numbers_and_signs_their_colours():
    svg = correlation_picture(["a", "b"], np.array([[1.0, -1.0], [-1.0, 1.0]])).__html__()
    assert texts(svg)[:5] == ["1", "-1", "1", "a", "b"]
    assert svg.index("#d55e00") < svg.index("#0072b2")


def test_many_correlations_are_colours_alone():
    svg = correlation_picture([f"p{number}" for number in range(12)], np.eye(12)).__html__()
    assert "1" not in texts(svg)[:12]


def test_a_shade_says_a_number():
    svg = drawn(Shades(x=ONE_TO_THREE, y=ONE_TO_THREE, values=np.array([-2.0, 0.0, 2.0]), most=2.0))
    assert re.findall('class="marks"[^>]*fill="(#[0-9a-f]+)"', svg) == ["#0072b2", "#ffffff", "#d55e00"]


def test_of_very_many_marks_those_are_drawn_that_can_be_seen():
    rng = np.random.default_rng(5)
    marks = Marks(x=rng.normal(size=100_000), y=rng.normal(size=100_000), shape="dot", size=1.7)
    svg = drawn(marks)
    assert len(svg) < 100_000
    assert extent(Panel(layers=(marks,)))[0][1] > 4.0  # the outermost one counts all the same


def test_few_marks_are_all_drawn():
    (path,) = paths(drawn(Marks(x=np.arange(3000.0), y=np.zeros(3000))))
    assert path.count("M") == 3000


def test_a_line_of_very_many_points_keeps_its_peaks():
    wave = np.zeros(200_000)
    wave[123_456] = 1.0
    (path,) = paths(drawn(Line(x=np.arange(200_000.0), y=wave), y=Axis(ends=(0.0, 1.0))))
    assert " 0L" in path
    assert len(path) < 100_000


def test_a_line_that_doubles_back_is_drawn_whole():
    turn = np.linspace(0.0, 2.0 * np.pi, 5000)
    (path,) = paths(drawn(Line(x=np.cos(turn), y=np.sin(turn))))
    assert path.count("M") + path.count("L") == 5000


def test_on_paper_a_figure_is_as_high_as_it_is_drawn():
    (wide,), (high,) = (re.findall(rf'{side}="([\d.]+)mm"', titled("a")) for side in ("width", "height"))
    *_, drawn_wide, drawn_high = re.findall(r'viewBox="([\d.]+) ([\d.]+) ([\d.]+) ([\d.]+)"', titled("a"))[0]
    assert float(high) / float(wide) == pytest.approx(float(drawn_high) / float(drawn_wide), rel=0.01)
