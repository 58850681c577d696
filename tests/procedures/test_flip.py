import math
from functools import partial

import pytest
from fakes import point_at
from hypothesis import given
from hypothesis import strategies as st

from tumble.procedures.methods.dividing_head.flip import Flip, extremum_deg
from tumble.procedures.methods.dividing_head.layout import dwell_at


def run(flip, voltage_v):
    """All dwells of a flip whose output is a function of mount and head angle."""
    dwells = flip.dwells(2)
    taken = [next(dwells)]
    while True:
        try:
            taken.append(dwells.send(point_at(taken[-1], voltage_v(taken[-1]))))
        except StopIteration:
            return taken


def sine(alpha0_deg, kx=1.0, noise_v=lambda: 0.0):
    return lambda dwell: 2.5 - kx * math.sin(math.radians(dwell.targets_deg["head"] + alpha0_deg)) + noise_v()


def test_each_axis_is_taken_down_and_then_up():
    taken = run(Flip(kind="flip", axes=("x", "y", "z")), sine(0.0))
    assert [(dwell.conditions["mount"], dwell.targets_deg["head"]) for dwell in taken] == [
        ("face-up", -90.0),
        ("face-up", 90.0),
        ("face-up", 180.0),
        ("face-up", 0.0),
        ("edge", 180.0),
        ("edge", 0.0),
    ]
    assert {(dwell.procedure, dwell.realisation) for dwell in taken} == {("flip", 2)}


def test_axes_are_taken_in_the_order_of_the_programme():
    taken = run(Flip(kind="flip", axes=("z", "x")), sine(0.0))
    assert [dwell.conditions["mount"] for dwell in taken] == ["edge", "edge", "face-up", "face-up"]


@pytest.mark.parametrize("kx", [1.0, -0.02])
@pytest.mark.parametrize("alpha0_deg", [0.1121, -3.0])
def test_the_extremum_is_found_at_both_x_poles(alpha0_deg, kx):
    taken = run(Flip(kind="flip", axes=("x",), pole="extremum"), sine(alpha0_deg, kx))
    flips = [dwell.targets_deg["head"] for dwell in taken if dwell.procedure == "flip"]
    assert flips == pytest.approx([-90.0 - alpha0_deg, 90.0 - alpha0_deg], abs=1e-6)


def test_the_second_round_looks_about_the_extremum_seen_in_the_first():
    taken = run(Flip(kind="flip", axes=("x",), pole="extremum", span_deg=8.0), sine(2.0))
    assert [dwell.targets_deg["head"] for dwell in taken[:7]] == pytest.approx([-98, -90, -82, -96, -92, -88, -92])
    assert [dwell.procedure for dwell in taken[:7]] == ["seek"] * 6 + ["flip"]


def test_only_the_poles_of_x_are_sought():
    taken = run(Flip(kind="flip", axes=("y", "x"), pole="extremum"), sine(1.0))
    assert [dwell.procedure for dwell in taken] == ["flip"] * 2 + (["seek"] * 6 + ["flip"]) * 2


@given(
    voltages_v=st.lists(st.floats(-10.0, 10.0) | st.just(math.nan), min_size=14, max_size=14),
    span_deg=st.floats(0.1, 45.0),
)
def test_whatever_the_output_does_no_dwell_leaves_the_span(voltages_v, span_deg):
    remaining = iter(voltages_v)
    taken = run(Flip(kind="flip", axes=("x",), pole="extremum", span_deg=span_deg), lambda dwell: next(remaining))
    assert len(taken) == 14
    for dwell, pole_deg in zip(taken, [-90.0] * 7 + [90.0] * 7, strict=True):
        assert abs(dwell.targets_deg["head"] - pole_deg) <= span_deg + 1e-9


def points(*poses):
    here = partial(dwell_at, procedure="seek", realisation=1, mount="face-up")
    return [point_at(here(angle_deg=angle_deg), voltage_v) for angle_deg, voltage_v in poses]


@pytest.mark.parametrize(
    "seen",
    [
        points(),
        points((80, math.nan), (90, math.inf), (100, math.nan)),
        points((80, 1.0), (90, 1.02), (90, 1.02)),
    ],
    ids=["nothing", "nothing usable", "two poses"],
)
def test_too_little_to_go_by_leaves_the_nominal_pole(seen):
    assert extremum_deg(seen, 90.0, 10.0) == 90.0


def test_an_extremum_beyond_the_span_is_held_at_its_edge():
    seen = points(*((angle, math.cos(math.radians(angle - 120))) for angle in (80, 90, 100)))
    assert extremum_deg(seen, 90.0, 10.0) == 100.0
