"""Reports that the window writes are in its language."""

import pytest

from tumble.app.recall import open_store
from tumble.app.running import Job
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.messages import Language
from tumble.procedures.programmes import load_programme
from tumble.window.look.language import speak
from tumble.window.work import records
from tumble.window.work.activity import Calibration


@pytest.fixture
def german(lent_driver):
    speak(Language.GERMAN)
    yield
    speak(Language.ENGLISH)


def test_a_calibration_and_its_export_are_written_in_the_language_of_the_window(german, tmp_path):
    stand = load_stand(None)
    job = Job(stand=stand, programme=load_programme("quick"), serial_number="A", operator="")
    concluded = Calibration(job=job, store=tmp_path).measure(connect(stand), [], lambda _: None)(lambda _: None)
    (record,) = open_store(tmp_path).find()
    exported = records.export(tmp_path, record.id, tmp_path / "page.html")
    for page in (concluded.report, exported):
        assert '<html lang="de">' in page.read_text("utf-8")
