import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.calibrations.core.rows import SetAside
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.screening import set_aside_bad_rows


def table(**columns):
    length = len(next(iter(columns.values())))
    arrays = {name: np.array(column) for name, column in columns.items()}
    return Observations(**{"row": np.arange(1, length + 1), "angle_deg": np.zeros(length), **arrays})


def test_good_rows_stay_as_they_are():
    good = table(angle_deg=[0.0, 395.0], voltage_v=[2.5, -2.5])

    screened = set_aside_bad_rows(good)

    assert screened.row.tolist() == [1, 2]
    assert screened.set_aside == ()


@pytest.mark.parametrize(
    ("voltage_v", "reason"),
    [
        (np.nan, "voltage_v is nan"),
        (np.inf, "voltage_v is inf"),
        (9.9e37, "overload: voltage_v is 9.9e+37"),
        (-1.1e30, "overload: voltage_v is -1.1e+30"),
    ],
)
def test_a_row_without_a_voltage_is_set_aside(voltage_v, reason):
    screened = set_aside_bad_rows(table(voltage_v=[1.0, voltage_v, 3.0]))

    assert screened.voltage_v.tolist() == [1.0, 3.0]
    assert screened.set_aside == (SetAside(row=2, reason=reason),)


@pytest.mark.parametrize("column", ["angle_deg", "reference_deg", "velocity_deg_s", "time_s"])
def test_a_row_without_a_number_that_it_needs_is_set_aside(column):
    screened = set_aside_bad_rows(table(**{column: [np.nan, 1.0]}))

    assert screened.set_aside == (SetAside(row=1, reason=f"{column} is nan"),)
    assert len(screened) == 1


def test_a_row_is_listed_once_with_its_first_fault():
    screened = set_aside_bad_rows(table(angle_deg=[np.nan, 0.0], voltage_v=[np.nan, 1.0]))

    assert screened.set_aside == (SetAside(row=1, reason="angle_deg is nan"),)


def test_a_missing_temperature_or_scatter_leaves_the_row():
    screened = set_aside_bad_rows(table(voltage_v=[1.0], temperature_degc=[np.nan], voltage_sd_v=[np.nan]))

    assert len(screened) == 1


def test_a_large_number_that_is_no_voltage_is_no_overload():
    assert len(set_aside_bad_rows(table(time_s=[1e31]))) == 1


@given(st.lists(st.floats(), min_size=1, max_size=20))
def test_every_row_is_either_used_or_set_aside(voltage_v):
    screened = set_aside_bad_rows(table(voltage_v=voltage_v))

    assert sorted([*screened.row.tolist(), *(entry.row for entry in screened.set_aside)]) == [
        *range(1, len(voltage_v) + 1)
    ]
    assert np.all(np.abs(screened.voltage_v) <= 1e30)


@pytest.mark.parametrize("angle_deg", [1e22, -1e7, 1e300])
def test_an_angle_beyond_any_head_is_set_aside(angle_deg):
    screened = set_aside_bad_rows(table(angle_deg=[0.0, angle_deg, 395.0], voltage_v=[1.0, 1.0, 1.0]))

    assert screened.set_aside == (SetAside(row=2, reason=f"angle_deg is {angle_deg:g}, beyond any head"),)


@pytest.mark.parametrize("voltage_v", [101.0, -1e6, 1e12])
def test_a_voltage_beyond_any_accelerometer_is_a_gross_error_wherever_the_row_stands(voltage_v):
    screened = set_aside_bad_rows(table(voltage_v=[1.0, voltage_v, 3.0]))

    reason = f"gross error: voltage_V is {voltage_v:g}, beyond any accelerometer"
    assert screened.set_aside == (SetAside(row=2, reason=reason, gross=True),)


def test_a_table_whose_voltages_are_all_large_is_in_another_unit_and_stays_whole():
    assert len(set_aside_bad_rows(table(voltage_v=[2500.0, 1500.0, 3500.0]))) == 3


def test_a_temperature_that_no_sensor_reads_is_left_out_and_told():
    screened = set_aside_bad_rows(table(voltage_v=[1.0, 2.0, 3.0], temperature_degc=[22.0, 9999.0, 22.1]))

    assert np.isnan(screened.temperature_degc[1])
    assert screened.warnings == (": temperature_degC is 9999 in row 2; used without it",)


@pytest.mark.parametrize("scatter_v", [-1e-3, 1e12])
def test_a_scatter_that_is_none_is_left_out_and_told(scatter_v):
    screened = set_aside_bad_rows(table(voltage_v=[1.0, 2.0], voltage_sd_v=[1e-3, scatter_v]))

    assert np.isnan(screened.voltage_sd_v[1])
    assert f"voltage_sd_V is {scatter_v:g} in row 2" in screened.warnings[0]


@pytest.mark.parametrize("place", [0, 1, 7, 18, 19])
@pytest.mark.parametrize("garbled", [0.0, 2.41, 76.1])
def test_a_single_temperature_far_from_its_neighbours_is_left_out_wherever_the_row_stands(place, garbled):
    temperature_degc = np.linspace(24.0, 24.2, 20)
    temperature_degc[place] = garbled

    screened = set_aside_bad_rows(table(voltage_v=np.ones(20), temperature_degc=temperature_degc))

    assert np.flatnonzero(np.isnan(screened.temperature_degc)).tolist() == [place]
    assert f"temperature_degC is {garbled:g} in row {place + 1}" in screened.warnings[0]


@pytest.mark.parametrize(
    "temperature_degc",
    [np.repeat([20.0, 60.0], 10), np.tile([20.0, 60.0], 10), np.linspace(-40.0, 85.0, 20), np.full(20, 23.0)],
    ids=["step", "to and fro", "ramp", "constant"],
)
def test_temperatures_of_a_chamber_stay(temperature_degc):
    screened = set_aside_bad_rows(table(voltage_v=np.ones(20), temperature_degc=temperature_degc))

    assert (np.isnan(screened.temperature_degc).sum(), screened.warnings) == (0, ())
