"""What the analysis of an accelerometer says, put into German: no English word is left."""

import re
from dataclasses import replace

import numpy as np
import pytest
from loop_examples import clean, misread, timed, with_k_xx
from report_examples import FACE_UP, FLIPS, dwells, face_up, flips_only, page_of, provenance, reversed_

from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.methods.dividing_head.effects.unnamed import unnamed
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.judging import judge
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.loop.sections import sections
from tumble.calibrations.methods.dividing_head.loop.sentences import headline
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.method import METHOD
from tumble.calibrations.methods.dividing_head.probes import PROBES
from tumble.calibrations.methods.dividing_head.questions import questioned
from tumble.calibrations.methods.dividing_head.significance import closure_sentence, statements
from tumble.calibrations.report.language import written_in
from tumble.messages import Language, Message
from tumble.numerals import localised

ENGLISH = re.compile(r"\b(the|of|and|is|are|with|not|from|by|each|that|or|to|which|no|other|than)\b")
"""Words without which hardly an English sentence does, and that German lacks."""


def leaves(text):
    """What a text is put together from: every template in German, and every field that is plain text."""
    if isinstance(text, Message):
        yield localised(text.in_language(Language.GERMAN), Language.GERMAN)
        for field in text.fields.values():
            yield from leaves(field)
    elif isinstance(text, str) and not text.startswith("tumble "):
        yield localised(text, Language.GERMAN)


def english(texts):
    """The parts of these texts that are English still."""
    return [leaf for text in texts for leaf in leaves(text) if ENGLISH.search(leaf)]


def said_in(shown):
    """Every text of the sections of a result."""
    for section in shown:
        yield from (section.title, section.caption, *section.headings, *section.lines)
        for row in section.rows:
            yield from row


@pytest.mark.parametrize("loop", [with_k_xx, clean, misread], ids=lambda loop: loop.__name__)
def test_a_closed_loop(loop):
    shown = list(said_in(sections(loop())))
    assert shown
    assert english([*shown, *loop().augmented.warnings]) == []


def test_an_effect_is_named_in_the_sentence_that_says_it_was_found():
    assert "Nichtlinearität zweiter Ordnung k_xx" in headline(with_k_xx()).in_language(Language.GERMAN)


@pytest.mark.parametrize("calibration", [face_up, reversed_, flips_only], ids=lambda made: made.__name__)
def test_significance_identifiability_and_closure(calibration):
    said = [statement.text for statement in statements(calibration())]
    assert said
    assert english([*said, *calibration().warnings, calibration().noise.basis]) == []
    assert english(parameter.condition for parameter in calibration().parameters.values()) == []
    if calibration().closure:
        assert english([closure_sentence(calibration().closure)]) == []


@pytest.mark.parametrize("calibration", [face_up, reversed_, flips_only], ids=lambda made: made.__name__)
@pytest.mark.parametrize("limits", [(0.0, 10.0), (100.0, 101.0), (None, 1e-12)])
def test_a_verdict(calibration, limits):
    low, high = limits
    checks = [LimitCheck(name=name, minimum=low, maximum=high, inside=True) for name in calibration().parameters]
    judged = judge(calibration(), checks).parameters
    assert english([text for each in judged for text in (each.reason, each.remedy)]) == []


def dead(rows):
    return replace(rows, voltage_v=np.full(len(rows), 2.5))


def unturned(rows):
    return replace(rows, angle_deg=np.full(len(rows), 10.0), mount=np.full(len(rows), "face-up"))


def in_radians(rows):
    return replace(rows, angle_deg=np.deg2rad(rows.angle_deg))


def in_kelvin(rows):
    return replace(rows, temperature_degc=np.full(len(rows), 296.0))


def inverted(rows):
    return replace(rows, voltage_v=-rows.voltage_v)


def in_millivolts(rows):
    return replace(rows, voltage_v=1e3 * rows.voltage_v)


@pytest.mark.parametrize(
    "spoilt", [dead, unturned, in_radians, in_kelvin, inverted, in_millivolts], ids=lambda spoil: spoil.__name__
)
def test_a_question(spoilt):
    asked = questioned(spoilt(dwells([*FACE_UP, *FLIPS])))
    assert asked.questions
    assert all(isinstance(question, Message) for question in asked.questions)
    assert english(asked.questions) == []


def test_what_is_not_traced():
    loop = close_loop(dead(dwells([*FACE_UP, *FLIPS])))
    assert english([headline(loop), *loop.declared.warnings]) == []


def test_structure_without_a_name():
    scene = dividing_head_table(fit_jointly(timed(with_k_xx()).augmented.observations), ()).scene
    said = [phrase for axis in unnamed(scene) for phrase in (axis.channel.phrase, axis.coordinate.phrase)]
    assert said
    assert english(said) == []


def test_the_method_and_what_its_probes_do():
    assert english([METHOD.title, METHOD.columns, *(probe.does for probe in PROBES)]) == []


def spoken_of(page):
    """What a reader sees or hears of a page."""
    body = re.sub(r"<style>.*?</style>|<script>.*?</script>", " ", page, flags=re.DOTALL)
    labels = re.findall(r'aria-label="([^"]*)"', body)
    return [*labels, *filter(str.strip, re.findall(r">([^<]*)<", body))]


@pytest.mark.parametrize("calibration", [face_up, reversed_, flips_only], ids=lambda made: made.__name__)
def test_a_page(calibration):
    limits = (
        LimitCheck(name="kx", minimum=0.0, maximum=10.0, inside=True),
        LimitCheck(name="kxy", minimum=0.0, maximum=1.0, inside=True),
    )
    with written_in(Language.GERMAN):
        page = page_of(calibration(), provenance(), limits=limits)
    assert '<html lang="de">' in page
    assert [text for text in spoken_of(page) if ENGLISH.search(text)] == []


def test_a_page_with_a_closed_loop():
    with written_in(Language.GERMAN):
        page = page_of(with_k_xx().declared, provenance(), loop=with_k_xx())
    assert [text for text in spoken_of(page) if ENGLISH.search(text)] == []
    assert "Was das Modell unerklärt lässt" in page


def test_a_page_is_english_unless_a_language_is_asked_for():
    page = page_of(reversed_(), provenance())
    assert '<html lang="en">' in page
    assert "Uncertainty budget" in page
