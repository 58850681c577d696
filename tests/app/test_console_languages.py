"""What the application shows on the terminal and writes into reports is in the language that was asked for."""

import re

import pytest
from app_jobs import tumble
from test_language import ENGLISH

from tumble.app.headline import headline
from tumble.app.notebook import fit
from tumble.app.recall import open_store
from tumble.app.terminal import shown, speak
from tumble.messages import Language, Message

LANGUAGES = [Language.GERMAN, Language.UKRAINIAN]


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """A store with a calibration, done in German; what was said of it."""
    folder = tmp_path_factory.mktemp("store")
    programme = ["--programme", "quick", "--serial", "SN1", "--store", folder]
    return folder, tumble("--language", "de", "calibrate", *programme, "--verbose")


@pytest.fixture(autouse=True)
def english_again():
    yield
    speak(Language.ENGLISH)


def english_in(text, *names):
    """English words in a text, without these names and without numbers of version, paths and options."""
    for name in names:
        text = text.replace(str(name), "")
    return ENGLISH.findall(re.sub(r"\S*[/\\]\S*|--\w+", "", text))


def record_of(folder):
    (record,) = open_store(folder).find()
    return record


def headings(page):
    return re.findall(r"<h[1-4][^>]*>(.*?)</h[1-4]>", page, re.DOTALL)


def test_a_calibration_is_told_in_german(quick):
    folder, told = quick
    assert "Wert (Standardunsicherheit)" in told.out
    assert english_in(told.out + told.err, folder) == []


def test_numbers_on_the_terminal_have_a_decimal_comma(quick):
    _, told = quick
    assert re.search(r"\d,\d+\(\d+\) V", told.out)
    assert not re.search(r"\d\.\d+\(\d+\) V", told.out)


def test_the_report_of_a_calibration_is_german(quick):
    folder, _ = quick
    page = (folder / "reports" / f"{record_of(folder).id}.html").read_text("utf-8")
    assert '<html lang="de">' in page
    assert english_in("\n".join(headings(page))) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_report_written_anew_is_in_the_language_of_the_command(quick, tmp_path, language):
    folder, _ = quick
    out = tmp_path / "page.html"
    tumble("--language", language, "report", record_of(folder).id, "--store", folder, "--out", out)
    again = tumble("report", record_of(folder).id, "--store", folder, "--out", out)  # it is known as a report
    assert again.status == 0
    assert '<html lang="en">' in out.read_text("utf-8")


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("what", [["list"], ["show"], ["verify"], ["compare"]], ids=lambda what: what[0])
def test_records_are_told_without_a_word_of_english(quick, language, what):
    folder, _ = quick
    ids = {"show": 1, "compare": 2}.get(what[0], 0) * [record_of(folder).id]
    told = tumble("--language", language, "records", *what, *ids, "--store", folder)
    assert told.status == 0
    assert len(told.out) > 50
    assert english_in(told.out, folder) == []


@pytest.mark.parametrize("language", LANGUAGES)
@pytest.mark.parametrize("programme", ["quick", "seed"])
def test_a_plan_is_told_without_a_word_of_english(language, programme):
    told = tumble("--language", language, "plan", programme, "--steps")
    assert told.status == 0
    assert english_in(told.out) == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_a_closed_loop_is_told_without_a_word_of_english(quick, tmp_path, language):
    folder, _ = quick
    (recording,) = (folder / "recordings").glob("*/*.mcap")
    page = tmp_path / "loop.html"
    told = tumble("--language", language, "close-loop", recording, "--store", tmp_path, "--report", page)
    assert told.status == 0
    assert english_in(told.out + told.err, folder, tmp_path) == []
    assert f'<html lang="{language}">' in page.read_text("utf-8")


def test_the_list_names_the_parameter_that_its_method_puts_first(quick):
    folder, _ = quick
    listed = tumble("records", "list", "--store", folder).out
    assert headline(record_of(folder)).name == "kx"
    assert "result" in listed
    assert "kx 1.00" in listed


def test_text_that_is_no_message_stays_as_it_is():
    speak(Language.UKRAINIAN)
    assert shown("run 0.5 V") == "run 0.5 V"
    assert shown(Message("{size} rms", size="0.5 V")).startswith("0,5 В")


def test_a_notebook_has_headings_in_the_language_that_is_spoken(quick):
    folder, _ = quick
    (recording,) = (folder / "recordings").glob("*/*.mcap")
    result = fit(recording)
    speak(Language.GERMAN)
    assert "<th>Wert (Standardunsicherheit)</th>" in result._repr_html_()
