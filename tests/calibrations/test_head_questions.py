from dataclasses import replace

import numpy as np
import pytest
from head_tables import rests
from public_heads import backwards, five_settings, joint

from tumble.calibrations.methods.head_reference.document import document
from tumble.calibrations.methods.head_reference.loop import close_reference_loop
from tumble.calibrations.methods.head_reference.questions import question
from tumble.calibrations.methods.head_reference.sentences import headline


def test_a_reference_that_counts_backwards_is_asked_about_and_nothing_else_is_stated():
    content = document(close_reference_loop(backwards()))
    assert "change its sign" in content["warnings"][-1]
    for model in (content["declared"], content["augmented"]):
        assert model["parameters"]["offset"]["value"] is None
        assert "does not follow the head" in model["parameters"]["offset"]["reason"]
        assert (model["residual_rms_deg"], model["held_out_rms_deg"], model["lack_of_fit_p"]) == (None, None, None)
    assert (content["effects"], content["unexplained"], content["passes"], content["head_map"]) == (
        [],
        None,
        None,
        None,
    )
    assert (content["by_setting"], content["cannot_be_known"], content["rows"]["set_aside"]) == ([], [], [])
    assert content["noise"]["dwell_deg"] is None


def test_where_nothing_is_stated_it_is_not_said_that_there_is_nothing():
    assert headline(close_reference_loop(backwards())) == "nothing is stated before that is answered."


@pytest.mark.parametrize(
    ("spoilt", "said"),
    [
        (lambda a, r: (a, -r), "change its sign"),
        (lambda a, r: (a, np.deg2rad(r)), "it is in radians"),
        (lambda a, r: (np.deg2rad(a), r), "the head is in radians"),
        (lambda a, r: (a, 3 * r), "it counts 3 turns for one"),
        (lambda a, r: (5 * a, r), "the head counts 5 turns for one"),
        (lambda a, r: (a, 0 * r + 12.5), "the reference is 12.5° in every row"),
    ],
)
def test_a_short_arc_is_asked_about_as_a_turn_is(spoilt, said):
    table = five_settings()
    angle_deg, reference_deg = spoilt(table.angle_deg, table.reference_deg)
    assert said in question(replace(table, angle_deg=angle_deg, reference_deg=reference_deg))[0]


@pytest.mark.parametrize("table", [five_settings(), joint(loaded=True), rests(lambda a, d, t: 8.0 * np.sin(4 * a))])
def test_a_reference_that_follows_with_an_error_is_not_asked_about(table):
    assert question(table) == ()


def test_one_slip_makes_no_question():
    table = five_settings()
    slipped = replace(table, reference_deg=table.reference_deg + 60.0 * (np.arange(len(table)) == 7))
    assert question(slipped) == ()
