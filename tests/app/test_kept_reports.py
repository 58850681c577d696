"""The report of a record, written again: by what was kept of it, or from its raw file where that no longer counts."""

import gzip
import json

import pytest
from app_jobs import tumble

from tumble.app import analysing
from tumble.app.kept_reports import of_record
from tumble.app.opening import open_store
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.report.document import Front, Report


@pytest.fixture
def unanalysed(monkeypatch):
    """Nothing can be analysed."""
    for name in ("fit", "trace"):
        monkeypatch.setattr(analysing, name, lambda *_, **__: 1 / 0)


def kept_of(done):
    return done.store / "report-words" / f"{done.document['record']}.json.gz"


def report(done, out, *language):
    return tumble(*language, "report", done.document["record"], "--store", done.store, "--out", out)


@pytest.mark.parametrize("name", ["again.html", "again.pdf"])
def test_it_takes_no_analysis(copied, unanalysed, tmp_path, name):
    assert report(copied, tmp_path / name).status == 0
    assert (tmp_path / name).stat().st_size > 10_000


def test_it_is_the_page_that_was_written_at_first(copied, unanalysed, tmp_path):
    first = (copied.store / "reports" / f"{copied.document['record']}.html").read_text("utf-8")
    report(copied, tmp_path / "again.html")
    assert (tmp_path / "again.html").read_text("utf-8") == first


@pytest.mark.parametrize(("language", "word"), [("de", "Messunsicherheitsbudget"), ("uk", "Бюджет невизначеності")])
def test_it_is_written_in_any_language(copied, unanalysed, tmp_path, language, word):
    assert report(copied, tmp_path / "again.html", "--language", language).status == 0
    assert word in (tmp_path / "again.html").read_text("utf-8")


SPOILT = {
    "empty": b"",
    "no gzip": b"words",
    "no JSON": gzip.compress(b"words"),
    "another object": gzip.compress(b"{}"),
    "no object": gzip.compress(b"[]"),
}


@pytest.mark.parametrize("spoilt", SPOILT.values(), ids=SPOILT)
def test_what_cannot_be_read_is_worked_out_anew(copied, tmp_path, spoilt):
    kept_of(copied).write_bytes(spoilt)
    assert report(copied, tmp_path / "again.html").status == 0
    assert "Uncertainty budget" in (tmp_path / "again.html").read_text("utf-8")


def test_what_is_lost_is_worked_out_and_kept_again(copied, tmp_path):
    kept_of(copied).unlink()
    assert report(copied, tmp_path / "again.html").status == 0
    assert kept_of(copied).is_file()


def test_what_was_kept_of_another_record_does_not_count(copied, unanalysed, tmp_path):
    content = json.loads(gzip.decompress(kept_of(copied).read_bytes()))
    kept_of(copied).write_bytes(gzip.compress(json.dumps(content | {"record_sha256": "0" * 64}).encode()))
    assert report(copied, tmp_path / "again.html").status == 70  # it went on to the analysis


def test_once_the_raw_file_has_changed_it_does_not_count_either(copied, unanalysed, tmp_path):
    copied.recording.write_bytes(copied.recording.read_bytes()[:-100])
    assert report(copied, tmp_path / "again.html").status != 0


def test_a_raw_file_that_was_exchanged_gives_no_report_of_the_record(copied, tmp_path):
    copied.recording.write_bytes(copied.recording.read_bytes() + b"\0")
    ran = report(copied, tmp_path / "again.html")
    assert ran.status == 2
    assert "is not as it was when the record was made" in ran.err
    assert not (tmp_path / "again.html").exists()


@pytest.mark.parametrize(("part", "told"), [(0.0, False), (0.001, False), (0.02, True)])
def test_values_that_are_not_those_of_the_record_are_told_of(copied, part, told):
    record = open_store(copied.store).get(copied.document["record"])
    stated = {
        name: Parameter(name=name, unit=held.unit, value=held.value + part * held.standard_uncertainty)
        for name, held in record.values.items()
        if held.value is not None
    }
    front = Front(provenance=record.provenance, parameters=stated, verdict=record.verdict)
    notices = of_record(Report(kind="", title="", front=front), record, copied.store).notices
    assert [each.startswith("The record holds other values of u0, kx") for each in notices] == [True] * told
