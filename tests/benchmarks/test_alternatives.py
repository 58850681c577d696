import numpy as np
import pytest

from benchmarks.alternatives.columns import Block, Regression, problem
from benchmarks.alternatives.comparison import NO_COLUMN, OURS, Outcome, by_columns, held_out, report, sample
from benchmarks.alternatives.grading import aliases_of, exact_by_name, exact_up_to_aliases
from benchmarks.alternatives.stepwise import stepwise
from benchmarks.bank import DEVELOPMENT, Spec, make_table
from tumble.calibrations.tracing.findings import EffectFound, Unexplained


@pytest.fixture(scope="module")
def with_k_xx():
    """A table with one effect."""
    return problem(make_table(Spec(design="bf", effects=(("k_xx", 20.0),)), 21).observations)


@pytest.fixture(scope="module")
def k_xx(with_k_xx):
    return with_k_xx.regression()


def made_of(target, **columns):
    """A regression on one orthonormal column for each name."""
    return Regression(
        columns=np.column_stack(list(columns.values())),
        target=np.asarray(target, dtype=float),
        blocks=tuple(
            Block(name=name, members=np.array([number]), coefficients=1) for number, name in enumerate(columns)
        ),
        owners=tuple(columns),
        kept=np.arange(len(columns)),
    )


@pytest.mark.parametrize(
    ("there", "names", "exact"),
    [
        ((), (), True),
        (("k_xx",), ("k_xx",), True),
        (("k_xx", "backlash"), ("backlash", "k_xx"), True),
        (("k_xx",), (), False),
        (("k_xx",), ("k_yy",), False),
        (("k_xx",), ("k_xx", "backlash"), False),
        ((), ("k_xx",), False),
    ],
)
def test_only_just_the_right_names_are_exact(there, names, exact):
    assert exact_by_name(there, names) is exact


def test_structure_without_a_name_where_there_is_none_is_not_exact():
    assert not exact_by_name(("k_xx",), ("k_xx",), Unexplained(depends_on="angle", description=""))


def test_an_alias_stands_for_the_effect_but_for_one_only():
    found = EffectFound(name="k_xx", also_possible=("k_yy",), belongs_to="unit", coefficients={}, p_value=0.0)
    aliases = aliases_of([found])
    assert exact_up_to_aliases(("k_xx",), ("k_yy",), aliases)
    assert not exact_up_to_aliases(("k_xx",), ("k_xx", "k_yy"), aliases)
    assert not exact_up_to_aliases(("k_xx",), ("backlash",), aliases)


def test_what_the_declared_model_absorbs_is_in_no_column(k_xx):
    np.testing.assert_allclose(np.linalg.norm(k_xx.columns, axis=0), 1.0)
    np.testing.assert_allclose(k_xx.columns.sum(axis=0), 0.0, atol=1e-9)
    assert k_xx.target.sum() == pytest.approx(0.0, abs=1e-9)


def test_no_two_columns_are_the_same(k_xx):
    cosines = np.abs(k_xx.columns.T @ k_xx.columns) - np.eye(k_xx.columns.shape[1])
    assert cosines.max() < 1.0 - 1e-9


def test_forward_selection_finds_the_effect_of_a_table(k_xx):
    assert "k_xx" in k_xx.names(stepwise(k_xx))


@pytest.mark.parametrize(("size", "names"), [(2.6, ()), (2.7, ("first",))])
def test_a_column_enters_where_bic_falls(size, names):
    # 1000 ln(1 + size²/999) against ln 1000 = 6.908: the least size that pays is 2.633
    first, other, rest = np.eye(1000)[:3]
    target = size * first + np.sqrt(999.0) * rest
    made = made_of(target, first=first, other=other)
    assert made.names(stepwise(made)) == names


def test_what_is_chosen_among_some_rows_predicts_the_others(with_k_xx):
    answer = by_columns(stepwise)(with_k_xx)

    assert "acceleration" in answer.variables
    assert answer.held_out < 1.0


def test_nothing_chosen_predicts_as_the_declared_model_does(with_k_xx):
    nothing = by_columns(lambda regression: np.zeros(len(regression.owners), dtype=bool))(with_k_xx)

    assert (nothing.names, nothing.variables) == ((), frozenset())
    assert nothing.held_out == pytest.approx(1.0)


def test_what_is_known_of_rows_held_out_leaves_no_error(with_k_xx):
    assert held_out(with_k_xx, lambda out: np.zeros(np.count_nonzero(out))) == 0.0


def test_no_table_of_the_sample_holds_what_a_regression_has_no_column_for():
    lists = sample(DEVELOPMENT, 5)
    assert {name: len(wanted) for name, wanted in lists.items()} == {"singles": 5, "pairs": 5, "clean": 5}
    everything = sample(DEVELOPMENT, 10_000)["pairs"]
    assert not NO_COLUMN & {name for spec, _ in everything for name, _ in spec.effects}


def test_every_method_is_a_line_of_the_report():
    of_one = {"up_to_aliases": True, "seconds": 1.5, "right_variable": True, "held_out": 0.5}
    outcomes = [
        Outcome(list_name="singles", method=OURS, by_name=True, anything=True, **of_one),
        Outcome(list_name="clean", method=OURS, by_name=True, anything=False, **of_one),
        Outcome(list_name="singles", method="guess", by_name=False, anything=True, **of_one),
    ]
    ours, guess = report(outcomes).splitlines()[-2:]
    assert ours == "| close_loop | 100.00 % | 100.00 % | – | – | 0.00 % | – | 0.50 (0.50) | – | 1.50 s |"
    assert guess == "| guess | 0.00 % | 100.00 % | – | – | – | – | 0.50 (0.50) | – | 1.50 s |"
