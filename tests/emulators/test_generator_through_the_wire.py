"""A function generator behind its real driver, and clients that nobody here wrote."""

import time
from contextlib import contextmanager

import numpy as np
import pytest

from benchmarks.endurance.shaker import (
    GENERATOR,
    METERS,
    SIMULATED_EXCITER,
    SIMULATED_METER,
    job_at,
    served,
    written,
)
from tumble.app.measurements import read_measurement
from tumble.app.running import run
from tumble.app.stand import load_stand
from tumble.app.wiring import connect
from tumble.drivers.errors import DeviceError, LimitError, LinkLostError, NoReplyError
from tumble.drivers.excitation import REST, Random, excitation_of
from tumble.drivers.protocols import Exciter, Reconnectable
from tumble.emulators.faults import At
from tumble.procedures.events import FinishReason

TWO = GENERATOR.replace("x = {", "y = { channel = 2, g_per_v = 3.0 }\nx = {")
FIVE_G = excitation_of("sine 5 g 80 Hz")


@contextmanager
def generator(folder, tables=GENERATOR, **settings):
    with served(folder, f"{tables}\n{METERS}", **settings) as stand, stand.connected() as made:
        yield made.stand.exciters["exciter"], stand


def test_it_fits_the_protocol_and_says_who_it_is(tmp_path):
    with generator(tmp_path) as (driver, _):
        fits: Exciter = driver
        assert isinstance(fits, Reconnectable)
        assert (driver.identify().model, driver.identify().serial) == ("Agilent Technologies 33522B", "MY52800001")


def test_a_level_is_told_read_back_and_shakes(tmp_path):
    with generator(tmp_path) as (driver, stand):
        driver.drive(FIVE_G)
        status = driver.status()
        assert (status.on, status.overload) == (True, False)
        assert status.excitation.text == "sine 5 g 80 Hz"
        assert stand.exciter.driven.tones[0].level_g == pytest.approx(5.0)


def test_a_new_level_changes_nothing_but_the_amplitude(tmp_path):
    with generator(tmp_path) as (driver, stand):
        driver.drive(FIVE_G)
        stand.suffer("error_queued", At(command=1, containing="OUTP1 ON"))  # which is not sent again
        driver.drive(FIVE_G.scaled(0.5))
        assert driver.status().excitation.text == "sine 2.5 g 80 Hz"


def test_made_safe_it_has_its_least_amplitude_and_is_off(tmp_path):
    with generator(tmp_path) as (driver, stand):
        driver.drive(FIVE_G)
        driver.make_safe()
        assert (driver.status().on, driver.status().excitation, stand.exciter.driven) == (False, REST, REST)


def test_two_shakers_have_their_phases(tmp_path):
    with generator(tmp_path, TWO) as (driver, stand):
        driver.drive(excitation_of("sine x 5 g 40 Hz 0 deg, y 3 g 40 Hz 90 deg"))
        assert driver.status().excitation.text == "sine x 5 g 40 Hz 0 deg, y 3 g 40 Hz 90 deg"
        assert [tone.phase_deg for tone in sorted(stand.exciter.driven.tones, key=lambda tone: tone.shaker)] == [
            0.0,
            90.0,
        ]


def test_random_vibration_is_loaded_and_has_its_level(tmp_path):
    wanted = excitation_of("random 20 Hz 0.004, 200 Hz 0.004")
    with generator(tmp_path) as (driver, stand):
        driver.drive(wanted)
        assert driver.status().excitation.rms_g == pytest.approx(wanted.rms_g, rel=1e-4)
        shaken = stand.exciter.driven
        assert isinstance(shaken, Random)
        assert shaken.rms_g == pytest.approx(wanted.rms_g, rel=1e-3)
        assert (shaken.frequencies_hz[0], shaken.frequencies_hz[-1]) == (
            pytest.approx(20.0, abs=0.2),
            pytest.approx(200.0, abs=0.2),
        )


@pytest.mark.parametrize(
    ("excitation", "what"),
    [("sine 13 g 80 Hz", "13 g"), ("sine 5 g 3 Hz", "3 Hz"), ("sine y 5 g 80 Hz 0 deg", "no shaker along y")],
)
def test_what_the_limits_forbid_is_not_sent(excitation, what, tmp_path):
    with generator(tmp_path) as (driver, stand):
        with pytest.raises(LimitError, match=what):
            driver.drive(excitation_of(excitation))
        assert stand.exciter.driven == REST


def test_what_it_refuses_is_told_with_its_own_words(tmp_path):
    with generator(tmp_path) as (driver, stand):
        stand.suffer("error_queued", At(command=1, containing="FREQ 80"))
        with pytest.raises(DeviceError, match=r"refuses what it was told: -310"):
            driver.drive(FIVE_G)


def test_an_overload_is_reported(tmp_path):
    with generator(tmp_path) as (driver, stand):
        stand.suffer("alarm", At(command=1))
        assert driver.status().overload


def test_where_the_link_is_lost_it_goes_on_driving_until_it_is_reached_anew(tmp_path):
    with generator(tmp_path) as (driver, stand):
        driver.drive(FIVE_G)
        stand.suffer("drop", At(command=1), lasts_s=0.2)
        with pytest.raises((LinkLostError, NoReplyError)):
            driver.status()
        assert stand.exciter.driven == FIVE_G
        time.sleep(0.3)  # the port is away for so long
        driver.reconnect()
        driver.make_safe()
        assert not driver.status().on


@pytest.fixture(scope="module")
def in_process(tmp_path_factory):
    folder = tmp_path_factory.mktemp("here")
    stand = load_stand(written(folder, f"{SIMULATED_EXCITER}\n{SIMULATED_METER}", {}))
    assert run(job_at(stand), connect(stand), folder / "run.mcap").reason is FinishReason.COMPLETED
    return read_measurement(folder / "run.mcap").observations


def test_through_the_wire_the_run_is_that_of_the_stand_in_this_process(in_process, tmp_path):
    with served(tmp_path) as stand, stand.connected() as made:
        outcome = run(stand.job, made, tmp_path / "run.mcap")
    assert (outcome.reason, outcome.at_standstill) == (FinishReason.COMPLETED, True), outcome.message
    rows = read_measurement(tmp_path / "run.mcap").observations
    assert rows.ai_g == pytest.approx(in_process.ai_g, abs=1e-4)
    rectified = [each.output_ug[1] - (each.output_ug[0] + each.output_ug[2]) / 2.0 for each in (rows, in_process)]
    uncertainty_ug = np.sqrt(np.sum(in_process.output_u_ug**2))
    assert rectified[0] == pytest.approx(rectified[1], abs=5.0 * uncertainty_ug)
    assert rectified[0] == pytest.approx(220.0 * 12.5, abs=5.0 * uncertainty_ug)
