"""What predicts rows that were held out no better than the declared model is said to describe only."""

from dataclasses import replace
from functools import cache

import pytest
from loop_examples import k_xx_table

from tumble.calibrations.methods.dividing_head.loop.loop import explain
from tumble.calibrations.methods.dividing_head.loop.predicting import with_held_out

SENTENCE = "describes these rows only"


@cache
def closed():
    return explain(k_xx_table())


def warnings(before_v):
    """What is said where the declared model predicts rows held out with this error."""
    loop, explained = closed()
    declared = replace(loop.declared, held_out_rms_v=before_v)
    return with_held_out(loop.augmented, declared, explained.tracer, explained.trace, explained.table).warnings


@pytest.mark.parametrize(("before_v", "described_only"), [(1e-6, True), (1e-2, False), (None, False)])
def test_it_is_said_where_the_declared_model_predicts_no_worse(before_v, described_only):
    assert any(SENTENCE in warning for warning in warnings(before_v)) is described_only


def test_an_effect_that_predicts_is_said_to_be_no_more_than_that():
    loop, _ = closed()

    assert not any(SENTENCE in warning for warning in loop.augmented.warnings)
    assert loop.augmented.held_out_rms_v < loop.declared.held_out_rms_v
