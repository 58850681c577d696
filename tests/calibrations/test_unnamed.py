"""Structure without a name in the table of an accelerometer: along what it is looked for, and what is said of it."""

import re

import numpy as np
import pytest
from tables import FLIPS, sweep, table
from test_effects import scene
from tracing_runs import FLIPS as FLIPS_OF_RUNS
from tracing_runs import SWEEP, programme, runs

from tumble.calibrations.methods.dividing_head.effects.unnamed import unnamed
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop

CONTRACT = {
    "angle": "angle",
    "unwrapped_angle": "angle",
    "acceleration": "acceleration",
    "pose": "acceleration",
    "time": "time",
    "time_since_seating": "time",
    "temperature": "temperature",
    "direction": "direction",
    "realisation": "realisation",
    "order": "order",
}
"""Every variable of the contract, and what it depends on by the coarser word."""


@pytest.fixture(scope="module")
def rich():
    """Three turns there and back with everything that a table may say."""
    angle_deg = np.resize(np.concatenate([np.arange(0.0, 400.0, 15.0), np.arange(390.0, -1.0, -15.0)]), 480)
    count = np.arange(480)
    return unnamed(
        scene(
            angle_deg,
            time_s=20.0 * count,
            temperature_degc=23.0 + 0.01 * count,
            realisation=1 + count // 160,
            direction=np.where(count % 48 < 24, 1, -1),
        )
    )


def test_every_variable_of_the_contract_is_looked_along(rich):
    assert {axis.coordinate.word: axis.coordinate.depends_on for axis in rich} == CONTRACT


def test_offset_scale_cross_term_and_angle_are_looked_at(rich):
    assert {axis.channel.word for axis in rich} == {"offset", "scale", "cross", "angle"}


def test_a_cross_term_changes_with_time_and_temperature_alone(rich):
    followed = {axis.coordinate.word for axis in rich if axis.channel.word == "cross"}
    assert followed == {"time", "time_since_seating", "temperature"}


def test_no_scale_follows_the_input_that_it_scales(rich):
    assert not {("scale", "acceleration"), ("scale", "pose"), ("scale", "angle")} & {axis.place for axis in rich}


def test_every_channel_and_variable_is_described_in_plain_words(rich):
    for axis in rich:
        for text in (axis.channel.phrase, axis.coordinate.phrase):
            assert re.fullmatch(r"[A-Za-z0-9 ·]+", text)
            assert text[0].islower()


def test_without_time_and_temperature_neither_is_looked_along():
    bare = unnamed(scene(np.arange(0.0, 400.0, 5.0)))

    assert not {"time", "time_since_seating", "temperature"} & {axis.coordinate.word for axis in bare}


def test_where_the_head_turns_one_way_only_nothing_is_looked_for_at_its_reversals():
    assert not [axis for axis in unnamed(scene(np.arange(0.0, 400.0, 5.0))) if axis.channel.detail == "reversal"]


def test_play_in_a_sector_is_an_error_of_the_angle_after_moves_in_one_direction():
    def worn(columns):
        off_deg = np.mod(columns["angle_deg"] - 120.0 + 180.0, 360.0) - 180.0
        return np.where(columns["direction"] < 0, 0.05 * np.exp(-0.5 * (off_deg / 25.0) ** 2), 0.0)

    swept = programme(FLIPS_OF_RUNS, SWEEP.format("face-up", "there-and-back"), realisations=2)
    loop = close_loop(runs(swept, error_deg=worn))

    assert [effect.name for effect in loop.effects] == []
    assert loop.unexplained.variable == "angle"
    assert "after moves in the negative direction" in loop.unexplained.description


def test_a_bump_of_the_circle_is_said_with_its_place_and_what_else_it_could_be():
    def bump(mount, angle_deg):
        return 2e-4 * np.exp(-0.5 * (((angle_deg - 140.0 + 180.0) % 360.0 - 180.0) / 10.0) ** 2)

    found = close_loop(table(*FLIPS, sweep("face-up"), extra_v=bump)).unexplained

    assert (found.depends_on, found.variable) == ("angle", "angle")
    assert re.search(r"near 1(3[5-9]|4[0-5])°", found.description)
    assert ("offset", "acceleration") not in found.also_possible
