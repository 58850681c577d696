"""Coefficients of which something is known before a table is seen, and shapes of which something is not."""

import numpy as np
import pytest

from tumble.calibrations.core.compression import compress
from tumble.calibrations.tracing.candidates import candidates
from tumble.calibrations.tracing.declared import Linear
from tumble.calibrations.tracing.effect import Effect, Expected, plain, single
from tumble.calibrations.tracing.linear import fit_linear
from tumble.calibrations.tracing.noise import Memory, NoiseModel
from tumble.calibrations.tracing.table import Table
from tumble.calibrations.tracing.trace import Found, Trace

X = np.linspace(-1.0, 1.0, 9)
BASIS = np.column_stack([np.ones(9), X])
OUTPUT = 2.0 + 0.5 * X + 0.1 * np.resize([1.0, -1.0, 0.0], 9)
SQUARE = X**2


def test_what_is_known_of_a_coefficient_is_one_row_more():
    known = compress(BASIS, OUTPUT, np.ones(9)).knowing(1, 0.8, 2.0)
    more = compress(np.vstack([BASIS, [0.0, 2.0]]), np.append(OUTPUT, 1.6), np.ones(10))

    assert np.linalg.solve(known.r, known.z) == pytest.approx(np.linalg.solve(more.r, more.z))
    assert known.rest_v2 == pytest.approx(more.rest_v2)


def test_errors_of_rows_do_the_same_with_it():
    error = np.resize([1.0, -0.5], 9)
    known = compress(BASIS, OUTPUT, np.ones(9)).knowing(1, 0.8, 2.0)
    moved = compress(BASIS, OUTPUT + error, np.ones(9)).knowing(1, 0.8, 2.0)
    shift = np.linalg.solve(known.r, known.rotation.T @ error)

    assert np.linalg.solve(moved.r, moved.z) - np.linalg.solve(known.r, known.z) == pytest.approx(shift)


class Scene:
    rows, hours = 9, None


def fitted(expected=None, unknown=None):
    effect = Effect(
        name="curved", belongs_to="unit", symbol="", source="", forms=lambda _: single(SQUARE),
        report=plain("curved", ""), expected=expected, unknown=unknown,
    )  # fmt: skip
    table = Table(
        model=Linear(functions=BASIS), output=OUTPUT + 0.3 * SQUARE, unit="V", weights=np.ones(9), scene=Scene(),
        effects=(effect,), structures=(), memory=Memory(modes=np.empty((9, 0))),
    )  # fmt: skip
    (candidate,) = candidates(table)
    found = Found(candidate=candidate, form=candidate.form, number=0)
    trace = Trace(found=(found,), noise=NoiseModel(), deviance=0.0)
    return fit_linear(table, trace, {"a": "V", "b": "V"})


def test_a_coefficient_is_drawn_to_what_is_expected_of_it():
    free = fitted()
    sure, unsure = (fitted(Expected(value=1.0, standard_deviation=u)) for u in (1e-6, 1e6))

    assert sure.coefficients == pytest.approx([1.0])
    assert unsure.coefficients == pytest.approx(free.coefficients)


def test_what_is_expected_makes_it_better_known():
    free, drawn = fitted(), fitted(Expected(value=0.3, standard_deviation=0.01))

    assert drawn.covariance[0, 0] < 0.1 * free.covariance[0, 0]


def test_what_is_not_known_of_a_shape_widens_the_parameters():
    free, unsure = fitted(), fitted(unknown=lambda scene: np.ones((scene.rows, 1)))
    size = free.coefficients[0]

    more = unsure.parameters["a"].standard_uncertainty ** 2 - free.parameters["a"].standard_uncertainty ** 2
    assert more == pytest.approx(size**2)
    assert unsure.parameters["b"].standard_uncertainty == pytest.approx(free.parameters["b"].standard_uncertainty)
