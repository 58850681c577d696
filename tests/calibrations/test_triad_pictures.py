"""What is drawn and listed of a triad by position."""

import re

import numpy as np
import pytest
from test_triad_loop import loop_of
from triad_tables import gravity

from tumble.calibrations.methods.triad.mismatch import position_mismatch
from tumble.calibrations.methods.triad.picture_sections import picture_sections, position_section
from tumble.calibrations.methods.triad.pose_picture import MOST, case_axes, pose_picture, pose_pictures
from tumble.calibrations.methods.triad.programmes import POSITIONS
from tumble.calibrations.methods.triad.sections import sections, sections_beside_values


@pytest.fixture(scope="module")
def square(tmp_path_factory):
    """A table in which channel x has a square of 4 mV/g²."""

    def added(g, outer_deg, inner_deg):
        return np.column_stack([4e-3 * g[:, 0] ** 2, np.zeros((len(g), 2))])

    return loop_of(tmp_path_factory.mktemp("square"), passes=2, added=added)


@pytest.mark.parametrize(("outer_deg", "inner_deg"), [(0.0, 0.0), (90.0, 30.0), (-135.0, 75.0), (180.0, -90.0)])
def test_a_picture_stands_as_the_unit_does(outer_deg, inner_deg):
    down = -case_axes(outer_deg, inner_deg)[:, 2]

    (wanted,) = gravity(np.array([outer_deg]), np.array([inner_deg]))

    assert down == pytest.approx(wanted, abs=1e-12)


def test_a_picture_says_its_angles_to_a_screen_reader():
    assert 'aria-label="outer 90°, inner -45°"' in pose_picture(90.0, -45.0)


def test_every_position_of_a_programme_is_drawn_with_its_number():
    drawn = pose_pictures(POSITIONS["24"])

    assert re.findall(r">(\d+): ", drawn) == [str(number) for number in range(1, 25)]


def test_a_long_programme_is_drawn_in_part():
    assert pose_pictures([(float(place), 0.0) for place in range(100)]).count("<g ") == MOST


def test_letters_have_whole_sizes():
    """Qt draws letters of less than one unit with none at all."""
    sizes = re.findall(r'font-size="([^"]+)"', pose_picture(90.0, 0.0))

    assert all(float(size) >= 1.0 for size in sizes)


def test_the_mismatch_of_a_position_is_the_mean_of_its_dwells(square):
    found = position_mismatch(square)
    dwells = square.before.mismatch_arcsec(square.observations.outputs_v)

    assert found.dwells[:4].tolist() == [2, 2, 2, 4]  # the fourth is in two circles of the programme
    rows = square.observations
    here = (rows.outer_deg == 90.0) & (rows.inner_deg == 0.0)
    assert found.before_arcsec[3] == pytest.approx(dwells[here].mean())


def test_what_was_found_lowers_the_mismatch_where_it_was(square):
    found = position_mismatch(square)

    assert np.abs(found.before_arcsec).max() > 50.0
    assert np.abs(found.after_arcsec).max() < 15.0


def test_positions_are_listed_in_the_order_in_which_they_were_taken(square):
    (listed,) = [each for each in picture_sections(square) if each.title == "Mismatch by position"]

    assert [row[1:3] for row in listed.rows[:2]] == [("90°", "-135°"), ("90°", "-90°")]


@pytest.mark.parametrize("title", ["Mismatch over the poses", "Mismatch by position", "Correlation", "Positions"])
def test_each_picture_is_an_svg(square, title):
    (shown,) = [each for each in picture_sections(square) if each.title == title]

    assert shown.figure().__html__().startswith("<svg")


def test_beside_the_values_before_and_after_one_by_one_are_details(square):
    brief = {each.title for each in sections(square) if each.brief}

    assert brief - {each.title for each in sections_beside_values(square) if each.brief} == {"Parameters"}


def test_pictures_of_a_programme_stand_alone():
    assert "24: 180°, 90°" in position_section(POSITIONS["24"]).figure()
