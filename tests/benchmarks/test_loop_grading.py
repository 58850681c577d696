from types import SimpleNamespace

import numpy as np
import pytest

from benchmarks.bank import Spec, make_stage, make_table
from benchmarks.loop.coverage import part_left
from benchmarks.loop.intervals import clopper_pearson_upper, wilson
from benchmarks.loop.matching import as_well, is_exact
from benchmarks.loop.oracle import ask_oracle
from benchmarks.loop.refit import Table
from benchmarks.loop.rivals import judged_rivals
from tumble.calibrations.tracing.findings import EffectFound, Unexplained


def found(name, *also_possible):
    return EffectFound(name=name, also_possible=also_possible, belongs_to="unit", coefficients={}, p_value=0.0)


def unexplained(depends_on):
    return Unexplained(depends_on=depends_on, description="a course")


@pytest.mark.parametrize(
    ("true", "reported"),
    [
        ((), ()),
        (("k_xx",), (found("k_xx"),)),
        (("k_xx",), (found("k_yy", "k_zz", "k_xx"),)),
        (("k_xx", "backlash"), (found("backlash"), found("k_xx"))),
        (("k_xx", "k_yy"), (found("k_zz", "k_xx", "k_yy"), found("k_yy"))),
    ],
)
def test_effects_that_pair_up_by_name_or_rival_are_exact(true, reported):
    assert is_exact(true, {}, reported, None)


@pytest.mark.parametrize(
    ("true", "reported"),
    [
        ((), (found("k_xx"),)),
        (("k_xx",), ()),
        (("k_xx",), (found("k_yy"),)),
        (("k_xx",), (found("k_xx"), found("k_yy", "k_xx"))),
        (("k_xx", "k_yy"), (found("k_zz", "k_xx", "k_yy"), found("backlash"))),
    ],
)
def test_one_effect_too_many_too_few_or_of_another_name_is_not_exact(true, reported):
    assert not is_exact(true, {}, reported, None)


def test_structure_without_a_name_must_be_there_and_depend_on_the_right_variable():
    assert is_exact((), {"angle_bump": "angle"}, (), unexplained("angle"))
    assert not is_exact((), {"angle_bump": "angle"}, (), unexplained("time"))
    assert not is_exact((), {"angle_bump": "angle"}, (), None)
    assert not is_exact((), {}, (), unexplained("angle"))
    assert not is_exact((), {"angle_bump": "angle"}, (found("graduation"),), unexplained("angle"))


@pytest.mark.parametrize("name", ["k_xx", "graduation", "seating", "settling"])
def test_the_oracle_finds_unit_and_amplitude_of_a_table_without_noise(name):
    spec = Spec(design="bfdr", realisations=3, effects=((name, 40.0),))
    stage, case = make_stage(spec, 5), make_table(spec, 5)
    used = np.arange(len(case.observations))
    oracle = ask_oracle(stage, case.truth.noise_free_v, used, 1e-4)
    assert oracle.amplitudes[0] == pytest.approx(stage.sized[0][1], rel=1e-5)
    assert oracle.unit.kx == pytest.approx(case.truth.unit.kx, rel=1e-9)
    np.testing.assert_allclose(oracle.fitted_v, case.truth.noise_free_v, atol=1e-9)
    assert oracle.unknown == ()


def test_the_oracle_knows_what_a_table_cannot_tell():
    stage = make_stage(Spec(design="f", realisations=2), 5)
    readings = make_table(Spec(design="f", realisations=2), 5).observations.voltage_v
    unknown = ask_oracle(stage, readings, np.arange(len(readings)), 1e-4).unknown
    assert "kxy" in unknown
    assert "u0" not in unknown


def test_the_refit_finds_the_alpha0_of_a_table():
    case = make_table(Spec(design="bfd", realisations=3, noise_v=1e-7), 4)
    rows = len(case.observations)
    fit = Table(observations=case.observations, weights=np.ones(rows)).fit(np.empty((rows, 0)))
    assert fit.alpha0_deg == pytest.approx(case.truth.unit.alpha0_deg, abs=1e-4)
    assert fit.deviance / rows == pytest.approx(np.log(1e-14), abs=0.2)


def test_a_refit_tells_a_found_effect_from_another_but_not_from_its_alias():
    """Ox stands the same on the head in every mount: k_xxx is then an error twice per turn."""
    case = make_table(Spec(design="bf", realisations=2, effects=(("k_xxx", 40.0),)), 3)
    weights = np.ones(len(case.observations))
    result = SimpleNamespace(
        effects=(found("k_xxx", "head_second_harmonic"),),
        unexplained=None,
        augmented=SimpleNamespace(observations=case.observations, weights=weights),
    )
    judged = {entry.rival: entry for entry in judged_rivals(result)}
    assert judged["head_second_harmonic"].behind < 3.84
    assert judged["head_second_harmonic"].listed
    assert judged["bias_drift"].behind > 100.0


def test_the_part_of_the_error_left_lies_between_oracle_and_declared_model():
    record = {"spec": {"effects": [["k_xx", 20.0]]}, "before": 5.0, "after": 2.0, "oracle": 1.0}
    assert part_left(record) == pytest.approx(0.25)
    assert part_left({**record, "spec": {"effects": [["misreading", 20.0]]}}) is None


def test_intervals_of_proportions_agree_with_published_tables():
    # Newcombe, Statistics in Medicine 17 (1998) 857, table I: 81 of 263. Nothing in 100: (1 - p)^100 = 0.025.
    assert wilson(81, 263) == pytest.approx((0.2553, 0.3662), abs=5e-5)
    assert clopper_pearson_upper(0, 100) == pytest.approx(1.0 - 0.025 ** (1.0 / 100.0))


@pytest.mark.parametrize(("realisations", "right"), [(1, "time"), (4, "angle")])
def test_a_variable_that_the_rows_do_not_part_from_the_true_one_is_as_right(realisations, right):
    """Within one sweep an error along all the head has turned is one in time; with four it is not."""
    case = make_table(Spec(design="s", realisations=realisations, effects=(("belt", 20.0),)), 5)
    assert dict(as_well(case, unexplained("time"))) == {"belt": right}
