from pathlib import Path

import numpy as np
import pytest

from tumble.app.methods import methods
from tumble.calibrations.core.cells import TableError
from tumble.calibrations.core.known_tables import recognised
from tumble.calibrations.methods.temperature.loop import close_temperature_loop
from tumble.calibrations.methods.temperature.table import Runs, read_runs

PRINTED = {
    "bias_x_arcsec": 4.3,
    "bias_y_arcsec": 1.4,
    "bias_z_arcsec": 1.4,
    "scale_x_percent": 7.7e-4,
    "scale_y_percent": 30.1e-4,
    "scale_z_percent": 59.2e-4,
    "angle_1_arcsec": 2.2,
    "angle_2_arcsec": 3.3,
    "angle_3_arcsec": 4.6,
    "angle_4_arcsec": 0.5,
    "angle_5_arcsec": 1.3,
    "angle_6_arcsec": 2.9,
}
"""Dzuev 2018, tables 4.16 to 4.18: standard deviations of what a cubic leaves; ppm are 1e-4 percent."""
TRIAD = Path(__file__).parents[2] / "docs" / "samples" / "parameters.csv"
"""The same source, tables 4.11 to 4.14."""


def runs(*, order=None, temperature_degc=None, noise=0.1, seed=3, **shapes):
    """Fifteen runs from -40 to 100 °C; each parameter a function of temperature and order of the runs."""
    at = np.linspace(-40.0, 100.0, 15) if temperature_degc is None else np.array(temperature_degc)
    order = np.random.default_rng(1).permutation(len(at)) + 1.0 if order is None else order
    rng = np.random.default_rng(seed)
    values = {name: shape(at, order) + noise * rng.standard_normal(len(at)) for name, shape in shapes.items()}
    return Runs(
        temperature_degc=at, temperature_name="sensor_degC", order=order, time_s=None, parameters=values, source="made"
    )


def names(loop, parameter="a_mV"):
    found = next(each for each in loop.parameters if each.name == parameter)
    return sorted(effect.name for effect in found.effects)


@pytest.mark.parametrize("seed", range(30, 40))
def test_a_constant_stays_a_constant(seed):
    assert names(close_temperature_loop(runs(a_mV=lambda at, order: 5.0 + 0 * at, seed=seed))) == []


def test_a_parabola_is_a_parabola():
    loop = close_temperature_loop(runs(a_mV=lambda at, order: 2e-3 * at**2 + 0.05 * at))
    assert names(loop) == ["temperature_linear", "temperature_quadratic"]


def test_a_break_is_found_where_it_is_and_predicts_runs_that_were_left_out():
    loop = close_temperature_loop(runs(a_mV=lambda at, order: 0.5 * np.clip(at - 42.0, 0, None)))
    (parameter,) = loop.parameters
    (effect,) = parameter.effects
    assert effect.name == "temperature_break"
    assert effect.coefficients["at_degC"].value == pytest.approx(42.0, abs=1.5)
    assert effect.coefficients["slope"].unit == "mV/K"
    assert parameter.augmented.held_out_rms < 0.5 * parameter.polynomials[3].held_out_rms


def test_ageing_from_run_to_run_is_distinguished_from_temperature_where_the_order_was_shuffled():
    assert names(close_temperature_loop(runs(a_mV=lambda at, order: 0.4 * order))) == ["run_drift"]


def test_where_every_run_was_warmer_it_is_said_that_ageing_is_not_distinguishable():
    loop = close_temperature_loop(runs(order=np.arange(1.0, 16.0), a_mV=lambda at, order: 0.4 * order))
    assert loop.limits[0].startswith("Every run was warmer than the one before it")


def test_of_constants_nothing_is_said_to_be_found():
    loop = close_temperature_loop(runs(**{f"p{n}_ppm": lambda at, order: 0 * at for n in range(4)}))
    assert not any("was found" in sentence for sentence in loop.limits)


