"""An instrument past its due date is told of by run, recording and report alike."""

from datetime import UTC, date, datetime, timedelta

import pytest
from app_jobs import STAND, tumble

from tumble.app.stand import load_stand, same_instruments
from tumble.drivers.tables import DaqTable
from tumble.procedures.errors import InputError
from tumble.procedures.events import WarningRaised
from tumble.procedures.recording.reader import read_recording

DUE = date(2026, 3, 31)


@pytest.mark.parametrize(("on", "overdue"), [(date(2026, 3, 30), False), (DUE, False), (date(2026, 4, 1), True)])
def test_on_its_due_date_a_calibration_still_holds(on, overdue):
    assert DaqTable(driver="simulated", calibration_due=DUE).overdue(on) is overdue


def test_without_a_due_date_nothing_is_overdue():
    assert not DaqTable(driver="simulated").overdue(date.max)


@pytest.mark.parametrize(
    "written", ["20260331", "1774915200", '"20260331"', '"31.03.2026"', "2026-03-31T12:00:00", "true", '"2026-02-30"']
)
def test_what_is_no_day_is_refused_with_its_line(write, written):
    """Numbers were taken for seconds since 1970, and so for a day long past."""
    path = write("stand.toml", STAND.replace("[daq]\n", f"[daq]\ncalibration_due = {written}\n"))
    with pytest.raises(InputError, match=r"daq: calibration_due"):
        load_stand(path)


def test_recording_and_report_say_what_is_overdue(write, tiny, tmp_path):
    today = datetime.now(tz=UTC).date()
    dated = STAND.replace("[daq]\n", f"[daq]\ncalibration_due = {today - timedelta(days=1)}\n")
    dated = dated.replace("[head]\n", f"[head]\ncalibration_due = {today}\n")
    sentence = f"stand bench-1: the calibration of the daq was due on {today - timedelta(days=1)}; have it done"

    ran = tumble(
        "calibrate", "--stand", write("old.toml", dated), "--programme", tiny, "--serial", "A", "--store", tmp_path
    )

    assert f"warning: {sentence}" in ran.err
    assert "calibration of the head" not in ran.err
    (recording,) = tmp_path.glob("recordings/A/*.mcap")
    warned = [event.message for event in read_recording(recording).events if isinstance(event, WarningRaised)]
    assert warned == [sentence]
    (report,) = tmp_path.glob("reports/*.html")
    assert report.read_text("utf-8").count(sentence) == 1


def test_a_stand_is_known_by_its_name_and_its_instruments(write):
    here = load_stand(write("a.toml", STAND))
    dated = load_stand(write("b.toml", STAND.replace("[daq]\n", "[daq]\ncalibration_due = 2027-01-31\n")))
    other = load_stand(write("c.toml", STAND.replace("[head]\n", '[head]\nserial = "H-2"\n')))
    assert same_instruments(dated.recorded, here)
    assert not same_instruments(other.recorded, here)
    assert same_instruments({}, here)
