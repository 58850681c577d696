"""What vibrated dwells tell of the five coefficients; ranks as in the table of experiments, figures re-derived."""

import numpy as np
import pytest
from vibration_tables import CENTRIFUGE, FIXTURES, I, K, O, P, dwells, measured, with_columns

from tumble.calibrations.methods.vibration.effects.curved import clipped_mean_ug
from tumble.calibrations.methods.vibration.effects.stand import arm_ug, partial_period_ug
from tumble.calibrations.methods.vibration.loop import declared_fit
from tumble.calibrations.methods.vibration.model import NAMES
from tumble.calibrations.methods.vibration.observations import read_vibration_table
from tumble.calibrations.methods.vibration.probes import circle, phased, shaken
from tumble.calibrations.methods.vibration.products import mean_products
from tumble.calibrations.methods.vibration.weights import row_weights

EXPERIMENTS = {
    "shaker along i": ((shaken(I, O),), {"k_ii"}),
    "shaker along i, o, p": ((shaken(I, O), shaken(O, I, P), shaken(P, I)), {"k_ii", "k_oo", "k_pp"}),
    "with 45° fixtures": (FIXTURES, set(NAMES)),
    "centrifuge, output axis up": (CENTRIFUGE, {"k_ii+k_pp"}),
    "centrifuge, pendulous axis up": ((circle(2),), {"k_ii+k_oo"}),
    "centrifuge, each axis up": ((circle(0), circle(1), circle(2)), {"k_ii", "k_oo", "k_pp"}),
    "three shakers, phases varied": ((phased(),), set(NAMES)),
    "three shakers, unequal frequencies": ((phased((40.0, 70.0, 110.0)),), {"k_ii", "k_oo", "k_pp"}),
}


@pytest.mark.parametrize("name", EXPERIMENTS)
def test_an_experiment_tells_what_its_products_span(name):
    mountings, told = EXPERIMENTS[name]
    parameters = declared_fit(measured(dwells(*mountings))).model.parameters
    assert {key for key, each in parameters.items() if each.value is not None} == told


def test_coefficients_come_back_with_their_uncertainty():
    parameters = declared_fit(measured(dwells(*FIXTURES))).model.parameters
    off = [
        (parameters[name].value - k) / parameters[name].standard_uncertainty for name, k in zip(NAMES, K, strict=True)
    ]
    assert np.abs(off).max() < 3.0
    assert parameters["k_ii"].standard_uncertainty == pytest.approx(0.02, rel=0.3)


def test_a_sum_says_why_its_parts_are_not_told():
    parameters = declared_fit(measured(dwells(*CENTRIFUGE))).model.parameters
    assert parameters["k_ii+k_pp"].value == pytest.approx(K[0] + K[2], abs=0.5)
    assert parameters["k_ii"].reason == "these dwells tell only the sum k_ii+k_pp"


def test_a_rounded_phase_is_no_sight_of_a_cross_term():
    rows = dwells(*CENTRIFUGE)
    rounded = with_columns(rows, phase_p_deg=np.asarray(rows.phase_p_deg) + 0.001)
    assert declared_fit(measured(rounded)).model.parameters["k_ip"].value is None


def test_sines_in_quadrature_have_no_cross_product_not_even_that_of_rounding():
    assert not mean_products(dwells(circle(1)))[:, 3:].any()


def test_cross_products_of_sines_follow_their_phases():
    products = mean_products(dwells(phased()))
    assert products[:, 3].max() == pytest.approx(12.5)
    assert products[:, 3].min() == pytest.approx(-12.5)


def test_products_of_the_samples_go_before_those_of_the_fundamental():
    rows = dwells(shaken(I, O))
    stated = with_columns(rows, mii_g2=np.where(rows.vibrated, 7.0, 0.0), moo_g2=np.zeros(len(rows)))
    assert mean_products(stated)[stated.vibrated, 0] == pytest.approx(7.0)
    assert not stated.random.any()


