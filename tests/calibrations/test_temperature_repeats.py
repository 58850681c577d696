"""What counts is the number of temperatures, not of runs."""

import numpy as np
import pytest

from tumble.calibrations.methods.temperature.document import document
from tumble.calibrations.methods.temperature.loop import close_temperature_loop
from tumble.calibrations.methods.temperature.table import Runs


def runs(at_degc, bias_mv, *, noise=0.02, seed=6):
    at = np.array(at_degc, dtype=float)
    order = np.arange(1.0, len(at) + 1)
    heating = np.sign(np.diff(at, prepend=at[0]))
    values = bias_mv(at, order, heating) + noise * np.random.default_rng(seed).standard_normal(len(at))
    return Runs(
        temperature_degc=at,
        temperature_name="sensor_degC",
        order=order,
        time_s=None,
        parameters={"bias_mV": values},
        source="made",
    )


def only(loop):
    (parameter,) = loop.parameters
    return parameter, sorted(effect.name for effect in parameter.effects)


UP_AND_DOWN = [*range(-40, 81, 10), *range(80, -41, -10)]


def test_two_temperatures_carry_no_cubic_however_often_they_were_visited():
    loop = close_temperature_loop(runs([20, 60] * 8, lambda at, order, heating: 0.1 * at))
    parameter, names = only(loop)
    assert names == []
    assert [polynomial.power for polynomial in parameter.polynomials] == [0]
    assert (
        loop.limits[0] == "Nothing is looked for: 2 temperatures (visited 16 times) are too few; at least 6 are needed."
    )
    assert parameter.augmented.parameters["constant"].value is None
    assert document(loop)["rows"]["temperatures"] == 2


@pytest.mark.parametrize(("temperatures", "power"), [(3, 1), (4, 2), (5, 3), (6, 3)])
def test_a_polynomial_has_a_temperature_to_spare(temperatures, power):
    at = np.repeat(np.linspace(0.0, 50.0, temperatures), 3)
    parameter, _ = only(close_temperature_loop(runs(at, lambda at, order, heating: 0.01 * at)))
    assert parameter.polynomials[-1].power == power


def test_held_out_errors_are_of_whole_temperatures():
    at = np.repeat([0.0, 10.0, 20.0, 30.0, 40.0, 50.0], 4)
    parameter, _ = only(close_temperature_loop(runs(at, lambda at, order, heating: 5.0 * (at == 50.0), noise=0.0)))
    assert parameter.polynomials[0].held_out_rms == pytest.approx(np.sqrt((25.0 + 5 * 1.0) / 6))


def test_temperatures_that_a_chamber_sets_nearly_alike_are_one():
    at = np.repeat([0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0], 3) + np.tile([0.0, 0.3, -0.2], 7)
    loop = close_temperature_loop(runs(at, lambda at, order, heating: 0.1 * at))
    assert loop.temperatures == 7
    assert only(loop)[1] == ["temperature_linear"]


def test_repeats_say_how_well_a_run_repeats():
    loop = close_temperature_loop(runs(UP_AND_DOWN * 2, lambda at, order, heating: 0.1 * at))
    parameter, names = only(loop)
    assert names == ["temperature_linear"]
    assert parameter.pure_error.standard_deviation == pytest.approx(0.02, rel=0.3)
    assert document(loop)["parameters"]["bias_mV"]["noise"]["degrees_of_freedom"] > 20


def test_heating_and_cooling_may_differ():
    loop = close_temperature_loop(runs(UP_AND_DOWN * 2, lambda at, order, heating: 0.1 * at + 0.15 * heating))
    parameter, names = only(loop)
    assert names == ["temperature_hysteresis", "temperature_linear"]
    gap = next(effect for effect in parameter.effects if effect.name == "temperature_hysteresis")
    assert gap.coefficients["temperature_hysteresis"].value == pytest.approx(0.3, abs=0.05)


def test_a_drift_is_seen_between_visits_of_one_temperature():
    loop = close_temperature_loop(runs(UP_AND_DOWN * 2, lambda at, order, heating: 0.1 * at + 0.02 * order))
    assert only(loop)[1] == ["run_drift", "temperature_linear"]


@pytest.mark.parametrize("seed", range(80, 88))
def test_a_constant_that_was_measured_often_stays_a_constant(seed):
    loop = close_temperature_loop(runs(UP_AND_DOWN * 2, lambda at, order, heating: 5.0 + 0 * at, seed=seed))
    assert only(loop)[1] == []
