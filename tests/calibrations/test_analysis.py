import numpy as np
import pytest
from scipy import stats
from tables import FLIPS, UNIT, output, sweep, table

from tumble.calibrations.core.gravity import Gravity
from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.calibrations.methods.dividing_head.observations import Observations

REVERSAL = (*FLIPS, sweep("face-up", 10.0), sweep("face-down", 10.0), sweep("edge", 10.0))


def test_parameters_come_back_within_three_standard_uncertainties():
    found = analyse(table(*REVERSAL, seed=11), trials=0).parameters

    for name, parameter in found.items():
        assert abs(parameter.value - UNIT[name]) < 3 * parameter.standard_uncertainty


def test_coverage_is_near_95_percent():
    inside = [
        parameter.interval_95[0] <= UNIT[name] <= parameter.interval_95[1]
        for seed in range(1000, 1060)
        for name, parameter in analyse(table(*REVERSAL, seed=seed, realisations=2), trials=0).parameters.items()
    ]

    assert stats.binomtest(sum(inside), len(inside), 0.95).pvalue > 0.001


def test_an_undeclared_second_order_term_shows_as_lack_of_fit_with_its_own_ruler():
    def kxx(mount, angle_deg):
        return 5e-4 * np.sin(np.deg2rad(angle_deg)) ** 2 if mount != "end" else 0.0

    result = analyse(table(*REVERSAL, extra_v=kxx), trials=0)

    assert result.lack_of_fit_p < 1e-6
    assert result.noise.basis == "scatter of the poses about the model"
    assert result.noise.used_v > 2 * result.noise.pure_error_v


def test_held_out_error_is_that_of_the_noise_for_a_complete_model():
    assert analyse(table(*REVERSAL), trials=0).held_out_rms_v == pytest.approx(1e-4, rel=0.1)


def test_a_single_realisation_is_held_out_in_interleaved_parts():
    assert analyse(table(*REVERSAL, realisations=1), trials=0).held_out_rms_v == pytest.approx(1e-4, rel=0.2)


def test_a_dead_straight_table_has_no_uncertainty_to_speak_of():
    found = analyse(table(*REVERSAL, noise_v=0.0), trials=0).parameters

    assert found["kx"].value == pytest.approx(1.0, abs=1e-12)
    assert found["kx"].standard_uncertainty < 1e-12


def test_gross_errors_are_set_aside_and_do_not_move_the_result():
    clean = table(*REVERSAL, seed=4)
    dirty = Observations(**{**vars(clean), "voltage_v": clean.voltage_v.copy()})
    dirty.voltage_v[[50, 200]] += 0.02

    result = analyse(dirty, trials=0)

    assert [entry.row for entry in result.observations.set_aside] == [51, 201]
    kx = analyse(clean, trials=0).parameters["kx"]
    assert result.parameters["kx"].value == pytest.approx(kx.value, abs=kx.standard_uncertainty / 2)


def test_no_usable_row_is_refused_in_one_sentence():
    nothing = table(*REVERSAL).select(np.zeros(630, dtype=bool))

    with pytest.raises(ValueError, match="no usable row"):
        analyse(nothing)


def test_a_table_against_a_reference_has_no_output_to_calibrate():
    rows = Observations(row=np.arange(3), angle_deg=np.arange(3.0), reference_deg=np.arange(3.0), source="head.csv")

    with pytest.raises(ValueError, match=r"head\.csv: there is no column voltage_V"):
        analyse(rows)


