"""Loops on tables of other kinds than the accelerometer's, read in German and Ukrainian."""

import re
from dataclasses import replace

import numpy as np
import pytest
from head_tables import rests
from languages import left_in_english, plain_sentences, said_in, texts
from test_head_settings import cycles
from test_temperature_loop import runs

from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.method import METHOD as HEAD_REFERENCE
from tumble.calibrations.methods.head_reference.method import HeadResult
from tumble.calibrations.methods.temperature.loop import close_temperature_loop
from tumble.calibrations.methods.temperature.method import METHOD as TEMPERATURE
from tumble.calibrations.methods.temperature.method import TemperatureResult
from tumble.calibrations.report.document import page_of_sections
from tumble.calibrations.report.figure import Axis, Figure, Panel
from tumble.calibrations.report.language import say, written_in
from tumble.calibrations.report.page import html
from tumble.calibrations.report.written import written
from tumble.messages import Language, Message


def page(kind, title, sections, notices=(), language=Language.ENGLISH):
    with written_in(language):
        return html(written(page_of_sections(kind, title, sections, notices)))


OTHERS = [Language.UKRAINIAN, Language.GERMAN]


def eccentric(angle_deg, direction, _time_s):
    """Eccentricity, backlash and a wave of order seven, with a bump that nothing describes."""
    wave = 0.02 * np.sin(np.deg2rad(angle_deg)) + 0.004 * np.sin(np.deg2rad(7 * angle_deg))
    return wave + 0.01 * (direction < 0) + 0.03 * np.exp(-(((angle_deg - 200.0) / 8.0) ** 2))


def temperature_result(table):
    return TemperatureResult(name="runs.csv", loop=close_temperature_loop(table))


def head_result(*tables):
    names = ("first.csv", "second.csv")[: len(tables)]
    return HeadResult(names=names, loops=tuple(map(close_reference_loop, tables)))


RESULTS = {
    "a break and a drift": (
        TEMPERATURE,
        lambda: temperature_result(
            runs(a_mV=lambda at, order: 0.5 * np.clip(at - 42.0, 0, None), b_mV=lambda at, order: 0.4 * order)
        ),
    ),
    "runs that only get warmer": (
        TEMPERATURE,
        lambda: temperature_result(
            runs(order=np.arange(1.0, 16.0), a_mV=lambda at, order: 0.4 * order, b_mV=lambda at, order: at**2)
        ),
    ),
    "too few runs": (
        TEMPERATURE,
        lambda: temperature_result(runs(temperature_degc=[-20.0, 0.0, 20.0, 40.0], a_mV=lambda at, order: at)),
    ),
    "a whole turn": (HEAD_REFERENCE, lambda: head_result(cycles(eccentric, slips=[(20, 0.5)]))),
    "a wave that rests cannot part": (HEAD_REFERENCE, lambda: head_result(rests(eccentric, step_deg=30.0))),
    "two tables": (
        HEAD_REFERENCE,
        lambda: head_result(rests(lambda a, d, t: 0.0 * a), rests(eccentric, seed=2)),
    ),
}


@pytest.fixture(scope="module", params=RESULTS)
def method_and_sections(request):
    method, make = RESULTS[request.param]
    return method, [replace(section, figure=None) for section in make().sections()]  # figures take seconds


def test_every_sentence_is_a_message(method_and_sections):
    method, sections = method_and_sections
    said = [method.title, method.columns, *said_in(sections)]
    assert [found for text in said for found in plain_sentences(text)] == []


@pytest.mark.parametrize("language", OTHERS)
def test_a_report_keeps_nothing_in_english(method_and_sections, language):
    method, sections = method_and_sections
    english, other = (page(method.title, "runs.csv", sections, (), each) for each in (Language.ENGLISH, language))
    assert f'<html lang="{language}">' in other
    assert left_in_english(other, english) == []


def test_numbers_of_a_german_report_have_a_decimal_comma_and_names_of_files_none():
    section = Section(title=Message("Head map"), headings=("", "p"), rows=[("turn 0.5.csv", "0.0201(3)°")])
    assert {"turn 0.5.csv", "0,0201(3)°"} <= texts(page("", "", [section], language=Language.GERMAN))


def test_code_that_is_copied_keeps_its_decimal_points_in_every_language():
    code = "TRIAD_BIAS_V = (3.1e-03, -1.8e-03)\n"
    written_out = page("", "", [Section(title=Message("Head map"), code=code)], language=Language.GERMAN)
    assert f"<pre><code>{code}</code></pre>" in written_out


def test_a_report_in_english_says_what_the_terminal_says_and_calls_effects_by_words(method_and_sections):
    method, sections = method_and_sections
    shown = texts(page(method.title, "runs.csv", sections))
    assert {say(line) for section in sections for line in section.lines} <= shown
    assert not any(name in text for text in shown for name in ("head_eccentricity", "temperature_linear", "run_drift"))


def test_a_figure_is_labelled_and_read_out_in_the_language_of_its_page():
    section = Section(title="", figure=_drawn)
    english, german = (page("", "", [section], language=each) for each in (Language.ENGLISH, Language.GERMAN))
    assert "Abweichungskarte des Teilkopfs" in texts(german)
    assert "Head map" in texts(english)


def test_numbers_along_the_axes_of_a_german_figure_have_a_decimal_comma():
    across = Axis(label=Message("Angle"), ends=(0.0, 0.5), ticks=(0.1, 0.2))
    with written_in(Language.GERMAN):
        drawn = Figure(name="x", description="", panels=(Panel(layers=(), x=across),), width=300.0).__html__()
    assert {">Winkel<", ">0,1<", ">0,2<"} <= set(re.findall(">[^<>]+<", drawn))


def _drawn():
    return Figure(name="map", description=Message("Head map"), panels=())
