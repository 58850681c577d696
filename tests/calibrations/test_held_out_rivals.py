"""Which other sets of candidates rows do not refute, when they are to predict rows that are held out."""

from types import SimpleNamespace

import numpy as np
import pytest

from tumble.calibrations.tracing.held_out import _swapped

NAMES = ("graduation", "graduation", "graduation", "backlash", "settling", "k_xx")


class Offered:
    """Six candidates with what each would gain in the place of any other."""

    def __init__(self, gains):
        self._gains = np.array(gains, dtype=float)
        self.offered = [SimpleNamespace(effect=SimpleNamespace(name=name)) for name in NAMES]
        self.penalties = np.full(len(NAMES), 10.0)
        self.forms = {"graduation": slice(0, 3), "backlash": slice(3, 4), "settling": slice(4, 5), "k_xx": slice(5, 6)}

    def explain(self, chosen):
        return chosen

    def gains(self, explanation):
        return self._gains

    def best_forms(self, worth):
        return [int(np.argmax(worth[:3])), 3, 4, 5]


@pytest.mark.parametrize(
    ("gains", "chosen", "others"),
    [
        ((0, 0, 0, 100, 97, 80), (3,), [(4,)]),  # play, or a part of the dwell before
        ((100, 99, 40, 0, 0, 0), (0,), [(1,)]),  # two orders that few angles do not part
        ((100, 60, 40, 0, 0, 0), (0,), []),
        ((100, 99, 40, 50, 0, 47), (0, 3), [(3, 1), (0, 5)]),
    ],
)
def test_what_explains_nearly_as_much_is_put_in_the_place_of_what_was_chosen(gains, chosen, others):
    assert list(_swapped(Offered(gains), chosen)) == others
