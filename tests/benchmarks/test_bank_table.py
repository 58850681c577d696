import csv
import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks.bank import (
    DEVELOPMENT,
    NAMED,
    NOVEL,
    REPORTED,
    Spec,
    clean,
    heavy,
    make_table,
    missing_columns,
    novel,
    pairs,
    singles,
    triples,
    write_csv,
    write_truth,
)
from benchmarks.bank.beyond import BEYOND
from benchmarks.bank.dwells import dwells
from benchmarks.bank.geometry import projections
from benchmarks.bank.noise import FLICKER_FLOOR_V, drawn_noise
from benchmarks.bank.scene import respond
from benchmarks.bank.table import _surrounded
from benchmarks.bank.visibility import sight


def made(seed=7, **spec):
    """A table that the design can show."""
    case = make_table(Spec(**spec), seed)
    assert case is not None
    return case


def noise_of(case):
    return case.observations.voltage_v - case.truth.noise_free_v


@pytest.mark.parametrize("name", [name for name in (*NAMED, *NOVEL) if name != "misreading"])
def test_every_effect_shows_as_much_as_was_asked_for(name):
    case = made(design="bfdreEnt", effects=((name, 20.0),))
    assert case.truth.visible[name] == pytest.approx(20.0, rel=0.02)
    assert set(case.truth.coefficients) == {name}
    assert np.std(noise_of(case)) == pytest.approx(1e-4, rel=0.1)


@pytest.mark.parametrize("name", BEYOND)
def test_every_effect_of_the_second_set_shows_as_much_as_was_asked_for_and_is_known_alone(name):
    case = made(design="bfdrt", realisations=3, effects=((name, 20.0),))
    assert case.truth.visible[name] == pytest.approx(20.0, rel=0.02)
    assert case.truth.novel == {name: BEYOND[name][0]}
    assert case.truth.novel_v == pytest.approx(case.truth.noise_free_v - made_without(case).truth.noise_free_v)


def made_without(case):
    return made(design="bfdrt", realisations=3)


def test_what_is_visible_is_what_a_fit_of_the_declared_model_leaves():
    spec, seed = Spec(design="bfd", effects=(("k_yy", 25.0),)), 11
    case = make_table(spec, seed)
    seen = sight(_surrounded(spec, seed), case.truth.unit)
    change_v = case.truth.noise_free_v - seen.plain_v
    left = change_v - seen.tangent @ np.linalg.lstsq(seen.tangent, change_v, rcond=None)[0]
    assert np.linalg.norm(left) / 1e-4 == pytest.approx(25.0, rel=0.02)


def test_an_effect_that_the_design_cannot_show_makes_no_table():
    assert make_table(Spec(design="s", effects=(("k_xx", 10.0),)), 1) is None


def test_the_same_seed_makes_the_same_table_and_another_seed_another():
    first, again, other = (made(seed=seed, design="qfd", effects=(("hysteresis", 20.0),)) for seed in (3, 3, 4))
    np.testing.assert_array_equal(first.observations.voltage_v, again.observations.voltage_v)
    assert first.truth.as_json() == again.truth.as_json()
    assert not np.array_equal(first.observations.angle_deg, other.observations.angle_deg)


def test_a_second_effect_changes_neither_the_unit_nor_the_noise_nor_the_first():
    one = made(effects=(("k_xx", 20.0),))
    two = made(effects=(("bias_drift", 20.0), ("k_xx", 20.0)))
    assert one.truth.unit == two.truth.unit
    assert one.truth.coefficients["k_xx"] == two.truth.coefficients["k_xx"]
    np.testing.assert_allclose(noise_of(one), noise_of(two), atol=1e-12)


def test_misread_rows_stand_at_the_reported_angle_plus_the_error():
    case = made(design="bfd", effects=(("misreading", 0.0),))
    misread = case.truth.coefficients["misreading"]
    laid_out = dwells("bfd", 5, np.random.default_rng(0))
    reported_deg = case.observations.angle_deg + case.truth.unit.alpha0_deg
    true_deg = reported_deg.copy()
    true_deg[np.array(misread["rows"]) - 1] += misread["error_deg"]
    stated_v, reported_v = (
        case.truth.unit.output_v(projections(laid_out.axes, angle_deg)) for angle_deg in (true_deg, reported_deg)
    )
    np.testing.assert_allclose(case.truth.noise_free_v, stated_v, atol=1e-12)
    assert np.count_nonzero(np.abs(stated_v - reported_v) > 8e-4) == len(misread["rows"])
    assert 1 <= len(misread["rows"]) <= 16


