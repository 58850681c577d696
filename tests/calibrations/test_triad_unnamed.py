"""Structure without a name in the table of a triad: along what it is looked for, and what is said of it."""

import numpy as np
import pytest
from triad_tables import made, read

from tumble.calibrations.methods.triad.effects.unnamed import unnamed
from tumble.calibrations.methods.triad.loop import close_triad_loop
from tumble.calibrations.methods.triad.table import triad_table

HOURS = 175.0 * np.arange(72) / 3600.0


def traced(tmp_path, added):
    return close_triad_loop(read(tmp_path, made("24", passes=3, added=added)))


def in_channel(place, values):
    return np.eye(3)[place] * values[:, None]


def third_harmonic_v(g, _, inner_deg):
    """30″ of three periods a turn of the inner axis."""
    error = np.deg2rad(30.0 / 3600.0) * np.sin(np.deg2rad(3.0 * inner_deg) + 0.3)
    return error[:, None] * np.column_stack([g[:, 1], -g[:, 0], np.zeros(len(g))])


@pytest.mark.parametrize(
    ("added", "depends_on", "channel"),
    [
        (lambda *_: in_channel(1, 8e-5 * (HOURS > 1.5)), "time", "offset"),
        (lambda *_: in_channel(2, 8e-5 * np.sin(2 * np.pi * HOURS / 0.642)), "time", "offset"),
        (third_harmonic_v, "angle", "angle"),
    ],
    ids=["jump", "wave", "third harmonic"],
)
def test_what_has_no_name_is_said_to_be_unexplained_on_its_variable(tmp_path, added, depends_on, channel):
    loop = traced(tmp_path, added)

    assert loop.effects == ()
    assert (loop.unexplained.depends_on, loop.unexplained.channel) == (depends_on, channel)


def test_its_description_says_of_which_channel_it_is(tmp_path):
    loop = traced(tmp_path, lambda *_: in_channel(1, 8e-5 * (HOURS > 1.5)))

    assert "channel y" in loop.unexplained.description


def test_parameters_are_free_of_a_structure_in_one_channel(tmp_path):
    loop = traced(tmp_path, lambda *_: in_channel(1, 8e-5 * (HOURS > 1.5)))

    found = loop.augmented.parameters["scale_x"]
    assert abs(found.value - 1.02) < 3.0 * found.standard_uncertainty


def test_every_axis_has_a_name_of_its_own(tmp_path):
    names = [axis.name for axis in unnamed(triad_table(read(tmp_path, made("24", passes=2))).scene)]

    assert len(names) == len(set(names))


def test_bins_hold_three_dwells_each_in_the_mean(tmp_path):
    axes = unnamed(triad_table(read(tmp_path, made("24", passes=3))).scene)

    assert {int(axis.coordinate.bins.max()) + 1 for axis in axes if axis.coordinate.word == "time"} == {24}


def test_what_is_known_of_it_is_taken_off_the_mismatch(tmp_path):
    loop = traced(tmp_path, lambda *_: in_channel(1, 8e-5 * (HOURS > 1.5)))
    later = loop.observations.time_s > 1.5 * 3600.0 + 175.0
    shown_v = loop.explained_v[:, 1]

    assert np.mean(shown_v[later]) - np.mean(shown_v[~later]) == pytest.approx(8e-5, rel=0.1)
