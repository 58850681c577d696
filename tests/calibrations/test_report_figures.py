"""The plots: which ones there are, what they draw, and how much they weigh."""

import xml.etree.ElementTree as ET
from dataclasses import replace

import numpy as np
import pytest
from report_examples import FACE_UP, calibrate, chapter, dwells, face_up, flips_only, provenance, reversed_

from tumble.calibrations.methods.dividing_head.flips import FlipClosure, FlipMean
from tumble.calibrations.methods.dividing_head.geometry import projections
from tumble.calibrations.methods.dividing_head.report.figures import closure_figure, fit_figure, model_curve
from tumble.calibrations.methods.dividing_head.report.residuals import covariate_figure
from tumble.calibrations.methods.dividing_head.report.subject import Subject


def test_the_curve_is_the_model_at_the_fitted_parameters():
    angle_deg, output_v = model_curve(face_up(), "edge")
    values = {name: parameter.value for name, parameter in face_up().parameters.items()}
    ax, ay, az = projections(np.full(len(angle_deg), "edge"), angle_deg + values["alpha0"]).T
    expected = values["u0"] + values["kx"] * ax + values["ky"] * ay + values["kz"] * az + values["kxy"] * ax * ay
    np.testing.assert_allclose(output_v, expected, atol=1e-9)
    assert (angle_deg[0], angle_deg[-1]) == (0.0, 180.0)


def test_parameters_that_have_no_value_here_count_as_zero_in_the_curve():
    assert model_curve(flips_only(), "face-up") is not None


def test_there_is_no_curve_where_the_values_do_not_give_the_fit_back():
    parameters = dict(face_up().parameters)
    parameters["ky"] = replace(parameters["ky"], value=None)
    calibration = replace(face_up(), parameters=parameters)
    assert model_curve(calibration, "face-up") is None


def test_a_plot_has_its_own_id_and_is_drawn_for_a_blunt_result():
    plot = ET.fromstring(fit_figure(flips_only()).__html__())
    assert [element.get("id") for element in plot.iter() if element.get("id")] == ["figure-fit"]
    assert plot.get("aria-label") == "Output against head angle with the fitted model, for face up, on edge"


def test_an_odd_number_of_mounts_leaves_no_empty_panel():
    assert fit_figure(reversed_()).__html__().count('class="panel"') == 3


def test_only_covariates_of_the_table_that_vary_are_plotted():
    rows = 3 * 46
    observations = dwells(FACE_UP, time_s=np.arange(rows) * 5.0, temperature_degc=np.full(rows, 23.0))
    shown = [panel.x.label for panel in covariate_figure(calibrate(observations)).panels]
    assert shown == ["time (s)", "realisation", "normal quantile"]
    bare = replace(face_up(), observations=replace(face_up().observations, realisation=None))
    assert [panel.x.label for panel in covariate_figure(bare).panels] == ["normal quantile"]


def test_many_rows_stay_vectors_and_small():
    calibration = calibrate(dwells(FACE_UP, realisations=20))
    plot = covariate_figure(calibration).__html__()
    assert "data:image" not in plot
    assert len(plot) < 100_000


def test_few_rows_stay_vectors_and_without_repeats_the_band_is_the_scatter_about_the_fit():
    calibration = calibrate(dwells(FACE_UP[2:], realisations=1))
    weighted = replace(calibration, weights=np.linspace(0.5, 1.5, len(calibration.weights)))
    shown = chapter("residuals", Subject(calibration=weighted, provenance=provenance()))
    assert "data:image" not in shown
    assert "times the root of the weight of the row. The band is ± " in shown
    assert " µV, the scatter about the fit; no pose was repeated." in shown


@pytest.mark.parametrize("u_v", [0.0, 1e-5])
def test_a_single_flip_is_drawn_with_or_without_an_uncertainty(u_v):
    mean = FlipMean(u0_v=2.5, standard_uncertainty_v=u_v, expected_v=2.5)
    assert (
        ET.fromstring(closure_figure(FlipClosure(axes={"x": mean}, p_value=None, worst=None)).__html__()).get("role")
        == "img"
    )
