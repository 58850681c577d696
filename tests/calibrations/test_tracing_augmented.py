"""What was found, seen in other rows of the same table."""

import numpy as np
import pytest
from tables import FLIPS, sweep, table

from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.effects.unnamed import STRUCTURES
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table, scene_of
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.quantified import form_in
from tumble.calibrations.tracing.trace import Tracer, found

MOUNTS = (*FLIPS, sweep("face-up"), sweep("face-down"))


@pytest.fixture(scope="module")
def tracer():
    return Tracer(dividing_head_table(fit_jointly(table(*MOUNTS)), CATALOGUE))


@pytest.mark.parametrize("name", [structure.name for structure in STRUCTURES if structure.depends_on == "angle"])
def test_a_shape_of_the_head_has_columns_in_a_table_with_a_setting_more(tracer, name):
    longer = table(*MOUNTS, ("sweep", "face-down", [123.4]))
    scene = scene_of(longer, tracer.table.joint.fit.theta)
    problem = tracer.problem(NoiseModel())
    numbers = [number for number, candidate in enumerate(tracer.offered) if candidate.effect.name == name]

    for number in numbers:
        columns = form_in(scene, found(problem, number)).columns
        assert columns.shape == (len(longer), tracer.offered[number].form.columns.shape[1])
        assert np.isfinite(columns).all()
