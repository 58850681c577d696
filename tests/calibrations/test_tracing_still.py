"""A unit that is left still in one pose."""

from dataclasses import replace

import numpy as np
import pytest

from tumble.calibrations.methods.dividing_head.document import document
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.loop.sentences import headline
from tumble.calibrations.methods.dividing_head.observations import Observations

# GAINS-ASEN23/Flight-Software, a public repository: an accelerometer in one pose for 20 min after switch-on; four
# of its means of 10 s from each of four logs. Time in s, output in g written as volts, temperature in counts / 100.
WARMING = (
    (5, 1.0850378, 32.4375),
    (95, 1.0853263, 32.7368),
    (185, 1.0841894, 33.0811),
    (275, 1.0830793, 33.5387),
    (1005, 1.0821634, 33.8514),
    (1095, 1.0813036, 34.2956),
    (1185, 1.0804751, 34.6638),
    (1275, 1.0798982, 35.0130),
    (2005, 1.0793202, 35.3249),
    (2095, 1.0789675, 35.5874),
    (2185, 1.0783834, 35.8422),
    (2275, 1.0782350, 36.1450),
    (3005, 1.0780052, 36.3282),
    (3095, 1.0777972, 36.5528),
    (3185, 1.0775942, 36.8480),
    (3275, 1.0773775, 37.0792),
)


def left_still(procedure=None):
    time_s, volts, degc = np.array(WARMING).T
    count = len(WARMING)
    return Observations(
        row=np.arange(1, count + 1),
        angle_deg=np.full(count, -90.0),
        voltage_v=volts,
        time_s=time_s,
        temperature_degc=degc,
        procedure=None if procedure is None else np.full(count, procedure),
        source="still",
    )


def test_a_head_that_never_turned_is_asked_about_with_how_to_say_that_it_was_meant():
    (question, _stand) = close_loop(left_still()).augmented.warnings
    assert question.endswith("If the unit was left still on purpose, write still into the column procedure")


def test_one_that_was_left_still_on_purpose_is_not_asked_about():
    loop = close_loop(left_still("still"))
    assert [warning for warning in loop.augmented.warnings if "never turned" in warning] == []
    assert headline(loop).startswith("Nothing was traced: the unit was left in one pose, in which bias, scale factor")


@pytest.mark.parametrize("procedure", [None, "still"])
def test_the_slope_with_temperature_is_stated_over_all_and_at_both_ends(procedure):
    temperature, _ = document(close_loop(left_still(procedure)))["still"]
    assert (temperature["variable"], temperature["unit"]) == ("temperature", "V/K")
    assert temperature["value"] == pytest.approx(-1.87e-3, rel=0.1)
    assert temperature["first"] < temperature["value"] < temperature["last"] < 0.0


def test_no_parameter_is_identifiable_in_one_pose():
    parameters = close_loop(left_still("still")).augmented.parameters
    assert [parameters[name].value for name in ("u0", "kx")] == [None, None]


def test_temperature_and_time_that_went_together_are_not_distinguishable():
    assert "which of the two it follows is not distinguishable" in headline(close_loop(left_still("still")))


def test_an_output_that_follows_nothing_says_so():
    rows = left_still("still")
    quiet = 1.0 + 1e-4 * np.resize([1.0, -1.0], len(rows))
    assert "does not follow the temperature" in headline(close_loop(replace(rows, voltage_v=quiet)))


def test_one_pose_without_time_or_temperature_says_nothing_more():
    rows = replace(left_still("still"), time_s=None, temperature_degc=None)
    assert document(close_loop(rows))["still"] == []
