"""An adopted effect in later runs: sought like any other, and contradicted where it does not hold."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from adopted_examples import BUMP, PLACES, effect
from tables import FLIPS, UNIT, gravity_on, table

from tumble.calibrations.adopted.contradicting import contradictions
from tumble.calibrations.adopted.knots import Knots
from tumble.calibrations.adopted.offered import axis_of, offered
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.adopting import ADOPTING
from tumble.calibrations.methods.dividing_head.loop.loop import explain
from tumble.calibrations.methods.dividing_head.loop.sections import sections
from tumble.calibrations.methods.dividing_head.report.abscissa import BY_VARIABLE
from tumble.calibrations.methods.dividing_head.report.traces import abscissae

_SWEEP_DEG = tuple(range(0, 360, 10))
PARTS = (*FLIPS, ("sweep", "face-up", _SWEEP_DEG), ("sweep", "face-down", _SWEEP_DEG))


def bump(size):
    """1 mV near 0.3 g, so many times."""
    return lambda mount, angle_deg: 1e-3 * size * np.interp(gravity_on(mount, angle_deg + 0.1121)[0], PLACES, BUMP)


def with_another_bump(mount, angle_deg):
    away = (gravity_on(mount, angle_deg + 0.1121)[0] + 0.4) / 0.15
    return bump(1.0)(mount, angle_deg) + 6e-4 * np.exp(-0.5 * away**2)


@cache
def traced(added, uncertainty=0.01):
    """The loop closed on a table of 234 rows with the effect in its catalogue."""
    rows = table(*PARTS, realisations=3, extra_v=added)
    adopted = offered(effect(uncertainty=uncertainty), ADOPTING)
    return explain(rows, effects=(*CATALOGUE, adopted))


LIKE_THE_OTHERS, WITHOUT, THREE_TIMES = bump(1.1), bump(0.0), bump(3.0)


def against(added):
    return [str(each) for each in contradictions(traced(added)[1], effect())]


def test_it_is_found_by_its_name_with_its_size():
    loop, _ = traced(LIKE_THE_OTHERS)
    (found,) = loop.effects

    assert (found.name, found.belongs_to, found.also_possible) == ("odd_bump", "unit", ())
    assert found.coefficients["size"].value == pytest.approx(1.1, abs=0.05)
    assert loop.unexplained is None


def test_what_is_shown_of_a_loop_names_it():
    assert any("odd_bump" in line for section in sections(traced(LIKE_THE_OTHERS)[0]) for line in section.lines)


def test_the_residual_is_drawn_against_what_it_depends_on():
    ((abscissa, names),) = abscissae(traced(LIKE_THE_OTHERS)[0]).items()

    assert (abscissa, names) == (BY_VARIABLE["acceleration"], ["odd_bump"])


def test_parameters_are_right_beside_it():
    for name, parameter in traced(LIKE_THE_OTHERS)[0].augmented.parameters.items():
        low, high = parameter.interval_95
        assert low <= UNIT[name] <= high


def test_what_is_not_known_of_its_course_widens_the_parameters():
    sure, unsure = (traced(LIKE_THE_OTHERS, u)[0].augmented.parameters for u in (0.01, 0.2))

    assert unsure["u0"].standard_uncertainty > 3.0 * sure["u0"].standard_uncertainty


def test_its_course_is_a_source_of_the_budget():
    lines = {str(line.name): line for line in traced(LIKE_THE_OTHERS, 0.2)[0].augmented.budget}

    assert lines["course of odd_bump"].contributions["u0"] > 1e-5


def test_a_unit_like_the_others_says_nothing_against_it():
    assert against(LIKE_THE_OTHERS) == []


def test_a_unit_without_it_contradicts_it():
    (said,) = against(WITHOUT)

    assert said.startswith("it is not there: its size is ")
    assert traced(WITHOUT)[0].effects == ()


def test_a_size_that_no_unit_has_contradicts_it():
    (said,) = against(THREE_TIMES)

    assert said.startswith("its size is 2.9") or said.startswith("its size is 3.0")


def test_another_course_contradicts_it():
    assert against(with_another_bump) == ["it has another course: structure is left that follows ax"]


def test_it_is_not_sought_where_its_course_is_not_known():
    _, explained = traced(LIKE_THE_OTHERS)
    near_zero = effect()
    knots = Knots(places=0.5 * PLACES[:, None])
    near_zero = replace(near_zero, curve=replace(near_zero.curve, knots=knots))

    assert axis_of(near_zero, explained.table.axes) is None
    assert offered(near_zero, ADOPTING).forms(explained.table.scene) == ()


def test_of_one_unit_only_its_absence_contradicts_it():
    one = effect(spread=None, units=1)

    assert list(contradictions(traced(THREE_TIMES)[1], one)) == []
    assert len(list(contradictions(traced(WITHOUT)[1], one))) == 1
