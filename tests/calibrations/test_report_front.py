"""The first page of a report: for the customer, in every language, on the page as on paper."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest
from report_examples import face_up, flips_only, page_of, provenance, reversed_
from test_report_page import text_of

from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.quantities import format_expanded
from tumble.calibrations.core.verdict import Model, Outcome, Verdict
from tumble.calibrations.core.view import Section
from tumble.calibrations.methods.dividing_head.report import calibration_report
from tumble.calibrations.methods.triad.model import NAMES
from tumble.calibrations.methods.triad.quantities import QUANTITIES
from tumble.calibrations.methods.triad.scalar import NAMES as SCALAR_NAMES
from tumble.calibrations.report.bars import drawn_bar
from tumble.calibrations.report.dates import dated
from tumble.calibrations.report.document import Front, Report
from tumble.calibrations.report.instruments import instruments
from tumble.calibrations.report.language import say, written_in
from tumble.calibrations.report.limit_bar import limit_bar
from tumble.calibrations.report.paper import pdf
from tumble.calibrations.report.written import written, written_section
from tumble.messages import AsWritten, Language, Message

STAND = {
    "name": "bench-1",
    "laboratory": {"name": "Sensor Laboratory", "address": "12 Harbour Road"},
    "head": {"driver": "zaber", "serial": "ODH-117", "certificate": "PTB-118", "calibration_due": "2027-01-31"},
    "daq": {"driver": "scpi", "calibration_due": "2026-10-01"},
    "samplers": {"second": {"driver": "scpi"}},
}
LIMITS = [
    LimitCheck(name="kx", minimum=0.95, maximum=1.05, inside=True),
    LimitCheck(name="ky", minimum=0.02, maximum=0.03, inside=False),
]


def content_of(calibration, limits=(), language=Language.ENGLISH, **changes):
    with written_in(language):
        return written(calibration_report(calibration, provenance(**changes), limits=limits, record_id="R-17"))


def front_of(calibration, limits=(), language=Language.ENGLISH, **changes):
    return content_of(calibration, limits, language, **changes)["front"]


def test_it_says_whose_it_is_what_was_decided_and_with_what():
    front = front_of(reversed_(), LIMITS, stand=STAND)
    assert (front["laboratory"], front["address"]) == ("Sensor Laboratory", "12 Harbour Road")
    assert (front["word"], front["headline"]) == ("FAIL", "✗ Outside the limits: ky")
    headings = ["Instrument", "Driver", "Serial number", "Certificate", "Calibration due"]
    assert front["instruments"]["headings"] == headings
    assert front["instruments"]["rows"][0] == ("dividing head", "zaber", "ODH-117", "PTB-118", "2027-01-31")


def test_each_value_has_its_symbol_its_words_and_k():
    kx = front_of(reversed_())["values"][1]
    assert (kx["symbol"], kx["words"]) == ("k_x", "scale factor")
    assert re.fullmatch(r"\([\d.]+ ± [\d.]+\) m?V/g", kx["value"])
    assert kx["coverage"].startswith("1.9")


def test_a_value_that_there_is_not_says_why():
    (alpha0,) = [each for each in front_of(flips_only())["values"] if each["symbol"] == "α_0"]
    assert alpha0["value"] == "not identifiable"
    assert alpha0["note"].endswith("kxy is not identifiable")


def test_only_limited_values_have_a_bar():
    bars = {each["symbol"]: bool(each["bar"]) for each in front_of(reversed_(), LIMITS)["values"]}
    assert bars == {"u_0": False, "k_x": True, "k_y": True, "k_z": False, "k_xy": False, "α_0": False}


def bar_of(value, minimum, maximum, outcome=Outcome.PASS):
    parameter = replace(reversed_().parameters["kx"], value=value, interval_95=(value, value))
    return limit_bar(parameter, LimitCheck(name="kx", minimum=minimum, maximum=maximum, inside=True), outcome)


@pytest.mark.parametrize(("value", "part"), [(1.0, 0.5), (0.9, 0.18), (1.1, 0.82), (9.0, 0.97), (-9.0, 0.03)])
def test_a_bar_puts_the_value_between_its_limits(value, part):
    assert bar_of(value, 0.9, 1.1).value == pytest.approx(part, abs=0.005)


@pytest.mark.parametrize(("minimum", "maximum"), [(0.9, None), (None, 1.1), (1.0, 1.0)])
def test_a_bar_may_be_open_or_have_no_width(minimum, maximum):
    bar = bar_of(1.0, minimum, maximum)
    assert 0.0 < bar.value < 1.0
    assert (bar.minimum is None, bar.maximum is None) == (minimum is None, maximum is None)


@pytest.mark.parametrize(("minimum", "maximum"), [(None, 2.0), (0.0, None)])
def test_a_bar_of_an_interval_without_end_reaches_from_end_to_end(minimum, maximum):
    endless = (-math.inf, math.inf)
    parameter = Parameter(name="kx", unit="V/g", value=1.0, standard_uncertainty=0.1, interval_95=endless)
    check = LimitCheck(name="kx", minimum=minimum, maximum=maximum, inside=True)
    bar = limit_bar(parameter, check, Outcome.PASS)
    assert 0.0 < bar.value < 1.0
    assert bar.interval == (0.03, 0.97)


def test_the_mark_on_a_bar_says_the_outcome_without_colours():
    marks = {re.sub(r'"#.*?"', "", drawn_bar(bar_of(1.0, 0.9, 1.1, outcome))) for outcome in Outcome}
    assert len(marks) == 3  # without limits there is no bar


@pytest.mark.parametrize(("value", "side"), [(9.0, 1), (1.2, 1), (1.0, 0), (-9.0, -1)])
def test_an_arrow_points_to_what_lies_beyond_a_bar(value, side):
    bar = bar_of(value, 0.9, 1.1, Outcome.FAIL)
    assert bar.beyond == side
    assert ("z" in re.findall(r'd="([^"]+)"', drawn_bar(bar))[-1]) == bool(side)


def test_an_instrument_whose_calibration_was_overdue_is_marked():
    assert [each.name for each in instruments(STAND)] == ["dividing head", "DAQ", "second"]
    assert "2026-10-01, overdue" in front_of(reversed_(), stand=STAND)["instruments"]["rows"][1]


def test_a_calibration_that_ends_on_the_day_itself_is_not_overdue():
    stand = {"daq": {"driver": "scpi", "calibration_due": "2026-11-03"}}
    assert front_of(reversed_(), stand=stand)["instruments"]["rows"] == [("DAQ", "scpi", "2026-11-03")]


def test_a_bare_table_has_no_instruments():
    assert front_of(reversed_(), stand={})["instruments"] is None


def test_no_notice_begins_with_a_path():
    warning = Message("{source}: realisation numbers no passes", source="/data/run 1.mcap")
    content = content_of(replace(reversed_(), warnings=(warning,)))
    assert content["notices"] == ["Realisation numbers no passes"]


def test_no_notice_has_the_folder_of_a_file():
    rows = Message("1 to 2 from {source}", source="/data/store/run 1.mcap")
    content = content_of(replace(reversed_(), warnings=(Message("rows {parts} are taken together", parts=rows),)))
    assert content["notices"] == ["rows 1 to 2 from run 1.mcap are taken together"]


def test_what_is_wrong_is_said_once():
    content = content_of(replace(reversed_(), warnings=("The disk was slow.", "The disk was slow.")))
    assert content["notices"] == ["The disk was slow."]


def test_neither_paths_nor_commands_nor_likelihoods_stand_on_the_first_page():
    page = text_of(page_of(flips_only(), provenance(), limits=LIMITS).split("<header>")[1].split("</header>")[0])
    for unwanted in (".mcap", ".csv", "tumble ", "ln L"):
        assert unwanted not in page


@pytest.mark.parametrize(
    ("language", "expected"),
    [
        (Language.ENGLISH, "2026-11-03 10:15 UTC+02:00"),
        (Language.GERMAN, "03.11.2026 10:15 UTC+02:00"),
        (Language.UKRAINIAN, "03.11.2026 10:15 UTC+02:00"),
    ],
)
def test_the_time_is_written_as_the_language_does(language, expected):
    assert dated("2026-11-03T10:15:00+02:00", language) == expected


def test_what_is_no_date_stays_as_it_is():
    assert dated("spring 2026", Language.GERMAN) == "spring 2026"


def test_every_parameter_of_a_triad_has_a_name_in_words():
    assert set(QUANTITIES) == {*NAMES, *SCALAR_NAMES}


def pages_of(document):
    return int(re.search(rb"<xmpTPg:NPages>(\d+)<", document)[1])


@pytest.mark.parametrize("language", list(Language))
def test_on_paper_it_is_a_few_pages_in_every_language(language):
    document = pdf(content_of(reversed_(), LIMITS, language, stand=STAND))
    assert document.startswith(b"%PDF-")
    assert f"<rdf:li>{language}</rdf:li>".encode() in document
    assert 3 <= pages_of(document) <= 12


def test_figures_on_paper_are_vectors():
    assert b"/Subtype/Image" not in pdf(content_of(face_up())).replace(b" ", b"")


def test_the_same_content_gives_the_same_bytes():
    content = content_of(face_up())
    assert pdf(content) == pdf(content)


def front_alone(content):
    return {**content, "chapters": []}


@pytest.mark.parametrize("language", list(Language))
@pytest.mark.parametrize("calibration", [reversed_, flips_only])
def test_from_the_laboratory_to_the_signature_it_is_one_page(calibration, language):
    warnings = tuple(f"The disk was slow in the run of {day} November." for day in range(10))
    content = content_of(replace(calibration(), warnings=warnings), LIMITS, language, stand=STAND)
    assert pages_of(pdf(front_alone(content))) == 1


def test_a_picture_for_which_there_is_no_room_follows_the_signature():
    warnings = tuple(f"The disk was slow in the run of {day} November." for day in range(24))
    content = front_alone(content_of(replace(flips_only(), warnings=warnings), LIMITS, stand=STAND))
    assert pages_of(pdf(content)) == 2
    assert pages_of(pdf({**content, "front": {**content["front"], "picture": None}})) == 1


def test_a_word_longer_than_its_place_is_broken():
    long, short = ({**front_alone(content_of(reversed_())), "title": text} for text in ("W" * 100, "W"))
    assert b"WWW" not in pdf(short)
    assert pages_of(pdf(long)) == 1


def of_standard_uncertainty():
    parameter = Parameter(name="offset", unit="deg", value=-0.18, standard_uncertainty=0.11)
    return Front(
        provenance=provenance(), parameters={"offset": parameter}, verdict=Verdict(judged=Model.DECLARED, parameters=())
    )


def test_a_standard_uncertainty_is_not_stated_as_an_expanded_one():
    front = written(Report(kind="", title="", front=of_standard_uncertainty()))["front"]
    assert (front["stated_as"], front["values"][0]["value"], front["covered"]) == ("Value", "-0.18(11)°", False)
    assert front["statements"][0].startswith("In brackets stands the standard uncertainty")


def test_what_g_is_stands_only_where_a_unit_holds_it():
    of_angle = written(Report(kind="", title="", front=of_standard_uncertainty()))["front"]
    assert not any("gravity" in each for each in of_angle["statements"])
    assert any("g is local gravity" in each for each in front_of(reversed_())["statements"])


def test_both_sides_of_an_interval_end_at_the_place_of_the_smaller():
    assert format_expanded(2.5000011, (2.499937, 2.5007811), "V") == "2.500001 (+0.000780 / -0.000064) V"
    assert format_expanded(1.0, (1.0, 1.4), "V") == "1.00 (+0.40 / -0.00) V"


def test_what_shakes_a_unit_is_among_the_instruments():
    stand = {"exciter": {"driver": "generator", "serial": "G-1"}, "samplers": {"card": {"driver": "can"}}}
    assert [each.name for each in instruments(stand)] == ["exciter", "card"]


def test_a_value_outside_its_limits_is_not_said_again_with_more_digits():
    assert front_of(reversed_(), LIMITS)["decided"] == []


def test_a_column_in_which_nothing_stands_is_left_out():
    section = Section(title="", headings=("", "Value", "Condition"), rows=[("kx", "1", ""), ("ky", "2", "")])
    shown = written_section(section)
    assert (shown["headings"], shown["rows"]) == (["", "Value"], [["kx", "1"], ["ky", "2"]])


def test_what_a_file_says_is_no_number():
    as_written = Section(title="", rows=[("hash", AsWritten("12ab")), ("limits", AsWritten("5"))])
    assert written_section(as_written)["right"] == [False, False]
    assert written_section(Section(title="", rows=[("a", "12"), ("b", "5")]))["right"] == [False, True]


def test_the_temperature_while_it_was_measured_stands_in_front():
    rows = reversed_().observations
    warm = replace(rows, temperature_degc=np.where(rows.row > 3, 23.14, np.where(rows.row > 1, 22.96, np.nan)))
    assert ("Temperature", "23.0 to 23.1 °C") in front_of(replace(reversed_(), observations=warm))["facts"]
    steady = replace(rows, temperature_degc=np.full(len(rows), 23.0))
    german = front_of(replace(reversed_(), observations=steady), language=Language.GERMAN)["facts"]
    assert ("Temperatur", "23,0 °C") in german


@pytest.mark.parametrize("temperature_degc", [None, np.nan])
def test_where_nothing_told_the_temperature_none_is_stated(temperature_degc):
    rows = reversed_().observations
    untold = replace(rows, temperature_degc=temperature_degc and np.full(len(rows), temperature_degc))
    assert "Temperature" not in dict(front_of(replace(reversed_(), observations=untold))["facts"])


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("(209.7 ± 1.5) arcsec", "(209.7 ± 1.5) ″"),
        ("793.86(77) arcsec", "793.86(77)″"),
        ("a bump of 18 arcsec", "a bump of 18″"),
        ("bias_x_arcsec", "bias_x_arcsec"),
        (AsWritten("5 arcsec"), "5 arcsec"),
    ],
)
def test_arc_seconds_have_their_sign(text, said):
    assert say(text) == said


def test_an_effect_on_whose_absence_a_value_rests_is_called_by_words():
    parameter = replace(reversed_().parameters["kxy"], rests_on="head_eccentricity", given={"head_eccentricity": 0.0})
    assert say(parameter.condition) == "if there is no eccentricity of the head's circle"
