"""What a stand adds to the uncertainty of a triad, and the check by simulation."""

import numpy as np
import pytest
from triad_tables import TRUTH, made, read

from tumble.calibrations.core.gravity import Gravity
from tumble.calibrations.core.parameter import Parameter
from tumble.calibrations.methods.triad.at_the_stand import declared_at, loop_at
from tumble.calibrations.methods.triad.budget import MeterUncertainty, TwoAxisUncertainty
from tumble.calibrations.methods.triad.correction import correction
from tumble.calibrations.methods.triad.document import document, fit_document
from tumble.calibrations.methods.triad.loop import close_triad_loop, declared_fit
from tumble.calibrations.methods.triad.sections import sections
from tumble.calibrations.report.budget_sections import simulation_section

NOTHING = TwoAxisUncertainty()
SCANNER = MeterUncertainty(name="scanner", channels=(0, 1, 2), gain=2e-5, offset_v=5e-6)


@pytest.fixture(scope="module")
def declared(tmp_path_factory):
    return declared_fit(read(tmp_path_factory.mktemp("t"), made("24", passes=2)))


def added(declared, **stated):
    """What the only further source adds to each parameter."""
    (_, line) = declared_at(declared, TwoAxisUncertainty(**stated), trials=0).budget.lines
    return line.contributions


def test_without_a_stand_only_the_scatter_of_the_data_is_in_the_budget(declared):
    found = declared_at(declared, NOTHING)

    assert [(str(line.name), line.kind) for line in found.budget.lines] == [("scatter of the data", "A")]
    assert found.model.parameters["m_xy"].standard_uncertainty == pytest.approx(
        declared.model.parameters["m_xy"].standard_uncertainty
    )


def test_a_gain_changes_the_scale_factors_and_no_angle(declared):
    contributions = added(declared, meters=(MeterUncertainty(name="one", channels=(0, 1, 2), gain=2e-5),))

    assert contributions["scale_x"] == pytest.approx(2e-5 * TRUTH["scale_x"], rel=1e-3)
    assert contributions["m_xz"] == pytest.approx(0.0, abs=1e-6)


def test_the_offset_of_a_meter_of_one_channel_changes_the_bias_of_that_channel_alone(declared):
    contributions = added(declared, meters=(MeterUncertainty(name="y", channels=(1,), offset_v=5e-6),))

    assert contributions["bias_y"] == pytest.approx(5e-6, rel=1e-6)
    assert contributions["bias_x"] == pytest.approx(0.0, abs=1e-12)


def test_errors_of_the_inner_axis_are_those_of_its_eight_settings(declared):
    """Of m_xy - m_yx a mean of the settings shows: each is 1″, and the positions weigh them unequally."""
    contributions = added(declared, inner_arcsec=1.0)

    assert 0.2 < contributions["m_xy"] < 1.0
    assert contributions["bias_z"] == pytest.approx(0.0, abs=1e-9)


def test_more_passes_do_not_lessen_what_an_axis_adds(declared, tmp_path):
    many = declared_fit(read(tmp_path, made("24", passes=6)))

    assert added(many, outer_arcsec=2.0)["m_yz"] == pytest.approx(added(declared, outer_arcsec=2.0)["m_yz"], rel=1e-6)


def test_lines_of_the_budget_come_to_the_combined_uncertainty(declared):
    stand = TwoAxisUncertainty(outer_arcsec=1.0, inner_arcsec=2.0, meters=(SCANNER,))
    found = declared_at(declared, stand, trials=0)

    for name, parameter in found.model.parameters.items():
        total = np.sqrt(sum(line.contributions[name] ** 2 for line in found.budget.lines))
        assert total == pytest.approx(parameter.standard_uncertainty)


def test_simulated_calibrations_agree_with_the_budget(declared):
    found = declared_at(declared, TwoAxisUncertainty(outer_arcsec=1.0, inner_arcsec=2.0, meters=(SCANNER,)))

    for name, (uncertainty, _) in found.budget.monte_carlo.items():
        assert uncertainty == pytest.approx(found.model.parameters[name].standard_uncertainty, rel=0.03)


def test_gravity_enters_scale_factors_per_acceleration_alone(declared):
    gravity = Gravity(value_m_s2=9.81, standard_uncertainty_m_s2=9.81e-4)
    found = declared_at(declared, TwoAxisUncertainty(gravity=gravity), trials=0)

    assert set(found.budget.per_acceleration) == {"scale_x", "scale_y", "scale_z"}
    each, scale = found.budget.per_acceleration["scale_x"], found.model.parameters["scale_x"].value
    assert each.standard_uncertainty / each.value == pytest.approx(1e-4, rel=0.01)
    assert each.value == pytest.approx(scale / 9.81)


def test_the_correction_that_a_user_loads_holds_what_the_stand_adds(declared):
    found = declared_at(declared, TwoAxisUncertainty(meters=(SCANNER,)), trials=0)

    assert correction(found.fit).covariance[0, 0] == pytest.approx(
        correction(declared.fit).covariance[0, 0] + 5e-6**2, rel=1e-3
    )


def test_what_a_stand_file_does_not_state_is_said():
    assert "no stand file says" in NOTHING.left_out
    assert "samplers.scanner" not in TwoAxisUncertainty(outer_arcsec=1.0, meters=(SCANNER,)).left_out
    assert "positioners.inner.accuracy_arcsec" in TwoAxisUncertainty(outer_arcsec=1.0, meters=(SCANNER,)).left_out
    assert TwoAxisUncertainty(outer_arcsec=1.0, inner_arcsec=0.0, meters=(SCANNER,)).left_out == ""


def test_documents_and_report_have_budget_and_check(declared, tmp_path):
    loop = loop_at(close_triad_loop(read(tmp_path, made("24"))), TwoAxisUncertainty(meters=(SCANNER,)), trials=1000)

    assert {"budget", "monte_carlo", "per_m_s2"} <= set(fit_document(declared))
    assert [line["name"] for line in document(loop)["augmented"]["budget"]][1:] == [
        "gain of scanner",
        "offset of scanner",
        "explanations that fit nearly as well",
    ]
    shown = {str(section.title): section for section in sections(loop)}
    assert len(shown["Uncertainty budget"].rows) == 14
    assert len(shown["Check by propagation of distributions"].rows) == 14


def test_what_was_simulated_stands_under_its_heading():
    bias = Parameter(name="bias_x", unit="V", value=1.0, standard_uncertainty=2e-4, interval_95=(0.9996, 1.0004))
    section = simulation_section([bias], {"bias_x": (3e-4, (0.9994, 1.0006))})
    row = dict(zip(section.headings, section.rows[0], strict=True))
    assert (row["u, budget"], row["u, simulated"]) == ("200 µV", "300 µV")
