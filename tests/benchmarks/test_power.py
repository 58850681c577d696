import numpy as np
import pytest
from scipy.stats import nct
from scipy.stats import t as student

from benchmarks.bank import DEVELOPMENT, REPORTED, Spec, heavy, make_stage, make_table, power
from benchmarks.power import cells, chance_of, draw, f_test_power, oracle_column, oracle_sees, report

SPEC = Spec(design="bfd", effects=(("k_xx", 8.0),))


def record(units, ours, f_power, effect="k_xx"):
    return {
        "effect": effect,
        "units": units,
        "ours": ours,
        "told": True,
        "f_power": f_power,
        "f_power_told": f_power + 0.2,
        "f_test": True,
    }


def test_two_groups_of_64_that_differ_by_half_a_standard_deviation_are_told_four_times_in_five():
    # Cohen, Statistical Power Analysis for the Behavioral Sciences (1988), table 2.3.5: d = 0.50, n = 64
    assert f_test_power(0.5 * np.sqrt(64 / 2), 0.05, 126) == pytest.approx(0.80, abs=0.005)


@pytest.mark.parametrize(("visible", "chance", "spare"), [(1.0, 0.05, 10), (5.0, 1e-5, 1223), (8.0, 1e-6, 1223)])
def test_with_one_column_it_is_the_two_sided_t_test(visible, chance, spare):
    at = student.isf(chance / 2.0, spare)
    expected = nct.sf(at, spare, visible) + nct.sf(at, spare, -visible)
    assert f_test_power(visible, chance, spare) == pytest.approx(expected, abs=1e-9)


def test_without_a_signal_the_power_is_the_chance_of_a_false_alarm():
    assert f_test_power(0.0, 1e-3, 1223) == pytest.approx(1e-3, rel=1e-6)


def test_what_is_told_to_the_f_test_is_as_large_as_the_bank_says():
    stage = make_stage(SPEC, 5)
    assert np.linalg.norm(oracle_column(stage)) / SPEC.noise_v == pytest.approx(stage.visible["k_xx"], rel=0.01)


def test_the_f_test_sees_a_plain_effect_and_not_its_absence():
    stage = make_stage(SPEC, 5)
    effect = make_table(SPEC, 5)
    clean = make_table(Spec(design="bfd"), 5)
    assert oracle_sees(stage, effect.observations.output_v, 1e-4)
    assert not oracle_sees(stage, clean.observations.output_v, 1e-4)


def test_an_effect_of_many_forms_is_allowed_less_chance_for_each():
    observations = make_table(Spec(design="bfd", realisations=3), 5).observations
    assert 0.0 < chance_of("graduation", observations) < chance_of("k_xx", observations) < 1e-4


def test_a_longer_list_begins_as_a_shorter_one_and_shares_no_seed_with_another():
    assert power(DEVELOPMENT, 3)[: len(power(DEVELOPMENT, 2))] == power(DEVELOPMENT, 2)
    seeds = {seed for _, seed in power(DEVELOPMENT, 100)}
    assert len(seeds) == 4500
    assert not seeds & {seed for _, seed in (*heavy(DEVELOPMENT), *power(REPORTED, 100))}


def test_a_shortfall_counts_only_where_the_f_test_sees_half():
    by_cell = cells([record(2.0, False, 0.1), record(4.0, True, 0.5), record(4.0, False, 0.5), record(5.0, False, 0.3)])
    *_, ours, _, last = report(by_cell).splitlines()
    assert ours == "| k_xx | 5 | 1 | 0.0 | 30.0 | -30.0 | 100.0 | 100.0 | 50.0 |"
    assert last == "Largest shortfall from 50 % on: 0.0 points, k_xx at 4 noise units."


def test_the_plot_has_a_panel_for_each_effect(tmp_path):
    path = tmp_path / "p.svg"
    draw(cells([record(2.0, False, 0.1), record(4.0, True, 0.9), record(4.0, True, 0.9, "backlash")]), path)
    assert path.read_text(encoding="utf-8").count('id="axes_') == 2
