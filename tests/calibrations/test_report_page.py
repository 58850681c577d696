"""The report as a page: whole, escaped, self-contained, and with everything that belongs in it."""

import re
import xml.etree.ElementTree as ET
from dataclasses import replace
from html.parser import HTMLParser

import numpy as np
import pytest
from report_examples import (
    FACE_UP,
    FLIPS,
    calibrate,
    chapter,
    dwells,
    face_up,
    flips_only,
    page_of,
    provenance,
    reversed_,
)

from tumble.calibrations.core.provenance import LimitCheck, Source
from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.dividing_head.report.results import notices
from tumble.calibrations.methods.dividing_head.report.subject import Subject
from tumble.calibrations.report.verdicts import headline

VOID = {"meta", "br", "link", "img", "hr"}
HOSTILE = "<script>alert('1')</script>\"&"


class Balanced(HTMLParser):
    """Checks that every element is closed in its order, and keeps attributes and text."""

    def __init__(self):
        super().__init__()
        self.open, self.attributes, self.text = [], [], []

    def handle_starttag(self, tag, attrs):
        self.attributes += [(tag, name, value or "") for name, value in attrs]
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.attributes += [(tag, name, value or "") for name, value in attrs]

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


def parsed(page):
    parser = Balanced()
    parser.feed(page)
    parser.close()
    assert parser.open == []
    return parser


def text_of(page):
    return " ".join(" ".join(parsed(page).text).split())


def section(anchor, calibration, limits=(), **changes):
    """The text of one section."""
    subject = Subject(calibration=calibration, provenance=provenance(**changes), limits=tuple(limits))
    return text_of(chapter(anchor, subject))


def front(calibration, limits=(), **changes):
    """Verdict and notices."""
    subject = Subject(calibration=calibration, provenance=provenance(**changes), limits=tuple(limits))
    return {"verdict": headline(subject.verdict), "notices": notices(subject)}


@pytest.fixture(scope="module")
def page():
    return page_of(face_up(), provenance(), record_id="R-17", revision=3)


def test_every_element_is_closed(page):
    assert ("html", "lang", "en") in parsed(page).attributes


def test_every_plot_is_well_formed_and_says_what_it_shows(page):
    plots = re.findall(r"<svg.*?</svg>", page, flags=re.DOTALL)
    assert len(plots) == 5
    for plot in plots:
        element = ET.fromstring(plot)
        assert element.get("role") == "img"
        assert len(element.get("aria-label")) > 10


def test_no_two_elements_share_an_id(page):
    ids = [value for _, name, value in parsed(page).attributes if name == "id"]
    assert len(ids) == len(set(ids))


def test_the_page_needs_nothing_from_outside(page):
    for tag, name, value in parsed(page).attributes:
        assert tag not in {"link", "iframe"}
        if name in {"src", "href", "xlink:href"}:
            assert value.startswith(("#", "data:"))
    assert "@import" not in page
    assert set(re.findall(r"https?://[^\"' <]*", page)) <= {
        "http://www.w3.org/2000/svg",
        "http://www.w3.org/1999/xlink",
    }


def test_the_page_is_small_and_its_script_finds_every_figure(page):
    assert len(page.encode()) < 1_500_000
    assert len(re.findall('<svg[^>]* class="figure"', page)) == 5
    assert page.count("<script>") == 1


def test_the_same_input_gives_the_same_page(page):
    assert page_of(face_up(), provenance(), record_id="R-17", revision=3) == page


def test_the_head_says_what_was_measured_when_and_by_whom(page):
    text = text_of(page)
    for expected in (
        "SN-1",
        "2026-11-03T10:15:00+02:00",
        "L-26",
        "A. Operator",
        "seed-2008",
        "R-17, revision 3",
    ):
        assert expected in text


def test_every_section_is_reached_from_the_head(page):
    attributes = parsed(page).attributes
    targets = [value[1:] for tag, name, value in attributes if tag == "a" and name == "href"]
    sections = [value for tag, name, value in attributes if tag == "section" and name == "id"]
    assert targets == sections
    assert sections[:2] == ["results", "significance"]


def test_table_heads_have_a_scope(page):
    scopes = [value for tag, name, value in parsed(page).attributes if tag == "th" and name == "scope"]
    assert len(scopes) == page.count("<th ")
    assert set(scopes) == {"row", "col"}


def test_texts_from_outside_are_escaped():
    calibration = replace(face_up(), warnings=(HOSTILE,))
    hostile = provenance(
        serial_number=HOSTILE,
        operator=HOSTILE,
        sources=(Source(kind="table", path=HOSTILE, sha256=""),),
        stand={HOSTILE: HOSTILE},
        packages={HOSTILE: HOSTILE},
    )
    page = page_of(calibration, hostile, record_id=HOSTILE)
    assert page.count("<script") == 1  # its own
    assert "alert(" not in "".join(re.findall("<script>.*?</script>", page, flags=re.DOTALL))
    assert page.count("&lt;script&gt;alert(&#39;1&#39;)&lt;/script&gt;&#34;&amp;") == 10


