"""To be used are the values with what was found, whether that has a name or not."""

import pytest

from tumble.calibrations.core.verdict import Model
from tumble.calibrations.records.entry import loop_entry

COURSE = {"depends_on": "angle", "description": "a wave"}
EFFECT = {"name": "hysteresis"}


@pytest.mark.parametrize(
    ("effects", "unexplained", "used"),
    [
        ([], None, Model.DECLARED),
        ([EFFECT], None, Model.AUGMENTED),
        ([], COURSE, Model.AUGMENTED),
        ([EFFECT], COURSE, Model.AUGMENTED),
    ],
)
def test_the_values_to_use_take_everything_found_into_account(effects, unexplained, used):
    fitted = {"parameters": {}}
    result = {"declared": fitted, "augmented": fitted, "effects": effects, "unexplained": unexplained}
    assert loop_entry("triad", 1, result).verdict.judged is used