def test_jumps_between_realisations_have_the_stated_spread_and_no_mean():
    case = made(design="bfd", effects=(("realisation_bias", 20.0),))
    plain_v = respond(_surrounded(case.truth.spec, 7), case.truth.unit, ())
    jumps = (case.truth.noise_free_v - plain_v)[:: len(plain_v) // 5]
    assert jumps.mean() == pytest.approx(0.0, abs=1e-12)
    assert jumps.std(ddof=1) == pytest.approx(case.truth.coefficients["realisation_bias"])


def test_columns_that_are_left_out_are_absent():
    case = made(left_out=("time_s", "samples"))
    assert case.observations.time_s is None
    assert case.observations.samples is None
    assert case.observations.mount is not None


def test_a_coarse_instrument_reads_in_steps():
    steps = made(quantum_v=3e-4).observations.voltage_v / 3e-4
    np.testing.assert_allclose(steps, np.round(steps), atol=1e-6)


@pytest.mark.parametrize("kind", ["white", "student"])
def test_noise_has_the_standard_deviation_that_is_asked_for(kind):
    drawn = drawn_noise(kind, np.arange(40_000.0), 2e-4, np.random.default_rng(2))
    assert np.std(drawn) == pytest.approx(2e-4, rel=0.05)


def test_contaminated_noise_is_wider_than_its_core_in_the_tails():
    drawn = drawn_noise("contaminated", np.arange(40_000.0), 1e-4, np.random.default_rng(2))
    assert np.mean(np.abs(drawn) > 5e-4) == pytest.approx(0.02 * 0.317, rel=0.3)


def test_flicker_noise_has_its_allan_floor_at_every_averaging_time():
    time_s = np.arange(0.0, 400_000.0, 2.0)
    drawn = drawn_noise("flicker", time_s, 0.0, np.random.default_rng(4))
    for block in (50, 500):
        means = drawn[: len(drawn) // block * block].reshape(-1, block).mean(axis=1)
        allan = np.sqrt(0.5 * np.mean(np.diff(means) ** 2))
        assert allan == pytest.approx(FLICKER_FLOOR_V, rel=0.2)


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ({"effects": (("k_q", 1.0),)}, "no effect k_q"),
        ({"noise": "pink"}, "no noise pink"),
        ({"left_out": ("voltage_V",)}, "voltage_V cannot be left out"),
    ],
)
def test_what_the_bank_does_not_know_is_refused(spec, message):
    with pytest.raises(ValueError, match=message):
        make_table(Spec(**spec), 1)


def test_no_seed_is_used_twice():
    lists = (singles, pairs, triples, novel, clean, missing_columns, heavy)
    used = [seed for seeds in (DEVELOPMENT, REPORTED) for make in lists for _, seed in make(seeds)]
    assert len(used) == len(set(used))


def test_the_bank_is_large_enough():
    assert len(singles()) + len(pairs()) >= 400
    assert len(clean()) >= 10_000


def test_a_table_is_written_as_the_contract_says(tmp_path):
    case = made(design="sf", effects=(("graduation", 20.0),), left_out=("temperature_degC",))
    write_csv(case, tmp_path / "t.csv")
    write_truth(case, tmp_path / "t.truth.json")
    rows = list(csv.DictReader((tmp_path / "t.csv").read_text(encoding="utf-8").splitlines()))
    assert list(rows[0])[:6] == ["time_s", "realisation", "procedure", "mount", "angle_deg", "direction"]
    assert "temperature_degC" not in rows[0]
    voltage_v = [float(row["voltage_V"]) for row in rows]
    np.testing.assert_allclose(voltage_v, case.observations.voltage_v, atol=1e-8)
    truth = json.loads((tmp_path / "t.truth.json").read_text(encoding="utf-8"))
    assert set(truth["coefficients"]["graduation"]) == {"order", "amplitude_deg", "phase_deg"}


def test_the_command_writes_a_table_and_its_truth(tmp_path):
    root = Path(__file__).resolve().parents[2]
    out = tmp_path / "t.csv"
    command = [
        "-m",
        "benchmarks.bank",
        "--design",
        "bfd",
        "--effect",
        "k_xx",
        "--visible",
        "20",
        "--seed",
        "3",
        "--out",
    ]
    subprocess.run([sys.executable, *command, str(out)], check=True, cwd=root)
    assert len(out.read_text(encoding="utf-8").splitlines()) == 1231
    assert json.loads(out.with_suffix(".truth.json").read_text(encoding="utf-8"))["effects"] == ["k_xx"]
