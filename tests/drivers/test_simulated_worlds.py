"""A stand file says which simulated world it has."""

import pytest

from tumble.drivers.simulated import Simulated, build
from tumble.drivers.simulated.worlds import axis_of, find_world


def test_a_table_without_a_world_is_of_the_head():
    assert find_world(Simulated().world).table is Simulated


def test_an_unknown_world_is_refused_with_those_that_are_known():
    with pytest.raises(ValueError, match=r"no simulated world is called 'moon'; known are .*head"):
        find_world("moon")


def test_an_axis_that_the_world_lacks_is_refused_with_those_that_it_has():
    world = build(Simulated()).world
    with pytest.raises(ValueError, match="has no positioner outer; it has head"):
        axis_of(world.positioners, "outer")
