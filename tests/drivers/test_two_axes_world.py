"""The world of two axes, against gravity turned by rotation matrices."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from tumble.drivers.clock import VirtualClock
from tumble.drivers.simulated.two_axes.settings import SimulatedTwoAxes
from tumble.drivers.simulated.two_axes.world import TwoAxesWorld
from tumble.drivers.simulated.worlds import Surroundings

ARCSEC = np.pi / 180.0 / 3600.0
PERFECT = {
    **{f"bias_{c}": 0.0 for c in "xyz"},
    **{f"scale_{c}": 1.0 for c in "xyz"},
    **{f"m_{a}{b}": 0.0 for a in "xyz" for b in "xyz" if a != b},
    "level_x": 0.0,
    "level_y": 0.0,
}
QUIET = {"noise_v": (0.0, 0.0, 0.0), "resolution_v": 0.0}
PLACES = [(0.0, 0.0), (90.0, 45.0), (-30.0, 115.0), (180.0, -90.0), (37.0, 0.0)]


def outputs_v(outer_deg, inner_deg, parameters=(), effects=None, **settings):
    """Means of the three channels at a position that was reached in + direction."""
    clock = VirtualClock(wall_start_ns=0)
    table = SimulatedTwoAxes.model_validate(
        {"parameters": PERFECT | dict(parameters), "effects": effects or {}, **QUIET, **settings}
    )
    world = TwoAxesWorld(table, Surroundings(clock=clock))
    for start_deg in (-200.0, None):
        for name, angle_deg in (("outer", outer_deg), ("inner", inner_deg)):
            world.positioners[name].start_move(angle_deg if start_deg is None else start_deg)
        clock.sleep(60.0)
    block = world.meter(()).take(10, 100.0)
    return np.array([values.mean() for values in block.channels.values()])


def expected(outer_deg, inner_deg, level_x=0.0, level_y=0.0, square=0.0):
    """Gravity in the case by Ry(λy) Rx(A + λx) Ry(κ) Rz(B), angles of the stand in arc seconds."""
    turn = Rotation.from_euler("y", level_y * ARCSEC)
    turn *= Rotation.from_euler("x", np.deg2rad(outer_deg) + level_x * ARCSEC)
    turn *= Rotation.from_euler("y", square * ARCSEC) * Rotation.from_euler("z", inner_deg, degrees=True)
    return turn.inv().apply([0.0, 0.0, -1.0])


@pytest.mark.parametrize("place", PLACES)
def test_gravity_is_that_of_the_contract(place):
    assert outputs_v(*place) == pytest.approx(expected(*place), abs=1e-12)


@pytest.mark.parametrize("place", PLACES)
def test_levels_and_axes_that_are_not_square_turn_it(place):
    seen = outputs_v(*place, {"level_x": 50.0, "level_y": -70.0}, {"axes_orthogonality": {"value_arcsec": 30.0}})
    assert seen == pytest.approx(expected(*place, 50.0, -70.0, 30.0), abs=1e-12)


@pytest.mark.parametrize(
    ("effect", "place", "seen"),
    [
        ({"x.k_xx": 1e-4}, (90.0, -90.0), (1.0 + 1e-4, 0.0, 0.0)),
        ({"y": {"k_yyy": 2e-4}}, (90.0, 180.0), (0.0, 1.0 + 2e-4, 0.0)),
        ({"z.scale_asymmetry": 3e-4}, (180.0, 0.0), (0.0, 0.0, 1.0 + 3e-4)),
        ({"outer_eccentricity": {"amplitude_arcsec": 10.0}}, (90.0, 0.0), (0.0, -1.0, 10 * ARCSEC)),
        ({"inner_eccentricity": {"amplitude_arcsec": 10.0, "phase_deg": 90.0}}, (90.0, 0.0), (-10 * ARCSEC, -1.0, 0.0)),
        ({"bias_temperature": {"z": 1e-3}}, (180.0, 0.0), (0.0, 0.0, 1.0 + 1e-3)),
        ({"daq_nonlinearity": {"amplitude": 1e-4, "period_V": 4.0}}, (180.0, 0.0), (0.0, 0.0, 1.0 + 1e-4)),
        ({"outer_wobble": {"amplitude_arcsec": 10.0, "phase_deg": 90.0}}, (0.0, 0.0), (10 * ARCSEC, 0.0, -1.0)),
    ],
)  # fmt: skip
def test_an_effect_adds_what_the_catalogue_says(effect, place, seen):
    room = {"start_degC": 24.0, "wander_K": 0.0} if "bias_temperature" in effect else {"wander_K": 0.0}
    assert outputs_v(*place, effects=effect, temperature=room) == pytest.approx(seen, abs=1e-8)


def test_crosstalk_mixes_the_outputs():
    mixed = outputs_v(180.0, 0.0, crosstalk=((0.0, 0.0, 1e-3), (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)))
    assert mixed == pytest.approx([1e-3, 0.0, 1.0], abs=1e-12)


def test_three_meters_see_what_one_sees_noise_included():
    def world():
        return TwoAxesWorld(SimulatedTwoAxes(), Surroundings(clock=VirtualClock(wall_start_ns=0)))

    one = world().meter(()).take(5, 100.0).channels
    single = world()
    for name, values in one.items():
        assert single.meter((name,)).take(5, 100.0).channels[name] == pytest.approx(values, abs=0.0)


def test_a_channel_that_the_unit_lacks_is_refused():
    world = TwoAxesWorld(SimulatedTwoAxes(), Surroundings(clock=VirtualClock()))
    with pytest.raises(ValueError, match="has no output u_w_v; it has u_x_v, u_y_v, u_z_v"):
        world.meter(("u_w_v",))


def test_an_effect_that_there_is_not_is_refused_with_those_that_there_are():
    with pytest.raises(ValueError, match=r"unknown effect 'w.k_xx'; known are .*axes_orthogonality"):
        SimulatedTwoAxes.model_validate({"effects": {"w.k_xx": 1.0}})


def test_each_axis_has_a_serial_number_of_its_own():
    world = TwoAxesWorld(SimulatedTwoAxes(), Surroundings(clock=VirtualClock(wall_start_ns=0)))

    serials = {name: head.identify().serial for name, head in world.positioners.items()}

    assert serials == {"outer": "SIM-OUTER", "inner": "SIM-INNER"}