def test_times_say_which_run_was_made_when(tmp_path):
    rng = np.random.default_rng(5)
    order = rng.permutation(15)
    lines = [f"{600 * at},{rng.uniform(10, 40)},{0.4 * at + 0.01 * rng.standard_normal()}" for at in order]
    path = written(tmp_path, "\n".join(["time_s,sensor_degC,a_mV", *lines]))
    assert names(close_temperature_loop(read_runs(path))) == ["run_drift"]


def test_few_runs_are_too_few_and_that_is_said():
    loop = close_temperature_loop(runs(temperature_degc=[0, 10, 20, 30], a_mV=lambda at, order: at))
    assert loop.limits[0] == "Nothing is looked for: 4 rows are too few; at least 6 are needed."


def test_a_column_of_remarks_is_left_out(tmp_path):
    lines = [f"{run},{10 * run},{0.5 * run},good" for run in range(1, 9)]
    path = written(tmp_path, "\n".join(["run,sensor_degC,a_mV,note", *lines]))
    assert list(read_runs(path).parameters) == ["a_mV"]


def test_breaks_at_one_temperature_are_one_cause():
    loop = close_temperature_loop(
        runs(
            a_mV=lambda at, order: 0.5 * np.clip(at - 42.0, 0, None),
            b_arcsec=lambda at, order: 3.0 - 0.8 * np.clip(at - 42.0, 0, None),
            c_ppm=lambda at, order: 0.1 * at,
        )
    )
    (cause,) = loop.shared
    assert set(cause.parameters) == {"a_mV", "b_arcsec"}
    assert cause.one
    assert cause.at_degc == pytest.approx(42.0, abs=1.5)


def test_breaks_far_apart_are_two_causes():
    loop = close_temperature_loop(
        runs(
            a_mV=lambda at, order: 0.5 * np.clip(at - 12.0, 0, None),
            b_mV=lambda at, order: 0.5 * np.clip(at - 62.0, 0, None),
        )
    )
    assert loop.shared == ()


@pytest.fixture(scope="module")
def triad():
    return close_temperature_loop(read_runs(TRIAD))


def test_the_deviations_that_a_cubic_leaves_of_the_triad_come_out_as_printed(triad):
    for parameter in triad.parameters:
        scale = 1e4 if parameter.unit == "percent" else 1.0
        printed = PRINTED[parameter.name] * scale
        assert scale * parameter.polynomials[3].standard_deviation == pytest.approx(printed, abs=0.1)


def test_the_biases_of_the_triad_break_together_below_fifty_degrees(triad):
    first, second = triad.shared
    assert set(first.parameters) == {"bias_x_arcsec", "bias_y_arcsec", "bias_z_arcsec"}
    assert first.between_degc == (40.97, 50.18)
    assert {"angle_1_arcsec", "angle_2_arcsec", "angle_3_arcsec"} <= set(second.parameters)


def written(tmp_path, text):
    (tmp_path / "runs.csv").write_text(text, "utf-8")
    return tmp_path / "runs.csv"


def test_a_table_of_runs_is_known_by_its_temperature_and_by_having_no_angle(tmp_path):
    assert recognised(written(tmp_path, "run,sensor_degC,bias_V\n1,20,0.1\n"), methods()).name == "temperature"
    assert (
        recognised(written(tmp_path, "angle_deg,voltage_V,temperature_degC\n0,1,20\n"), methods()).name
        == "dividing_head"
    )


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("run,sensor_degC\n1,20\n2,30\n3,40\n4,50\n", "no parameter beside the temperature"),
        ("sensor_degC,a_V\n20,1\n20,1\n20,1\n20,1\n", r"so few runs \(4\) at so few temperatures \(1\)"),
        ("sensor_degC,a_V\n20,1\n30,one\n40,1\n50,1\n", "line 3, column a_V: 'one' is not a number"),
        ("sensor_degC,a_V\n20,1\n30,nan\n40,1\n50,1\n", "line 3, column a_V: nan is no value"),
        ("sensor_degC,a_V\n20,1\n30,1e200\n40,1\n50,1\n", "line 3, column a_V: 1e200 is no value"),
    ],
)
def test_a_malformed_table_of_runs_is_refused_in_one_sentence(tmp_path, text, said):
    with pytest.raises(TableError, match=said):
        read_runs(written(tmp_path, text))
