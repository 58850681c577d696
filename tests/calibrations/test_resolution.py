import numpy as np
import pytest

from tumble.calibrations.core.resolution import as_written, last_digit
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.table import read_table

ANGLES = np.arange(0.0, 405.0, 5.0)
FUNCTIONS = np.column_stack([np.ones(81), np.sin(np.radians(ANGLES)), np.cos(np.radians(ANGLES))])


@pytest.mark.parametrize(
    ("values", "digit"),
    [([0.25, -1.5, 3.0], 0.01), ([0.1 + 0.2, 0.7], 0.1), ([1200.0, 500.0], 100.0), ([1.000001, 0.5], 1e-6)],
)
def test_the_last_digit_is_the_step_in_which_values_are_written(values, digit):
    assert last_digit(np.array(values)) == pytest.approx(digit)


def test_values_with_all_their_digits_are_written_to_what_a_double_tells_apart():
    assert last_digit(np.array([1 / 3, 2 / 7])) < 1e-14


def test_of_zeros_alone_nobody_knows_the_last_digit_and_it_is_the_smallest_that_there_is():
    assert last_digit(np.zeros(3)) == pytest.approx(1e-18)


@pytest.mark.parametrize("digits", [1, 3, 6, 9])
def test_a_rounded_output_is_given_as_written(digits):
    assert as_written(FUNCTIONS, np.round(FUNCTIONS @ [0.01, 5.0, 0.2], digits))


def test_an_output_that_bends_by_more_than_its_last_digit_is_not():
    bent = FUNCTIONS @ [0.01, 5.0, 0.2] + 2e-3 * np.sin(np.radians(3 * ANGLES))
    assert not as_written(FUNCTIONS, np.round(bent, 3))


def test_noise_of_one_digit_is_not():
    noise = np.random.default_rng(20261128).normal(0.0, 1e-3, 81)
    assert not as_written(FUNCTIONS, np.round(FUNCTIONS @ [0.01, 5.0, 0.2] + noise, 3))


@pytest.mark.parametrize("digits", [3, 9, 17])
def test_what_the_last_digit_rounds_off_is_traced_to_nothing_and_decides_no_uncertainty_by_its_repeats(
    tmp_path, digits
):
    volts = FUNCTIONS @ [0.01, 0.5, 0.002]
    rows = [f"{ANGLES[row % 81]},{volts[row % 81]:.{digits}f},{row // 81 + 1},{20 * row}" for row in range(243)]
    path = tmp_path / "rounded.csv"
    path.write_text("\n".join(["angle_deg,voltage_V,realisation,time_s", *rows, ""]), "utf-8")
    loop = close_loop(read_table(path))
    assert (loop.effects, loop.unexplained) == ((), None)
    assert "to the last digit written" in loop.not_traced
    assert loop.declared.lack_of_fit_p is None
    assert loop.declared.noise.used_degrees_of_freedom < 81
