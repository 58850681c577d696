"""The forms of the bank against tables that an independent generator made, with the coefficients it states."""

import csv
import json

import numpy as np
import pytest

from benchmarks.bank.catalogue import DRAW
from benchmarks.bank.daq_effects import range_step
from benchmarks.bank.dwells import Dwells, dwells
from benchmarks.bank.geometry import AXES, projections
from benchmarks.bank.hysteresis import path
from benchmarks.bank.scene import AngleEffect, OutputEffect, Run, Scene, Unit, respond
from benchmarks.bank.stand_effects import harmonic

QUIET_V = 1.06e-4
"""The examples hold 100 µV of noise; over 830 rows its root mean square scatters by 2.5 %."""


def example(shared, name):
    """An example table as a run of the bank, with its readings, unit and coefficients."""
    source = next((shared / "cases").glob(f"{name}-*.csv"))
    with source.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    column = {key: np.array([row[key] for row in rows]) for key in rows[0]}
    mounting = np.cumsum(np.concatenate([[False], column["mount"][1:] != column["mount"][:-1]]))
    realisation = column["realisation"].astype(int)
    laid_out = Dwells(
        realisation=realisation,
        procedure=column["procedure"],
        mount=column["mount"],
        angle_deg=column["angle_deg"].astype(float),
        time_s=column["time_s"].astype(float),
        direction=column["direction"].astype(int),
        follows=np.concatenate([[False], (np.diff(mounting) == 0) & (np.diff(realisation) == 0)]),
        mounting=mounting,
        axes=np.stack([AXES[mount] for mount in column["mount"]]),
    )
    sd_v = column["voltage_sd_V"].astype(float)
    temperature_degc = column["temperature_degC"].astype(float)
    run = Run(dwells=laid_out, temperature_degc=temperature_degc, expected_sd_v=sd_v, measured_sd_v=sd_v)
    truth = json.loads(source.with_suffix(".truth.json").read_text(encoding="utf-8"))
    return run, column["voltage_V"].astype(float), Unit(**truth["unit"]), truth["coefficients"]


def left_over_v(run, reading_v, unit, sized):
    """Root mean square of what the bank's own response leaves."""
    return float(np.sqrt(np.mean((reading_v - respond(run, unit, sized)) ** 2)))


def drawn(name, run, shape="pure"):
    """The named effect in the given form."""
    effects = (DRAW[name](np.random.default_rng(seed), run) for seed in range(50))
    return next(effect for effect in effects if effect.shape == shape)


@pytest.mark.parametrize("name", ["15", "16"])
def test_a_clean_table_leaves_its_noise(shared, name):
    run, reading_v, unit, _ = example(shared, name)
    assert left_over_v(run, reading_v, unit, ()) < QUIET_V


@pytest.mark.parametrize(
    ("number", "name", "shape"),
    [
        ("01", "k_xx", "pure"),
        ("02", "k_xxx", "pure"),
        ("03", "bias_temperature", "pure"),
        ("04", "bias_drift", "pure"),
        ("10", "backlash", "constant"),
        ("12", "settling", "previous reading"),
        ("12", "settling", "previous voltage"),
        ("14", "vibration_rectification", "measured variance"),
    ],
)
def test_an_effect_with_its_stated_coefficient_explains_the_example(shared, number, name, shape):
    run, reading_v, unit, coefficients = example(shared, number)
    effect = drawn(name, run, shape)
    assert left_over_v(run, reading_v, unit, ()) > 1.4e-4
    assert left_over_v(run, reading_v, unit, ((effect, coefficients[name]),)) < QUIET_V


@pytest.mark.parametrize(("number", "name", "order"), [("08", "head_eccentricity", 1), ("09", "graduation", 3)])
def test_a_harmonic_of_the_head_has_the_phase_of_the_contract(shared, number, name, order):
    run, reading_v, unit, coefficients = example(shared, number)
    effect = harmonic(name, order, coefficients[name]["phase_deg"], run)
    assert left_over_v(run, reading_v, unit, ((effect, coefficients[name]["amplitude_deg"]),)) < QUIET_V


def test_a_range_step_is_added_above_its_threshold(shared):
    run, reading_v, unit, coefficients = example(shared, "13")
    stated = coefficients["range_step"]
    effect = range_step("sharp", stated["threshold_V"], 0.0, 1.0)
    assert left_over_v(run, reading_v, unit, ((effect, stated["step"]),)) < QUIET_V


def test_an_autoranging_meter_holds_its_range_between_its_two_thresholds(shared):
    run, *_ = example(shared, "15")
    meter = range_step("hysteresis", 2.0, 0.01, 1.0)
    volts = np.array([1.9, 2.005, 2.02, 2.005, 1.995, 1.98])
    np.testing.assert_allclose(meter.error_v(run, volts, 0.5), [0.0, 0.0, 0.5, 0.5, 0.5, 0.0])


def test_a_rounded_range_step_is_half_way_at_its_threshold(shared):
    run, *_ = example(shared, "15")
    rounded = range_step("rounded", 2.0, 0.01, 1.0)
    np.testing.assert_allclose(rounded.error_v(run, np.array([1.5, 2.0, 2.5]), 0.5), [0.0, 0.25, 0.5])


def test_a_warm_up_starts_at_the_first_row_and_leaves_the_settled_unit(shared):
    run, reading_v, unit, coefficients = example(shared, "05")
    stated = coefficients["warm_up"]
    decay = np.exp(-run.dwells.elapsed_s / stated["tau_s"])
    effect = OutputEffect(name="warm_up", added_v=lambda _, amplitude: amplitude * decay)
    assert left_over_v(run, reading_v, unit, ((effect, stated["amplitude"]),)) < QUIET_V


def test_a_misreading_is_true_minus_reported_and_rows_count_from_one(shared):
    run, reading_v, unit, coefficients = example(shared, "11")
    error_deg = np.zeros(len(reading_v))
    error_deg[np.array(coefficients["misreading"]["rows"]) - 1] = coefficients["misreading"]["error_deg"]
    effect = AngleEffect(name="misreading", error_deg=lambda _, amplitude: amplitude * error_deg)
    assert left_over_v(run, reading_v, unit, ((effect, 1.0),)) < QUIET_V


def test_every_form_of_hysteresis_lags_as_the_example_does(shared):
    run, reading_v, unit, coefficients = example(shared, "07")
    plain_v = left_over_v(run, reading_v, unit, ())
    for shape in ("play", "approach", "two plays"):
        effect = drawn("hysteresis", run, shape)
        assert left_over_v(run, reading_v, unit, ((effect, coefficients["hysteresis"]),)) < 0.9 * plain_v


def test_the_path_of_a_half_turn_goes_through_the_pole():
    laid_out = dwells("f", 1, np.random.default_rng(0))
    flat = np.zeros(len(laid_out))
    run = Run(dwells=laid_out, temperature_degc=flat, expected_sd_v=flat, measured_sd_v=flat)
    angle_deg = laid_out.angle_deg + 0.25
    gravity = projections(laid_out.axes, angle_deg)
    ax, ends = path(Scene(run=run, angle_deg=angle_deg, gravity=gravity))
    np.testing.assert_allclose(ax[ends], gravity[:, 0])
    # From -89.75° to 90.25°: level at 0°, the pole at 90°, and a little back.
    np.testing.assert_allclose(ax[ends[0] + 1 : ends[1] + 1], [0.0, -1.0, -np.cos(np.deg2rad(0.25))], atol=1e-12)