def test_the_result_has_the_digits_that_its_uncertainty_supports():
    parameters = dict(reversed_().parameters)
    parameters["kx"] = replace(
        parameters["kx"], value=1.0164315, standard_uncertainty=1.8e-4, degrees_of_freedom=603.56,
        interval_95=(1.0160782, 1.0167848),
    )  # fmt: skip
    text = section("results", replace(reversed_(), parameters=parameters))
    assert "kx (1.01643 ± 0.00035) V/g 1.01608 to 1.01678 V/g 1.96 180 µV/g 603" in text


def test_an_interval_that_is_not_symmetric_shows_both_sides():
    parameters = dict(reversed_().parameters)
    parameters["alpha0"] = replace(parameters["alpha0"], value=0.1, interval_95=(-1.2, 0.5))
    assert "alpha0 0.10 (+0.40 / -1.30) °" in section("results", replace(reversed_(), parameters=parameters))


def test_alpha0_rests_on_kxy_until_the_unit_is_turned_over():
    assert "rests on kxy" in section("results", face_up())
    assert "alpha0 rest on kxy" in section("significance", face_up())
    assert "rests on kxy" not in section("results", reversed_())
    assert "rest on kxy" not in section("significance", reversed_())


def test_a_parameter_without_a_value_has_its_reason_in_the_table():
    text = section("results", flips_only())
    assert "not identifiable: its 95% interval is unbounded" in text
    assert "A sweep in face down, on the other edge or on end would settle it" in text
    assert "given alpha0 = 0°" in text


def test_a_page_without_alpha0_is_whole():
    page = page_of(flips_only(), provenance(), limits=[limit("kxy", None, 1e-3, False)])
    assert text_of(page).count("not identifiable") >= 2
    assert "? Not decided: kxy" in text_of(page)


def limit(name, minimum, maximum, inside):
    return LimitCheck(name=name, minimum=minimum, maximum=maximum, inside=inside)


def test_without_limits_there_is_no_verdict():
    assert front(reversed_())["verdict"] == "No limits were stated"
    assert "Verdict" not in section("results", reversed_())


def test_inside_the_limits_the_verdict_says_so():
    limits = [limit("kx", 0.95, 1.05, True)]
    assert front(reversed_(), limits)["verdict"] == "Inside the limits"
    assert "950 to 1050 mV/g inside" in section("results", reversed_(), limits)


@pytest.mark.parametrize(
    ("minimum", "maximum", "inside", "words"),
    [
        (0.005, 0.011, True, "5 to 11 mV/g inside, but the interval reaches out"),
        (None, 0.009, False, "up to 9 mV/g outside, but the interval reaches in"),
        (0.02, None, False, "from 20 mV/g outside kz"),
    ],
)
def test_a_verdict_says_where_the_interval_ends(minimum, maximum, inside, words):
    parameters = dict(reversed_().parameters)
    parameters["ky"] = replace(parameters["ky"], value=0.01, interval_95=(0.008, 0.012))
    calibration = replace(reversed_(), parameters=parameters)
    assert words in section("results", calibration, [limit("ky", minimum, maximum, inside)])


def test_a_parameter_without_a_value_decides_nothing():
    assert "up to 1 mV/g² not decided: no value" in section("results", flips_only(), [limit("kxy", None, 1e-3, False)])


def test_a_good_run_has_no_notices():
    assert front(reversed_())["notices"] == []


def test_what_is_wrong_with_the_run_stands_in_front():
    observations = replace(face_up().observations, complete=False)
    calibration = replace(face_up(), observations=observations, warnings=("The disk was slow.",), lack_of_fit_p=1e-6)
    incomplete, warning, misfit, dirty = front(calibration, git_dirty=True)["notices"]
    assert incomplete.startswith("The recording is incomplete")
    assert warning == "The disk was slow."
    assert "does not describe the data" in misfit
    assert dirty == "The program that computed this had changes that are in no commit."


def test_a_table_that_tells_nothing_is_a_whole_page():
    calibration = calibrate(dwells([("face-up", [0.0, 90.0])], realisations=1))
    text = text_of(page_of(calibration, provenance()))
    assert text.split("Instruments")[0].count("not identifiable") >= 6
    assert text.count("No parameter has a value.") == 2


def test_rows_set_aside_are_listed_with_their_reason():
    aside = (SetAside(row=17, reason="gross error: 14 sigma"),)
    text = section("quality", replace(face_up(), observations=face_up().observations.without(aside)))
    assert "138 rows read, 137 used, 1 set aside." in text
    assert "row 17: gross error: 14 sigma" in text


