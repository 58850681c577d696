"""The loop closed on triads: effects, questions, what is set aside, the files that come of it."""

import json

import numpy as np
import pytest
from click.testing import CliRunner
from triad_tables import ARCSEC, NOISE_V, TRUTH, made, read, written

from tumble.app.cli import cli
from tumble.calibrations.methods.triad.correction import correction
from tumble.calibrations.methods.triad.document import document
from tumble.calibrations.methods.triad.doubts import doubts
from tumble.calibrations.methods.triad.fit import fit_triad
from tumble.calibrations.methods.triad.gross import gross_errors
from tumble.calibrations.methods.triad.loop import close_triad_loop
from tumble.calibrations.methods.triad.probes import PROBES
from tumble.calibrations.methods.triad.table import triad_table
from tumble.calibrations.tracing.effect import Quantity
from tumble.calibrations.tracing.findings import EffectFound
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.sentences import findings
from tumble.calibrations.tracing.trace import Trace


def in_x(values):
    return np.column_stack([values, np.zeros_like(values), np.zeros_like(values)])


def loop_of(tmp_path, **table):
    return close_triad_loop(read(tmp_path, made(**table)))


def declared(observations):
    """The fit before anything is traced."""
    table = triad_table(observations.without(gross_errors(observations)))
    return fit_triad(table, Trace(found=(), noise=NoiseModel(), deviance=table.deviance((), NoiseModel())))


@pytest.fixture(scope="module")
def clean(tmp_path_factory):
    return loop_of(tmp_path_factory.mktemp("clean"), passes=2)


def test_a_clean_table_is_traced_to_nothing(clean):
    assert clean.effects == ()
    assert clean.unexplained is None
    assert clean.experiments == ()


def test_the_parameters_of_a_clean_table_are_inside_three_standard_uncertainties(clean):
    for name, parameter in clean.augmented.parameters.items():
        assert abs(parameter.value - TRUTH[name]) < 3.0 * parameter.standard_uncertainty, name


def test_a_second_order_nonlinearity_of_one_channel_is_found_with_its_size(tmp_path):
    loop = loop_of(tmp_path, passes=2, added=lambda g, outer, inner: in_x(2e-4 * g[:, 0] ** 2))
    (effect,) = loop.effects
    assert (effect.name, effect.also_possible, effect.belongs_to) == ("x.k_xx", (), "unit")
    value = effect.coefficients["value"]
    assert value.value == pytest.approx(2e-4, abs=3 * value.standard_uncertainty)
    assert value.unit == "V/g^2"


def test_an_error_of_the_inner_axis_is_the_stands(tmp_path):
    def second_harmonic(g, outer, inner):
        error = 40 * ARCSEC * np.sin(2 * np.deg2rad(inner) + 0.5)
        return error[:, None] * np.column_stack([g[:, 1], -g[:, 0], np.zeros(len(g))])

    (effect,) = loop_of(tmp_path, passes=2, added=second_harmonic).effects
    assert (effect.name, effect.belongs_to) == ("inner_second_harmonic", "stand")
    assert effect.coefficients["amplitude_arcsec"].value == pytest.approx(40.0, rel=0.1)


def test_what_was_found_lowers_the_error_of_positions_that_were_held_out(tmp_path):
    loop = loop_of(tmp_path, passes=2, added=lambda g, outer, inner: in_x(2e-4 * g[:, 0] ** 2))
    assert loop.augmented.held_out_rms < 0.6 * loop.declared.held_out_rms


