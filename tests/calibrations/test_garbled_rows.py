"""One garbled number in one row moves no parameter, wherever the row stands: the row, or the value, is left out."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tables import FLIPS, sweep, table

from tumble.calibrations.methods.dividing_head.analysis import analyse
from tumble.calibrations.methods.dividing_head.screening import set_aside_bad_rows

ROWS = {"x flip": 0, "y flip": 3, "z flip": 5, "sweep": 40}


def rows():
    """Flips and a sweep in three realisations, with scatter and temperatures."""
    made = table(*FLIPS, sweep("face-up"), realisations=3)
    return replace(
        made,
        voltage_sd_v=np.full(len(made), 1e-3),
        temperature_degc=np.linspace(22.9, 23.1, len(made)),
    )


@cache
def whole():
    return analyse(rows(), trials=0)


@pytest.mark.parametrize("garbled", [-25.0, 7.0, 99.0, 1e4, 1e6, -1e12, 1e22, 1e300])
@pytest.mark.parametrize("place", ROWS.values(), ids=ROWS)
@pytest.mark.parametrize("column", ["voltage_v", "angle_deg", "voltage_sd_v", "temperature_degc"])
def test_parameters_stay_where_one_number_is_garbled(column, place, garbled):
    made = rows()
    values = getattr(made, column).copy()
    values[place] = garbled

    result = analyse(set_aside_bad_rows(replace(made, **{column: values})), trials=0)

    for name, parameter in whole().parameters.items():
        if parameter.value is not None:
            assert result.parameters[name].value == pytest.approx(
                parameter.value, abs=3 * parameter.standard_uncertainty
            ), name
