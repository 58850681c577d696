"""The blind bank's tables, their truth, and how an answer is judged."""

import json
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks.blind import LISTS, Spec, make_table, tables
from benchmarks.blind.clock import drawn_run
from benchmarks.blind.files import write_table
from benchmarks.blind.named import CATALOGUE
from benchmarks.blind.nuisances import NUISANCES
from benchmarks.blind.report import share
from benchmarks.blind.right import beyond_catalogue_units, right_variables
from benchmarks.blind.score import is_exact, judged_parameter, pairs_up, said
from benchmarks.blind.sizing import CannotShowError, signal_v, sized
from benchmarks.blind.stand_ins import stand_ins
from benchmarks.blind.together import check_together
from benchmarks.blind.unnamed import KINDS
from benchmarks.blind.world import Unit
from tumble.app.cli import cli

UNIT = Unit(u0=2.5, kx=1.0, ky=0.0098, kz=0.002, kxy=0.001, alpha0_deg=0.1121)


def drawn(kind, design, units=20.0, seed=1):
    run = drawn_run(design, 3, 1, np.random.default_rng(3))
    return sized(KINDS[kind].drawn(run, UNIT, np.random.default_rng(seed)), run, UNIT, units), run


def table(name, units=20.0, design="mounts", nuisance="plain"):
    spec = Spec(kind="unnamed", designs=(design,), nuisance=nuisance, effects=((name, units),) if name else ())
    return make_table(spec, np.random.default_rng(1))


def unexplained(depends_on):
    return {"depends_on": depends_on, "description": ""}


def found(name, *rivals):
    return {"name": name, "also_possible": list(rivals)}


def test_what_follows_the_head_is_right_on_the_angle_alone():
    effect, run = drawn("odd_harmonics_of_head", "shuffled", 40.0)
    right = right_variables(signal_v(run, UNIT, [effect]), run, UNIT)
    assert "angle" in right
    assert not right & {"time", "temperature", "direction", "realisation", "order"}


def test_within_one_sweep_the_unwrapped_angle_is_time():
    run = drawn_run("seed", 1, 1, np.random.default_rng(3))
    effect = sized(KINDS["saw_tooth_in_time"].drawn(run, UNIT, np.random.default_rng(4)), run, UNIT, 20.0)
    assert {"time", "unwrapped_angle"} <= right_variables(signal_v(run, UNIT, [effect]), run, UNIT)


def test_nothing_of_a_catalogue_effect_is_beyond_the_catalogue():
    run = drawn_run("mounts", 3, 1, np.random.default_rng(3))
    effect = CATALOGUE["k_xxx"](run, UNIT, np.random.default_rng(1))(1e-4)
    assert beyond_catalogue_units(signal_v(run, UNIT, [effect]), run, UNIT) < 0.05


def test_a_graduation_error_has_itself_as_stand_in():
    run = drawn_run("mounts", 3, 1, np.random.default_rng(3))
    effect = sized(CATALOGUE["graduation"](run, UNIT, np.random.default_rng(1)), run, UNIT, 40.0)
    assert stand_ins(signal_v(run, UNIT, [effect]), run, UNIT) == {"graduation"}


def test_four_harmonics_have_no_stand_in():
    effect, run = drawn("odd_harmonics_of_head", "mounts", 40.0)
    assert not stand_ins(signal_v(run, UNIT, [effect]), run, UNIT)


def test_aliases_are_not_asked_for_together():
    """observations.md: in one mount k_xx and a once-per-turn error are the same."""
    run = drawn_run("seed", 3, 1, np.random.default_rng(3))
    names = ("k_xx", "scale_asymmetry", "k_yy", "k_zz")
    effects = [sized(CATALOGUE[name](run, UNIT, np.random.default_rng(1)), run, UNIT, 12.0) for name in names]
    with pytest.raises(CannotShowError, match="not visible beside the others"):
        check_together(effects, run, UNIT)


def test_a_table_is_fixed_by_seed_kind_and_number():
    (name, _, first, _), *_ = tables("single", 6, 9, first=5)
    *_, (again_name, _, again, _) = tables("single", 6, 9)
    assert name == again_name == "single-005"
    assert first is not None and again is not None
    assert np.array_equal(first.voltage_v, again.voltage_v)


@pytest.mark.parametrize("kind", LISTS)
def test_every_list_has_as_many_tables_as_asked(kind):
    assert len(LISTS[kind](7, np.random.default_rng(1))) == 7


@pytest.mark.parametrize("nuisance", NUISANCES)
def test_table_is_read_by_fit(nuisance, tmp_path):
    path, answer = tmp_path / "table.csv", tmp_path / "fit.json"
    made = table("", nuisance=nuisance)
    write_table(path, made, np.random.default_rng(2))
    outcome = CliRunner().invoke(cli, ["fit", str(path), "--json", str(answer)])
    assert outcome.exit_code in (0, 1), outcome.output
    assert json.loads(answer.read_text(encoding="utf-8"))["rows"]["read"] == int((~made.run.fresh).sum())


def test_effects_pair_up_by_name_or_rival():
    assert pairs_up(["k_xx", "backlash"], [found("backlash"), found("k_yy", "k_xx")])
    assert not pairs_up(["k_xx", "backlash"], [found("k_yy", "k_xx")])
    assert not pairs_up([], [found("k_yy")])


def test_unexplained_is_right_on_a_right_variable_alone():
    made = replace(table("", design="seed"), right=frozenset({"unwrapped_angle"}))
    made = replace(made, effects=(drawn("ripple_over_turns", "turns")[0],))
    assert is_exact(made, {"effects": [], "unexplained": unexplained("angle")})
    assert not is_exact(made, {"effects": [], "unexplained": unexplained("time")})
    assert not is_exact(made, {"effects": [found("graduation")], "unexplained": unexplained("angle")})
    assert not is_exact(made, {"effects": [], "unexplained": None})


def test_clean_table_must_have_nothing_found():
    made = table("", design="seed")
    assert is_exact(made, {"effects": [], "unexplained": None})
    assert not is_exact(made, {"effects": [found("k_xx")], "unexplained": None})
    assert said({"effects": [found("k_xx", "k_yy")], "unexplained": None}) == "k_xx|k_yy"


@pytest.mark.parametrize(
    ("told", "judged"),
    [
        ({"value": 2.4, "interval_95": [2.3, 2.6]}, ("unconditional", True, 0.5)),
        ({"value": 2.4, "interval_95": [2.38, 2.45]}, ("unconditional", False, 2.0)),
        ({"value": 2.4, "interval_95": [2.3, 2.6], "rests_on": "kxy"}, ("conditional", True, 0.5)),
        ({"value": 2.4, "interval_95": [2.3, 2.6], "given": {"alpha0": 0}}, ("conditional", True, 0.5)),
        ({"value": None, "reason": ""}, ("withheld", None, None)),
    ],
)
def test_parameter_is_judged_by_its_interval(told, judged):
    made = replace(table("", design="seed"), unit=UNIT)
    outcome = judged_parameter(made, {"parameters": {"u0": told}}, "u0")
    state, inside, half_widths = judged
    assert (outcome["state"], outcome.get("inside")) == (state, inside)
    assert half_widths is None or outcome["half_widths"] == pytest.approx(half_widths)


def test_shares_have_wilson_intervals():
    """9 of 10: 0.596 to 0.982 (Newcombe, Statistics in Medicine 17, 1998, method 3)."""
    assert share(9, 10) == "9/10 90.0% (59.6 to 98.2)"