def test_a_long_list_of_rows_set_aside_is_cut_and_counted():
    aside = tuple(SetAside(row=1000 + i, reason="voltage is not a number") for i in range(60))
    text = section("quality", replace(face_up(), observations=replace(face_up().observations, set_aside=aside)))
    assert "the first 50 of 60" in text
    assert "row 1049: voltage" in text
    assert "row 1050: voltage" not in text


def test_a_table_without_repeats_says_that_nothing_measures_the_scatter():
    calibration = calibrate(dwells(FLIPS, realisations=1))
    text = section("quality", calibration)
    assert "no pose was repeated" in text
    assert "Lack of fit not tested" in text
    assert "Held-out error, r.m.s. none" in text
    assert "were not repeated" in section("closure", calibration)


def test_the_lack_of_fit_has_its_meaning_beside_it():
    assert "the poses agree with the model" in section("quality", replace(face_up(), lack_of_fit_p=0.2))
    assert "the poses disagree with the model" in section("quality", replace(face_up(), lack_of_fit_p=0.001))


def test_a_table_without_flips_says_what_stays_unseen():
    assert "holds no complete 180° flip" in section("closure", replace(face_up(), closure=None))


def test_the_flips_have_their_u0_and_the_sentence():
    text = section("closure", face_up())
    assert "flips agree on u0" in text
    assert re.search(r"x 2\.\d{6}\(\d\d\) V", text)


def test_without_monte_carlo_there_is_no_comparison_and_without_gravity_no_second_table():
    calibration = replace(face_up(), monte_carlo={}, per_acceleration={})
    assert "propagation of distributions" not in section("budget", calibration)
    assert "per m/s²" not in section("results", calibration)


def test_the_simulation_is_judged_and_its_disagreement_explained():
    calibration = reversed_()
    parameter = calibration.parameters["kxy"]
    u, (low, high) = parameter.standard_uncertainty, parameter.interval_95
    assert "differ: not linear" in section("budget", replace(calibration, monte_carlo={"kxy": (u, (low + u, high))}))
    assert "agree" in section("budget", replace(calibration, monte_carlo={"kxy": (u, (low, high))}))


def test_few_degrees_of_freedom_explain_a_narrow_simulation():
    text = section("budget", calibrate(dwells(FLIPS, k_xx=0.01)))
    assert "differ: few degrees of freedom" in text
    assert "differ: not linear" not in text


def test_the_budget_is_in_the_unit_of_the_combined_uncertainty():
    parameters = dict(reversed_().parameters)
    parameters["u0"] = replace(
        parameters["u0"], standard_uncertainty=2.65e-5, degrees_of_freedom=24.7, interval_95=(2.4999, 2.5001)
    )
    names = {"scatter of the data": 5e-6, "DAQ gain": 2.6e-5, "seating": 4.7e-8, "head reading": 1e-21}
    lines = tuple(replace(reversed_().budget[0], name=name, contributions={"u0": u}) for name, u in names.items())
    text = section("budget", replace(reversed_(), parameters=parameters, budget=lines))
    for name, cell in {
        "scatter of the data": "5.0",
        "DAQ gain": "26.0",
        "seating": "< 0.1",
        "head reading": "0",
    }.items():
        assert re.search(rf"{name} A [\d.]+ µV a dwell \d+ {re.escape(cell)} ", text)
    assert "u0 µV" in text
    assert "Combined u 26.5" in text
    assert "k for 95% 2.06" in text
    assert "Expanded U 100.0" in text


def test_the_correlation_matrix_shows_its_lower_triangle():
    text = section("correlation", replace(reversed_(), correlation=np.eye(6) * 0.05 + 0.95))
    assert "1 0.950 1 0.950 0.950 1 " in text
    assert "0.950 0.950 0.950 0.950 0.950 1 u0 kx ky kz kxy alpha0" in text


def test_the_published_method_stands_beside_with_what_its_z_flip_leaves_out():
    assert "its kz is off by kx sin(alpha0)" in section("published", face_up())
    text = section("published", flips_only())
    assert "17 mV/g for each degree of alpha0" in text
    assert "not identifiable needs a face-up sweep or flip" in text
    assert "sin(alpha0)" not in section("published", calibrate(dwells(FACE_UP[:1] + FACE_UP[2:])))


def test_the_provenance_holds_the_stand_file_flat():
    text = section("origin", face_up(), git_dirty=True)
    assert "head.limits_deg -180.0, 760.0" in text
    assert "SHA-256 of the raw file 0123abcd" in text
    assert "8669ad0 with uncommitted changes" in text
    assert "numpy 2.2.1" in text


def test_a_bare_table_needs_no_stand():
    text = section("origin", face_up(), stand={}, git_commit="")
    assert "Stand file" not in text
    assert "Commit" not in text
