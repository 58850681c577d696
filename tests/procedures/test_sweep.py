import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.procedures.methods.dividing_head.sweep import Sweep


def sweep(**settings):
    return Sweep(**{"kind": "sweep", "mount": "edge", "step_deg": 5.0, "points": 80, **settings})


def test_a_sweep_up_visits_forty_degrees_twice():
    angles_deg = sweep().angles_deg(1)
    assert angles_deg[:3] == [0.0, 5.0, 10.0]
    assert angles_deg[-1] == 395.0
    assert len({angle % 360 for angle in angles_deg}) == 72


def test_a_sweep_there_and_back_takes_the_turning_point_once():
    angles_deg = sweep(order="there-and-back").angles_deg(1)
    assert len(angles_deg) == 159
    assert angles_deg[78:81] == [390.0, 395.0, 390.0]
    assert angles_deg[-1] == 0.0


def test_a_single_point_there_and_back_is_one_dwell():
    assert sweep(order="there-and-back", points=1).angles_deg(1) == [0.0]


@given(seed=st.integers(0, 1000), realisation=st.integers(1, 9), points=st.integers(1, 40))
def test_a_shuffled_sweep_takes_the_stated_permutation(seed, realisation, points):
    settings = {"points": points, "start_deg": -7.0, "step_deg": -2.5}
    shuffled = sweep(order="shuffled", seed=seed, **settings).angles_deg(realisation)
    rising = np.array(sweep(**settings).angles_deg(realisation))
    assert shuffled == list(rising[np.random.default_rng(seed + realisation).permutation(points)])


def test_realisations_are_shuffled_differently():
    shuffled = sweep(order="shuffled", seed=4)
    assert shuffled.angles_deg(1) != shuffled.angles_deg(2)


def test_a_dwell_says_where_it_belongs():
    dwell = next(sweep(start_deg=30.0).dwells(3))
    assert (dwell.conditions["mount"], dwell.targets_deg["head"], dwell.procedure, dwell.realisation) == (
        "edge",
        30.0,
        "sweep",
        3,
    )


@pytest.mark.parametrize("wrong", [{"points": 0}, {"step_deg": float("nan")}, {"order": "down"}, {"seed": -1}])
def test_a_sweep_that_makes_no_sense_is_refused(wrong):
    with pytest.raises(ValueError, match=next(iter(wrong))):
        sweep(**wrong)
