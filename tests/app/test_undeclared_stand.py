"""A stand whose uncertainties nobody states: every result says what is left out of its own."""

import json

import pytest
from app_jobs import STAND, tumble

from tumble.app.analysing import fit, trace
from tumble.app.measurements import read_measurement
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.calibrations.methods.dividing_head.report.results import notices
from tumble.calibrations.methods.dividing_head.report.subject import Subject

NOTHING = "the stand's contribution is not included in the stated uncertainty"
PART = "part of the stand's contribution is not included in the stated uncertainty"
TABLE = "angle_deg,voltage_V\n" + "".join(
    f"{angle},{volts}\n" for angle, volts in [(-90, 3.5), (90, 1.5), (180, 2.51), (0, 2.49)] * 2
)


@pytest.fixture
def csv(write):
    return write("flips.csv", TABLE.replace("3.5", "3.5001", 1))


def warnings(ran):
    return "\n".join(json.loads(ran.out)["warnings"])


@pytest.mark.parametrize("command", ["fit", "close-loop"])
def test_a_table_without_a_stand_file_says_so_in_json_and_on_the_terminal(csv, command):
    assert NOTHING in warnings(tumble(command, csv, "--json", "-"))
    assert f"warning: {NOTHING}" in tumble(command, csv).err


def test_a_stand_file_that_states_nothing_says_so(csv, stand):
    assert NOTHING in warnings(tumble("fit", csv, "--stand", stand, "--json", "-"))


def test_a_stand_file_that_states_a_part_says_what_is_missing(csv, write):
    text = STAND.replace("[head]\n", "[head]\naccuracy_arcsec = 5.0\n").replace(
        "[daq]\n", "[daq]\ngain_uncertainty = 0\n"
    )

    said = warnings(tumble("fit", csv, "--stand", write("b.toml", text), "--json", "-"))

    assert f"{PART}: the stand file does not state seating_arcsec, offset_uncertainty_v" in said


def test_a_stand_file_that_states_all_leaves_nothing_to_say(calibrated):
    assert calibrated.document["warnings"] == []
    assert "not included" not in calibrated.ran.err


def test_what_is_stated_as_nothing_is_stated():
    stand = StandUncertainty(head_accuracy_arcsec=0.0, seating_arcsec=0.0, daq_gain=0.0, daq_offset_v=0.0)

    assert stand.left_out == ""


def test_the_report_and_the_window_say_it_too(csv):
    traced = trace(fit(read_measurement(csv), trials=0))

    said = notices(Subject(calibration=traced.calibration, provenance=traced.provenance, loop=traced.loop))

    assert any(notice.startswith(NOTHING) for notice in said)