def test_a_turntable_that_is_tilted_rests_with_another_static_product():
    """Rest with the axis vertical differs by K_oo (cos²θ - 1) from turning tilted by θ."""
    rows = dwells(circle(1))
    tilt = np.where(rows.vibrated, np.deg2rad(40.0), 0.0)
    level = np.sin(tilt)
    tilted = with_columns(
        rows,
        apparatus=np.full(len(rows), "tilted-turntable"),
        ai_g=level,
        ap_g=level,
        level_g=level,
        go_g=np.cos(tilt),
        main_rad_s=np.zeros(len(rows)),
    )
    expected = (K[0] + K[2]) / 2.0 * np.sin(np.deg2rad(40.0)) ** 2 + K[1] * (np.cos(np.deg2rad(40.0)) ** 2 - 1.0)
    outputs = np.asarray(measured(tilted, noise_ug=0.0).output_ug)
    assert np.ptp(outputs) == pytest.approx(abs(expected))


def test_scattered_uncertainties_of_one_noise_weigh_alike():
    rows = dwells(*FIXTURES)
    scatter = np.exp(np.random.default_rng(3).normal(0.0, 0.12, len(rows)))
    assert np.ptp(row_weights(with_columns(rows, output_u_ug=3.0 * scatter))) == pytest.approx(0.0, abs=1e-12)


def test_uncertainties_that_differ_by_condition_or_row_count():
    rows = dwells(*FIXTURES)
    louder = np.where(rows.level > 7.0, 9.0, 3.0)
    louder[5] = 30.0
    weights = row_weights(with_columns(rows, output_u_ug=louder))
    assert weights[rows.level > 7.0].max() == pytest.approx(weights[0] / 9.0, rel=0.2)
    assert weights[5] == pytest.approx(weights[0] / 100.0, rel=0.2)


def test_a_cut_period_leaves_up_to_663_micro_g():
    """10 g at 80 Hz over 60 s: a/(π f T)."""
    phase = np.linspace(0.0, 2.0 * np.pi, 361)
    one = np.ones(len(phase))
    assert partial_period_ug(10.0 * one, phase, 80.0 * one, (60.0 + 0.5 / 80.0) * one).max() == pytest.approx(
        663.0, abs=0.5
    )


def test_an_arm_of_a_tenth_of_a_millimetre_adds_37_mg():
    assert 0.1 * arm_ug(np.array([10.0]), np.array([2.0 * np.pi * 8.0]))[0] == pytest.approx(37_040.0, rel=1e-3)


def test_at_minus_the_main_rate_there_is_no_arm():
    assert arm_ug(np.array([10.0]), np.array([-10.0]))[0] == 0.0


def test_the_mean_of_a_clipped_sine_is_that_of_its_samples():
    phase = (np.arange(200_000) + 0.5) / 200_000 * 2.0 * np.pi
    wave = 0.3 + 5.0 * np.sin(phase)
    cut = 1e6 * float(np.mean(np.minimum(wave, 4.9) - wave))
    assert clipped_mean_ug(np.array([5.0]), np.array([0.3]), 4.9)[0] == pytest.approx(cut, rel=1e-6)


def test_a_table_is_read_with_what_it_lacks(tmp_path):
    path = tmp_path / "t.csv"
    path.write_text("time_s,ai_g,output_ug\n0,0,1\n60,5,300\n120,,4\n180,0,nan\n", encoding="utf-8")
    rows = read_vibration_table(path)
    assert [(each.row, str(each.reason)) for each in rows.set_aside] == [
        (3, "neither ai_g nor mii_g2 is stated"),
        (4, "output_ug is nan"),
    ]
    assert rows.level.tolist() == [0.0, 5.0]


def test_dwells_without_a_rest_are_refused():
    rows = dwells(shaken(I, O))
    with pytest.raises(ValueError, match="10 of 10 dwells are vibrated; rectification takes dwells at rest"):
        declared_fit(measured(rows.select(rows.vibrated)))
