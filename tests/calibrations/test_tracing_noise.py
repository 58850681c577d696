"""Noise that remembers, and what is not to be mistaken for it."""

from dataclasses import replace

import numpy as np
import pytest
from tables import FLIPS, sweep, table

from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.tracing.fitting_noise import golden_section
from tumble.calibrations.tracing.noise import Memory, NoiseModel, slow_modes

MOUNTS = (*FLIPS, sweep("face-up"), sweep("face-down"))


@pytest.fixture(scope="module")
def quiet():
    rows = table(*MOUNTS, seed=7)
    return replace(rows, time_s=2.5 * np.arange(len(rows)))


def walked(rows, seed, pull=0.0):
    """A bias that wanders by 30 µV a dwell, pulled back to its mean or not."""
    steps = 3e-5 * np.random.default_rng(seed).normal(size=len(rows))
    bias = np.zeros(len(rows))
    for row in range(1, len(rows)):
        bias[row] = (1.0 - pull) * bias[row - 1] + steps[row]
    return replace(rows, voltage_v=rows.voltage_v + bias - bias.mean())


def test_a_wandering_bias_is_called_a_random_walk(quiet):
    loop = close_loop(walked(quiet, seed=3))

    assert [effect.name for effect in loop.effects] == ["bias_random_walk"]
    assert loop.unexplained is None


def test_what_is_known_of_the_wandering_is_taken_off_the_residual(quiet):
    loop = close_loop(walked(quiet, seed=3))

    assert loop.augmented.residual_rms_v < 1.1e-4 < 0.5 * loop.declared.residual_rms_v


def test_whitening_makes_the_noise_it_is_made_for_white(quiet):
    memory = dividing_head_table(fit_jointly(quiet), CATALOGUE).memory
    noise = NoiseModel(walk=2.0)
    order = np.arange(1, memory.modes.shape[1])
    variances = np.concatenate([[0.0], 2.0 / order**2])
    covariance = np.eye(len(quiet)) + (memory.modes * variances) @ memory.modes.T
    white = memory.whitening(noise)

    assert np.allclose(white(white(covariance)), np.eye(len(quiet)), atol=1e-8)
    assert white.log_determinant == pytest.approx(np.linalg.slogdet(covariance)[1])


def test_flicker_leaves_a_mean_that_no_run_can_see(quiet):
    memory = dividing_head_table(fit_jointly(quiet), CATALOGUE).memory
    ones = np.ones(len(quiet))

    assert ones @ memory.whitening(NoiseModel(flicker=0.05))(ones) < 0.5 * len(quiet)
    assert ones @ memory.whitening(NoiseModel(walk=0.05))(ones) > 0.9 * len(quiet)


def test_levels_that_were_drawn_are_stated_as_they_happened_and_taken_off_the_residual(quiet):
    """Biases of 0.3, -0.2, 0.4, -0.6 and 0.1 mV, one for each realisation: their standard deviation is 0.406 mV."""
    jumps = np.array([3e-4, -2e-4, 4e-4, -6e-4, 1e-4])[quiet.realisation - 1]
    loop = close_loop(replace(quiet, voltage_v=quiet.voltage_v + jumps))

    (effect,) = loop.effects
    size = effect.coefficients["realisation_bias"]
    assert effect.name == "realisation_bias"
    assert abs(size.value - 4.06e-4) < 3 * size.standard_uncertainty < 3e-5
    assert loop.augmented.residual_rms_v < 1.1e-4 < 0.5 * loop.declared.residual_rms_v


def test_a_minimum_is_found_with_one_value_a_step():
    asked = []

    def valley(place):
        asked.append(place)
        return (place - 0.3) ** 2

    assert golden_section(valley, -1.0, 2.0, steps=30) == pytest.approx(0.3, abs=1e-6)
    assert len(asked) == 31


def test_a_memory_that_grew_whitens_as_one_made_at_once() -> None:
    hours, weights = np.linspace(0.0, 8.0, 60), np.ones(60)
    modes = slow_modes(hours, weights)
    even = (np.arange(60)[:, None] % 4 == np.arange(4)).astype(float)  # they add up to the constant of the modes
    at_once = Memory(modes=modes, levels={"even": even, "half": even[:, :2] + modes[:, :2]})
    grew = Memory(modes=modes).with_levels({"even": even}).with_levels({"half": even[:, :2] + modes[:, :2]})
    noise = NoiseModel(flicker=0.1, levels=(("even", 2.0), ("half", 0.5)))
    output = np.sin(hours**2)
    assert grew.whitening(noise)(output) == pytest.approx(at_once.whitening(noise)(output))
    assert grew.whitening(noise).log_determinant == pytest.approx(at_once.whitening(noise).log_determinant)


def test_turned_columns_keep_their_lengths_and_angles_when_they_are_made_white() -> None:
    hours = np.linspace(0.0, 8.0, 60)
    memory, noise = Memory(modes=slow_modes(hours, np.ones(60))), NoiseModel(walk=0.3)
    columns, white = np.column_stack([np.sin(hours), hours**2]), memory.whitening(noise)
    turned = white.turned(memory.turned(columns))
    assert turned.T @ turned == pytest.approx(white(columns).T @ white(columns))


def test_what_a_noise_does_not_draw_is_not_needed_for_it() -> None:
    hours, levels = np.linspace(0.0, 8.0, 60), {"half": np.eye(60)[:, :2], "other": np.eye(60)[:, 3:5]}
    memory, noise = Memory(modes=slow_modes(hours, np.ones(60)), levels=levels), NoiseModel(levels=(("half", 2.0),))
    assert memory.within(noise).size == 2
    assert memory.within(noise).whitening(noise)(hours) == pytest.approx(memory.whitening(noise)(hours))


@pytest.mark.parametrize(
    "noise", [NoiseModel(), NoiseModel(levels=(("half", 0.0),))], ids=["white", "levels of nothing"]
)
def test_a_noise_without_variance_is_white(noise) -> None:
    hours = np.linspace(0.0, 8.0, 60)
    memory = Memory(modes=slow_modes(hours, np.ones(60)), levels={"half": np.eye(60)[:, :2]})
    assert memory.whitening(noise)(hours) == pytest.approx(hours)
