"""Least squares by the fast way, and by the certain way where columns depend on each other."""

import numpy as np
import pytest

from tumble.calibrations.core.solutions import (
    least_solution,
    left_beside,
    pseudo_inverse,
    quick_pseudo_inverse,
)

INDEPENDENT = np.array([[1.0, 2.0, 0.0], [0.0, 1.0, 3.0], [2.0, 0.0, 1.0], [1.0, 1.0, 1.0]])
DEPENDENT = np.column_stack([INDEPENDENT[:, 0], 2.0 * INDEPENDENT[:, 0], INDEPENDENT[:, 2]])
RIGHT = np.array([1.0, -2.0, 0.5, 3.0])


BOTH = pytest.mark.parametrize("inverted", [pseudo_inverse, quick_pseudo_inverse])
"""The way whose figures are stated, and the quick one."""


@BOTH
@pytest.mark.parametrize("scale", [1.0, 1e-6])
def test_independent_columns_of_any_unit_are_inverted(inverted, scale: float) -> None:
    matrices = np.stack([INDEPENDENT, INDEPENDENT[::-1]]) * [1.0, scale, 1.0]
    inverse, determined = inverted(matrices)
    assert inverse @ matrices == pytest.approx(np.stack([np.eye(3)] * 2), abs=1e-9)
    assert determined.all()


@BOTH
def test_columns_that_are_nearly_alike_are_told_apart_as_long_as_rounding_allows(inverted) -> None:
    near = INDEPENDENT[:, [0, 0, 2]] + 1e-6 * INDEPENDENT[:, [1, 2, 1]]
    inverse, determined = inverted(near)
    assert inverse @ near == pytest.approx(np.eye(3), abs=1e-8)
    assert determined.all()


@BOTH
def test_of_dependent_columns_neither_is_determined(inverted) -> None:
    inverse, determined = inverted(DEPENDENT)
    assert determined.tolist() == [False, False, True]
    assert DEPENDENT @ inverse @ DEPENDENT == pytest.approx(DEPENDENT)


@pytest.mark.parametrize("matrix", [INDEPENDENT, DEPENDENT, INDEPENDENT[:2]])
def test_a_solution_is_the_smallest_of_the_best(matrix: np.ndarray) -> None:
    right = RIGHT[: len(matrix)]
    assert least_solution(matrix, right) == pytest.approx(np.linalg.pinv(matrix) @ right)


@pytest.mark.parametrize("matrix", [INDEPENDENT[:, :2], DEPENDENT[:, :2]])
def test_beside_columns_only_what_is_orthogonal_to_them_is_left(matrix: np.ndarray) -> None:
    columns = np.column_stack([RIGHT, INDEPENDENT[:, 2]])
    left = columns - matrix @ np.linalg.pinv(matrix) @ columns
    seen = left_beside(matrix, columns)
    assert seen.T @ seen == pytest.approx(left.T @ left)