def test_a_gross_error_in_a_noisy_channel_is_judged_by_its_own_scatter(tmp_path):
    columns = made(passes=2)
    columns["u_z_V"][7] += 2.5 * NOISE_V[2]
    columns["u_y_V"][11] += 15 * NOISE_V[1]
    (aside,) = close_triad_loop(read(tmp_path, columns)).observations.set_aside
    assert aside.row == 12
    assert "channel y" in aside.reason


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda c: c | {"u_x_V": c["u_y_V"], "u_y_V": c["u_x_V"]}, "no seating of the unit explains"),
        (lambda c: c | {"u_x_V": -c["u_x_V"]}, "x → -x"),
        (lambda c: c | {"inner_deg": -c["inner_deg"]}, "an axis turns the other way"),
        (
            lambda c: c | {"outer_deg": np.deg2rad(c["outer_deg"]), "inner_deg": np.deg2rad(c["inner_deg"])},
            "are they in radians",
        ),
        (lambda c: c | {"outer_deg": c["inner_deg"], "inner_deg": c["outer_deg"]}, "do not follow gravity"),
        (lambda c: c | {"u_y_V": 0.0 * c["u_y_V"]}, "the output of channel y is the same in every row"),
        (
            lambda c: c | {"u_y_V": 0.0 * c["u_y_V"], "u_z_V": 0.0 * c["u_z_V"]},
            "the outputs of channels y and z are the same",
        ),
    ],
)
def test_a_table_that_cannot_be_right_is_asked_about_and_traced_to_nothing(tmp_path, change, words):
    loop = close_triad_loop(read(tmp_path, change(made(passes=2))))
    assert words in loop.doubts[0]
    assert loop.effects == ()
    assert loop.unexplained is None
    assert all(parameter.value is None for parameter in loop.augmented.parameters.values())


def test_four_positions_are_refused_with_the_number_that_is_needed(tmp_path):
    columns = {name: values[:4] for name, values in made().items()}
    with pytest.raises(ValueError, match=r"4 positions do not determine .* at least 5"):
        close_triad_loop(read(tmp_path, columns))


def test_the_document_holds_the_contract_and_the_correction(clean):
    result = json.loads(json.dumps(document(clean)))
    assert (result["schema"], result["method"]) == ("tumble.loop/1", "triad")
    assert {"noise", "scalar", "mismatch_arcsec", "warnings", "correction", "next_experiment"} <= result.keys()
    assert np.shape(result["correction"]["covariance"]) == (12, 12)
    mismatch = result["mismatch_arcsec"]
    assert mismatch["degrees_of_freedom"] == 48 - 9
    assert mismatch["sd"] == pytest.approx(np.sqrt(np.mean((NOISE_V / ARCSEC) ** 2)), rel=0.5)


def test_the_covariance_of_the_correction_is_that_of_its_change_with_the_data(tmp_path, clean):
    ours = correction(clean.best)
    others = [correction(declared(read(tmp_path, made(passes=2, seed=seed)))).matrix_g_per_v for seed in range(2, 42)]
    scatter = np.std([each.ravel() for each in others], axis=0, ddof=1)
    assert scatter == pytest.approx(np.sqrt(np.diag(ours.covariance))[3:], rel=0.4)


def test_close_loop_shows_records_and_reports_a_triad(tmp_path):
    table = written(tmp_path / "triad.csv", made(passes=2))
    page, store = tmp_path / "triad.html", tmp_path / "store"
    command = ["close-loop", str(table), "--store", str(store), "--record", "--report", str(page)]
    ran = CliRunner().invoke(cli, command)
    assert ran.exit_code == 0, ran.output
    assert "scale_x" in ran.output
    assert "Mismatch by position" in page.read_text(encoding="utf-8")
    verified = CliRunner().invoke(cli, ["records", "verify", "--store", str(store)])
    assert verified.exit_code == 0, verified.output


def test_the_report_of_a_triad_says_what_changed_since_the_last_calibration(tmp_path):
    page, store, pages = tmp_path / "triad.html", tmp_path / "store", []
    for passes in (2, 3):
        folder = tmp_path / str(passes)
        folder.mkdir()
        table = written(folder / "triad.csv", made(passes=passes))
        command = ["close-loop", str(table), "--store", str(store), "--record", "--report", str(page)]
        assert CliRunner().invoke(cli, command).exit_code == 0
        pages.append("change since the last calibration" in page.read_text(encoding="utf-8"))
    assert pages == [False, True]


def test_a_table_in_order_raises_no_doubt(clean):
    assert doubts(clean.explained.table, clean.before.deviations_v) == ()


def test_the_unit_of_a_coefficient_is_said_once():
    quantity = Quantity(value=8.91, standard_uncertainty=0.69, unit="arcsec")
    effect = EffectFound(
        name="inner_eccentricity",
        also_possible=(),
        belongs_to="stand",
        coefficients={"amplitude_arcsec": quantity, "phase_deg": quantity},
        p_value=1e-9,
    )
    assert findings([effect])[0].coefficients.startswith("amplitude 8.91(69) arcsec")


def test_lists_of_positions_are_offered_the_shortest_first():
    lengths = [len(probe.positions) for probe in PROBES]
    assert lengths == sorted(lengths)
