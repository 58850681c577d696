"""What a run and its faults say on the terminal is said in the language that was asked for; documents are English."""

import json
import re
from dataclasses import replace

import pytest
from app_jobs import at_call, raiser, tumble

from tumble.drivers.errors import CHECK_CABLE, NO_ANSWER, DeviceError, LinkLostError
from tumble.drivers.simulated.daq import SimulatedDaq
from tumble.drivers.simulated.head import SimulatedHead
from tumble.messages import Language, Message
from tumble.procedures.recording.reader import read_recording

ENGLISH = re.compile(r"\b(the|is|are|not|and|has|have|then|check|after|at|of|to|it|its|no|with|where|give|cannot)\b")
"""Words without which hardly an English sentence is made, and which are none in German or Ukrainian."""
TITLE = Message("dividing head")


def run_in(language, tiny, tmp_path):
    recording = tmp_path / "x.mcap"
    return tumble("--language", language, "run", "--programme", tiny, "--serial", "A", "--out", recording), recording


def lost(monkeypatch):
    at_call(monkeypatch, SimulatedDaq, "acquire", 5, raiser(DeviceError(TITLE, NO_ANSWER, CHECK_CABLE)))


def lost_for_a_moment(monkeypatch):
    at_call(monkeypatch, SimulatedHead, "status", 20, raiser(LinkLostError(TITLE, NO_ANSWER, CHECK_CABLE)), last=20)


def turned_away(monkeypatch):
    status = SimulatedHead.status
    monkeypatch.setattr(SimulatedHead, "status", lambda head: replace(status(head), angle_deg=777.0))


def short_of_samples(monkeypatch):
    acquire = SimulatedDaq.acquire

    def short(daq, samples, rate_hz):
        block = acquire(daq, samples, rate_hz)
        return replace(block, voltage_v=block.voltage_v[:-1])

    monkeypatch.setattr(SimulatedDaq, "acquire", short)


def broken(monkeypatch):
    at_call(monkeypatch, SimulatedHead, "start_move", 3, raiser(ZeroDivisionError("7")))


def standing_still(monkeypatch):
    monkeypatch.setattr(SimulatedHead, "start_move", lambda *_: None)


@pytest.mark.parametrize("language", [Language.GERMAN, Language.UKRAINIAN])
@pytest.mark.parametrize("fault", [lost, lost_for_a_moment, turned_away, short_of_samples, broken, standing_still])
def test_a_fault_is_told_without_a_word_of_english(tiny, tmp_path, monkeypatch, fault, language):
    fault(monkeypatch)
    ran, _ = run_in(language, tiny, tmp_path)
    told = ran.err.replace(str(tmp_path), "")
    assert len(told) > 50
    assert ENGLISH.findall(told) == []


def test_a_fault_of_a_device_is_told_in_german(tiny, tmp_path, monkeypatch):
    lost(monkeypatch)
    ran, recording = run_in("de", tiny, tmp_path)
    assert ran.complaint == (
        "Teilkopf: antwortet nicht; Kabel prüfen, dann den Lauf fortsetzen; "
        f"1 vollständiger Messpunkt gespeichert in {recording}"
    )


def test_what_is_recorded_stays_english(tiny, tmp_path, monkeypatch):
    lost(monkeypatch)
    _, recording = run_in("de", tiny, tmp_path)
    assert read_recording(recording).ending.message == (
        "dividing head: does not answer; check its cable, then resume the run"
    )


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("dwell_s = 0.0", "tiny.toml, Zeile 1: dwell_s: Muss größer als 0 sein; berichtigen"),
        ("swell_s = 1.0", "tiny.toml, Zeile 1: swell_s: Dieser Eintrag ist hier nicht vorgesehen; "
                          "Schreibweise berichtigen oder entfernen"),
        ('dwell_s = "long"', "tiny.toml, Zeile 1: dwell_s: Muss eine Zahl sein, der Text ist keine; berichtigen"),
    ],
)  # fmt: skip
def test_a_mistake_in_a_programme_is_told_in_german(tiny, line, said):
    text = "\n".join(kept for kept in tiny.read_text().splitlines() if not kept.startswith("dwell_s"))
    tiny.write_text(f"{line}\n{text}\n")
    assert tumble("--language", "de", "plan", tiny).complaint == said


def test_a_missing_programme_is_told_in_german():
    assert tumble("--language", "de", "plan", "no.toml").complaint.startswith(
        "no.toml: diese Datei gibt es nicht; eine TOML-Datei oder eines von "
    )


def test_the_environment_names_the_language_of_every_command(monkeypatch):
    monkeypatch.setenv("TUMBLE_LANGUAGE", "uk")
    assert "такого файлу немає" in tumble("plan", "no.toml").complaint


def test_an_option_outdoes_the_environment(monkeypatch):
    monkeypatch.setenv("TUMBLE_LANGUAGE", "uk")
    assert "there is no such file" in tumble("--language", "en", "plan", "no.toml").complaint


def test_english_is_spoken_where_nothing_is_asked_for():
    tumble("--language", "de", "plan", "no.toml")
    assert "there is no such file" in tumble("plan", "no.toml").complaint


def test_a_language_that_is_none_is_wrong_usage(monkeypatch):
    monkeypatch.setenv("TUMBLE_LANGUAGE", "tlh")
    ran = tumble("plan")
    assert ran.status == 2
    assert "'tlh' is not one of 'en', 'uk', 'de'" in ran.err


def test_documents_are_english_in_every_language(tiny):
    plans = [tumble("--language", language, "plan", tiny, "--json", "-").out for language in Language]
    assert json.loads(plans[0])
    assert plans[0] == plans[1] == plans[2]
