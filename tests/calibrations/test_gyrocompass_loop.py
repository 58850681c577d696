"""The loop closed on simulated gyrocompassing: full rotation matrices, see `benchmarks/gyrocompass/world.py`."""

import numpy as np
import pytest

from benchmarks.gyrocompass.__main__ import write
from benchmarks.gyrocompass.effects import STAND, UNIT
from benchmarks.gyrocompass.world import Design, make
from tumble.calibrations.methods.gyrocompass.at_the_stand import loop_at
from tumble.calibrations.methods.gyrocompass.budget import TurntableUncertainty
from tumble.calibrations.methods.gyrocompass.document import document
from tumble.calibrations.methods.gyrocompass.loop import asked_next, close_gyrocompass_loop, declared_fit
from tumble.calibrations.methods.gyrocompass.observations import read_gyrocompass_table

FOUR = (0.0, 90.0, 180.0, 270.0)
SMALL = Design(angles_deg=FOUR, passes=3, lean_deg=3.0)
LEVEL = Design(angles_deg=FOUR, passes=3, lean_deg=0.3)


def simulated(design=SMALL, seed=3, **sizes):
    stand = [(STAND[name], size) for name, size in sizes.items() if name in STAND]
    unit = [(UNIT[name], size) for name, size in sizes.items() if name in UNIT]
    return make(np.random.default_rng(seed), design, stand, unit)


@pytest.fixture
def looped(tmp_path):
    def close(columns):
        write(tmp_path / "table.csv", columns)
        return close_gyrocompass_loop(read_gyrocompass_table(tmp_path / "table.csv"))

    return close


def names(loop):
    return [effect.name for effect in loop.effects]


def test_a_clean_table_gives_heading_and_drift_back(looped):
    made = simulated()

    loop = looped(made.columns)

    assert (names(loop), loop.unexplained) == ([], None)
    found = loop.augmented.parameters
    for name, expected in (("alpha0", made.platform.alpha0_deg), ("drift", made.platform.drift_deg_h)):
        assert abs(found[name].value - expected) < 3 * found[name].standard_uncertainty
    assert abs(loop.closure.value) < 3 * loop.closure.standard_uncertainty


def test_what_a_drift_wanders_by_has_no_mean_over_the_dwells(tmp_path):
    write(tmp_path / "table.csv", simulated().columns)
    table = declared_fit(read_gyrocompass_table(tmp_path / "table.csv")).table
    wandering = (table.memory.modes / np.sqrt(table.weights)[:, None])[table.rates, 1:]
    assert np.abs(wandering.mean(axis=0)).max() < 1e-12


@pytest.mark.parametrize(
    ("name", "size"),
    [
        ("backlash", 0.6),
        ("drift_temperature", 0.4),
        ("tilt_bias", 0.001),
        ("torquer_square", 6e-4),
        ("base_yaw", 1.5),
    ],
)
def test_an_effect_is_told_from_all_others(looped, name, size):
    (effect,) = looped(simulated(LEVEL, **{name: size}).columns).effects

    assert (effect.name, effect.also_possible) == (name, ())
    assert effect.coefficients[name].value == pytest.approx(size, rel=0.25)


def test_of_one_base_the_heading_is_withheld_between_scale_and_what_turns_with_the_base(looped):
    made = simulated(g_unbalance=1.5)

    loop = looped(made.columns)

    (effect,) = loop.effects
    assert {effect.name, *effect.also_possible} >= {"torquer_scale", "latitude", "g_unbalance", "tilt_scale"}
    alpha0 = loop.augmented.parameters["alpha0"]
    assert alpha0.value is None
    assert "does not tell apart" in alpha0.reason
    assert alpha0.given["g_unbalance"] == pytest.approx(made.platform.alpha0_deg, abs=1.0)
    assert document(loop)["augmented"]["parameters"]["alpha0"]["given"].keys() >= {"torquer_scale", "g_unbalance"}


def test_another_lean_parts_them_and_so_it_is_advised(looped):
    loop = asked_next(looped(simulated(g_unbalance=1.5).columns))

    assert any("lean" in experiment.why for experiment in loop.experiments)


def test_scale_and_latitude_are_never_told_apart(looped):
    loop = looped(simulated(Design(angles_deg=FOUR, passes=2, bases=3, lean_deg=3.0), latitude=0.5).columns)

    (effect,) = loop.effects
    assert {effect.name, *effect.also_possible} >= {"torquer_scale", "latitude"}
    assert "g_unbalance" not in effect.also_possible


def test_two_positions_leave_two_headings_and_a_third_is_advised(looped):
    made = simulated()
    two = {name: values[:2] for name, values in made.columns.items()}

    loop = asked_next(looped(two))

    alpha0 = loop.augmented.parameters["alpha0"]
    assert alpha0.value is None
    assert "several headings" in alpha0.reason
    assert len(loop.declared_fit.headings_deg) == 2
    assert min(abs(each - made.platform.alpha0_deg) for each in loop.declared_fit.headings_deg) < 0.5
    assert loop.experiments[0].programme == "0-120-240"