class TestBudget:
    def test_daq_gain_scales_every_coefficient(self):
        stand = StandUncertainty(daq_gain=1e-3)
        found = analyse(table(*REVERSAL), stand, trials=0)

        contributions = found.budget[1].contributions
        assert contributions["kx"] == pytest.approx(1e-3, rel=1e-3)
        assert contributions["u0"] == pytest.approx(2.5e-3, rel=1e-3)

    def test_daq_offset_goes_into_u0_alone(self):
        found = analyse(table(*REVERSAL), StandUncertainty(daq_offset_v=5e-6), trials=0)

        assert found.budget[1].contributions["u0"] == pytest.approx(5e-6)
        assert found.budget[1].contributions["kx"] == pytest.approx(0.0, abs=1e-12)

    def test_seating_averages_over_the_mountings(self):
        one_mount = analyse(
            table(sweep("face-up"), realisations=4, unit=dict(UNIT, kxy=0.05)), StandUncertainty(seating_arcsec=3600)
        )

        assert one_mount.budget[1].contributions["alpha0"] == pytest.approx(1.0, rel=1e-6)

    def test_head_reading_is_one_error_for_every_setting_however_often_it_is_set(self):
        few = analyse(table(*REVERSAL, realisations=2), StandUncertainty(head_accuracy_arcsec=5), trials=0)
        many = analyse(table(*REVERSAL, realisations=8), StandUncertainty(head_accuracy_arcsec=5), trials=0)

        assert many.budget[1].contributions["kx"] == pytest.approx(few.budget[1].contributions["kx"], rel=1e-4)

    def test_combined_uncertainty_is_the_root_sum_of_squares(self):
        stand = StandUncertainty(head_accuracy_arcsec=5, seating_arcsec=10, daq_gain=1e-5, daq_offset_v=5e-6)
        found = analyse(table(*REVERSAL), stand, trials=0)

        total = np.sqrt(sum(line.contributions["ky"] ** 2 for line in found.budget))
        assert found.parameters["ky"].standard_uncertainty == pytest.approx(total)

    def test_monte_carlo_agrees_with_the_budget_for_a_sharp_alpha0(self):
        stand = StandUncertainty(head_accuracy_arcsec=5, seating_arcsec=10, daq_gain=1e-5, daq_offset_v=5e-6)
        found = analyse(table(*REVERSAL), stand)

        for name, (uncertainty, _) in found.monte_carlo.items():
            assert uncertainty == pytest.approx(found.parameters[name].standard_uncertainty, rel=0.03)

    def test_monte_carlo_follows_the_curvature_of_a_blunt_alpha0(self):
        found = analyse(table(sweep("face-up"), unit=dict(UNIT, ky=0.0, alpha0=0.0)))
        linearised = 1e-4 * np.sqrt(2 / 400)

        assert found.monte_carlo["kx"][0] > 2 * linearised
        assert found.parameters["kx"].standard_uncertainty == pytest.approx(found.monte_carlo["kx"][0], rel=0.15)

    def test_uncertainty_of_gravity_enters_the_coefficients_per_acceleration_only(self):
        stand = StandUncertainty(gravity=Gravity(value_m_s2=9.81, standard_uncertainty_m_s2=0.00981))
        found = analyse(table(*REVERSAL), stand, trials=0)

        assert found.per_acceleration["kx"].value == pytest.approx(found.parameters["kx"].value / 9.81)
        assert found.per_acceleration["kx"].standard_uncertainty == pytest.approx(1e-3 / 9.81, rel=1e-3)
        assert found.per_acceleration["kxy"].unit == "V/(m/s^2)^2"
        assert found.parameters["kx"].standard_uncertainty < 1e-5


def test_the_result_as_json_has_the_keys_of_its_schema():
    document = analyse(table(*REVERSAL)).as_json()

    assert document["schema"] == "tumble.fit/1"
    assert document["rows"] == {"read": 630, "used": 630, "set_aside": []}
    assert list(document["parameters"]) == ["u0", "kx", "ky", "kz", "kxy", "alpha0"]
    assert set(document["parameters"]["kx"]) >= {"value", "standard_uncertainty", "unit"}
    assert document["noise"]["degrees_of_freedom"] == 630 - 126
    assert set(document["flip_closure"]) == {"x", "y", "z", "p_value", "worst"}
    assert document["published_method"]["parameters"]["kx"]["value"] == pytest.approx(1.0, abs=1e-3)


def test_a_conditional_value_says_so_in_json():
    document = analyse(table(*FLIPS), trials=0).as_json()

    assert document["parameters"]["ky"]["given"] == {"alpha0": 0.0}
    assert document["parameters"]["kxy"]["value"] is None
    assert document["parameters"]["kxy"]["reason"]


def test_shuffled_rows_give_the_same_answer():
    rows = table(*REVERSAL)
    order = np.random.default_rng(3).permutation(len(rows))
    columns = {name: value[order] for name, value in vars(rows).items() if isinstance(value, np.ndarray)}
    shuffled = Observations(**{**vars(rows), **columns})

    first, second = analyse(rows, trials=0).parameters, analyse(shuffled, trials=0).parameters
    assert second["ky"].value == pytest.approx(first["ky"].value, abs=1e-12)


def test_one_turn_more_changes_nothing():
    turned = Observations(**{**vars(table(*REVERSAL)), "angle_deg": table(*REVERSAL).angle_deg + 360.0})

    found = analyse(turned, trials=0).parameters
    assert found["alpha0"].value == pytest.approx(analyse(table(*REVERSAL), trials=0).parameters["alpha0"].value)


def test_output_of_the_published_unit_at_its_poles():
    assert output("face-up", [-90.0])[0] == pytest.approx(3.5, abs=1e-4)
