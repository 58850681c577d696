from threading import Thread

from tumble.app.calibrating import calibrate
from tumble.app.running import Job, run
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.calibrations.records.store import Store
from tumble.procedures.events import PointCompleted
from tumble.procedures.programmes import load_programme


def test_a_calibration_takes_a_few_lines(tmp_path, no_report):
    stand = load_stand()
    job = Job(stand=stand, programme=load_programme("quick"), serial_number="SN-7")
    done = calibrate(job, connect(stand), tmp_path)
    kx = done.analysed.calibration.parameters["kx"]

    assert abs(kx.value - 1.0) < 3 * kx.standard_uncertainty
    assert done.report.is_file()
    assert Store(tmp_path).latest("SN-7") == done.record


def test_the_stages_are_told_in_their_order(tiny, tmp_path, no_report):
    stand = load_stand()
    job = Job(stand=stand, programme=load_programme(tiny), serial_number="A")
    told = []

    calibrate(job, connect(stand), tmp_path, tell=told.append)

    assert told == ["fitting", "tracing", "storing", "reporting"]


def test_a_run_in_another_thread_leaves_signals_alone_and_is_heard(tiny, tmp_path):
    stand = load_stand()
    job = Job(stand=stand, programme=load_programme(tiny), serial_number="A")
    heard = []

    thread = Thread(target=run, args=(job, connect(stand), tmp_path / "x.mcap", [heard.append]))
    thread.start()
    thread.join()

    assert sum(isinstance(event, PointCompleted) for event in heard) == 6