def test_one_position_is_refused(looped):
    with pytest.raises(ValueError, match="one position tells neither heading nor drift"):
        looped({name: values[:1] for name, values in simulated().columns.items()})


def test_three_positions_are_as_certain_as_the_samples_say(looped):
    three = {name: values[:3] for name, values in simulated().columns.items()}

    found = looped(three).augmented.parameters["drift"]

    assert 0.01 / np.sqrt(3) < found.standard_uncertainty < 0.03


def test_a_wrong_angle_is_a_misreading_and_set_aside(looped):
    columns = {name: values.copy() for name, values in simulated().columns.items()}
    columns["azimuth_deg"][7] -= 10.0

    loop = looped(columns)

    assert names(loop) == ["misreading"]
    assert document(loop)["effects"][0]["coefficients"] == {"rows": [8], "error_deg": [10.0]}
    assert [entry.row for entry in loop.observations.set_aside] == [8]


def test_a_disturbed_rate_is_set_aside_and_is_no_misreading(looped):
    columns = {name: values.copy() for name, values in simulated().columns.items()}
    columns["rate_deg_h"][7] += 1.0

    loop = looped(columns)

    assert names(loop) == []
    assert [entry.row for entry in loop.observations.set_aside] == [8]


def test_the_azimuth_channel_gives_the_drift_that_the_heading_wanders_with(looped):
    made = simulated(seed=4)
    latitude = np.deg2rad(made.platform.latitude_deg)
    tilt = np.deg2rad(made.columns["tilt_gamma_deg"])
    north = made.clean_deg_h - made.platform.drift_deg_h  # ωη sin α cos γ
    second = 15.041068 * np.sin(latitude) * np.cos(tilt) + north * np.tan(tilt) + 0.7

    loop = looped({**made.columns, "azimuth_rate_deg_h": second})

    assert loop.azimuth_drift.value_deg_h == pytest.approx(0.7, abs=1e-4)


def test_a_heading_that_an_azimuth_mark_contradicts_is_said(looped):
    made = simulated(LEVEL)
    marked = (made.platform.alpha0_deg + 1.0 + made.columns["azimuth_deg"] + 180.0) % 360.0 - 180.0

    check = looped({**made.columns, "reference_alpha_deg": marked}).mark

    assert check.difference_deg == pytest.approx(-1.0, abs=0.1)
    assert not check.agrees


def test_the_published_formula_comes_along_as_a_baseline(looped):
    made = simulated(LEVEL)

    baseline = looped(made.columns).baseline

    assert baseline.alpha0_deg == pytest.approx(made.platform.alpha0_deg, abs=0.3)
    assert len(baseline.azimuths_deg) == 3


def test_what_the_stand_adds_widens_the_uncertainty(looped):
    loop = looped(simulated().columns)

    stated = loop_at(loop, TurntableUncertainty(azimuth_deg=0.1, tilt_deg=1 / 6, latitude_deg=0.0), trials=500)

    assert stated.augmented.parameters["drift"].standard_uncertainty == pytest.approx(0.034, rel=0.35)
    assert stated.augmented.parameters["alpha0"].standard_uncertainty > 0.04
    assert [str(line.name) for line in stated.augmented_budget.lines] == [
        "scatter of the data",
        "reading of the pickoff",
        "bias of the tilt sensor",
        "explanations that fit nearly as well",
    ]
    simulated_u, _ = stated.augmented_budget.monte_carlo["alpha0"]
    assert simulated_u == pytest.approx(stated.augmented.parameters["alpha0"].standard_uncertainty, rel=0.12)


def test_angles_in_radians_are_asked_about(looped):
    columns = dict(simulated().columns)
    columns["azimuth_deg"] = np.round(np.deg2rad(columns["azimuth_deg"]), 6)

    loop = looped(columns)

    assert "radians" in loop.doubts[0]
    assert loop.augmented.parameters["alpha0"].value is None


def test_a_table_without_tilts_samples_or_times_is_fitted(tmp_path):
    made = simulated(Design(angles_deg=FOUR, passes=2, lean_deg=0.0))
    few = {name: made.columns[name] for name in ("azimuth_deg", "latitude_deg", "rate_deg_h")}
    write(tmp_path / "table.csv", few)

    found = declared_fit(read_gyrocompass_table(tmp_path / "table.csv")).model.parameters["alpha0"]

    assert abs(found.value - made.platform.alpha0_deg) < 4 * found.standard_uncertainty


@pytest.mark.parametrize("factor", [60.0, 1.0 / 60.0])
def test_rates_in_another_unit_are_asked_about(looped, factor):
    columns = dict(simulated().columns)
    columns["rate_deg_h"] = columns["rate_deg_h"] * factor

    loop = looped(columns)

    assert "times the earth rate at this latitude" in loop.doubts[0]
    assert loop.augmented.parameters["drift"].value is None
