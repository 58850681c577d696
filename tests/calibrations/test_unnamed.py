"""Structure without a name, in words that a reader understands."""

import re

import numpy as np
import pytest
from test_effects import scene

from tumble.calibrations.methods.dividing_head.effects.unnamed import STRUCTURES, withheld_by
from tumble.calibrations.tracing.effect import Form

BY_NAME = {structure.name: structure for structure in STRUCTURES}


@pytest.fixture(scope="module")
def rich():
    """Three turns there and back with everything that a table may say."""
    angle_deg = np.resize(np.concatenate([np.arange(0.0, 360.0, 15.0), np.arange(345.0, -1.0, -15.0)]), 480)
    count = np.arange(480)
    return scene(
        angle_deg,
        time_s=20.0 * count,
        temperature_degc=23.0 + 0.01 * count,
        realisation=1 + count // 160,
        direction=np.where(count % 48 < 24, 1, -1),
    )


@pytest.mark.parametrize("structure", STRUCTURES, ids=lambda structure: structure.name)
def test_every_shape_is_described_in_plain_words(rich, structure):
    forms = structure.forms(rich)
    assert forms
    for form in forms:
        text = structure.describe(form)
        assert re.fullmatch(r"[A-Za-z0-9 ,.°'=+-]+", text)
        assert text[0].islower()
        assert not text.endswith(".")


@pytest.mark.parametrize(
    ("name", "scanned", "text"),
    [
        ("?angle bell", {"centre_deg": 140.0, "width_deg": 8.0}, "a bump of the head's error near 140°, some 16° wide"),
        ("?acceleration bend", {"axis": 1, "order": 5}, "a bend of the response to ay, like its power 5"),
        ("?time step", {"step_s": 1234.4}, "a step some 1234 s after the first row"),
        ("?temperature course", {"rate": 1.0}, "a dependence on how fast the temperature changes"),
        ("?direction of approach", {"scale": 1.0}, "another response after moves in - direction"),
        ("?realisation alone", {"realisation": 2}, "realisation 2 responds differently"),
        (
            "?order of dwells",
            {"table": 1.0},
            "a steady course with the number of dwells over the table, which has no time",
        ),
        ("?order of dwells", {"mounting": 1.0}, "a steady course since the start of each mounting"),
        (
            "?order of dwells",
            {"realisation": 6.0},
            "something that dies out within some 6 dwells of the start of each realisation",
        ),
    ],
)
def test_a_shape_is_described_with_where_it_is(name, scanned, text):
    assert BY_NAME[name].describe(Form(columns=np.empty((0, 1)), scanned=scanned)) == text


@pytest.mark.parametrize(
    ("name", "at", "taken"),
    [
        ("?acceleration bend", {"axis": 2, "order": 3}, ("kz",)),
        ("?acceleration bend", {"axis": 0, "order": 4}, ("u0",)),
        ("?acceleration bend", {"axis": 0, "power": 1.5}, ("u0", "kx")),
        ("?angle course", {"knots": 24.0}, ("alpha0",)),
        ("?realisation alone", {"realisation": 2}, ("kx",)),
        ("?time step", {"step_s": 100.0}, ()),
    ],
)
def test_a_shape_takes_the_parameters_of_which_it_has_a_part_of_its_own(name, at, taken):
    assert withheld_by(name, at) == taken
