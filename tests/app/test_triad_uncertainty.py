"""What the stand file of two axes says of the uncertainty of a triad."""

import pytest

from tumble.app.methods.triad.uncertainty import TwoAxisStand

AXIS = {"driver": "simulated", "limits_deg": [-190.0, 190.0], "accuracy_arcsec": 2.0}
METER = {"driver": "scpi", "gain_uncertainty": 1e-5, "offset_uncertainty_v": 5e-6}


def stand(**samplers):
    return TwoAxisStand.model_validate(
        {"name": "two-axes", "positioners": {"outer": AXIS, "inner": AXIS}, "samplers": samplers}
    ).uncertainty


def test_axes_add_what_their_tables_state():
    assert (stand().outer_arcsec, stand().inner_arcsec) == (2.0, 2.0)


@pytest.mark.parametrize(
    ("keys", "channels"),
    [
        ({"channels": ["u_y_v"]}, (1,)),
        ({"scan": {"u_x_v": 101, "u_z_v": 103}}, (0, 2)),
        ({"voltages": {"u_z_v": "ADC.Z"}}, (2,)),
        ({}, (0, 1, 2)),
    ],
    ids=["channels", "scanner", "CAN", "unsaid"],
)
def test_a_meter_adds_to_the_outputs_that_it_measures(keys, channels):
    (meter,) = stand(one={**METER, **keys}).meters

    assert meter.channels == channels
    assert (meter.gain, meter.offset_v) == (1e-5, 5e-6)


def test_all_that_is_stated_leaves_nothing_out():
    assert stand(one=METER).left_out == ""
