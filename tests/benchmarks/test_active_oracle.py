"""What could be told of a unit at best, on a face-up sweep without noise and further sweeps."""

import numpy as np
import pytest

from benchmarks.active.oracle import CLOSE, Oracle
from benchmarks.bank.geometry import AXES, projections
from tumble.calibrations.methods.dividing_head.observations import Observations

NOISE_V = 1e-4
ANGLES_DEG = np.arange(0.0, 360.0, 10.0)


def oracle(further, size_v):
    """Of a unit with so many volts of ax³; `further` sweeps in mounts follow the first."""
    mount = np.repeat(["face-up", *further], len(ANGLES_DEG))
    angle_deg = np.tile(ANGLES_DEG, 1 + len(further))
    ax, ay, az = projections(np.stack([AXES[each] for each in mount]), angle_deg).T
    rows = Observations(
        row=np.arange(len(mount)),
        angle_deg=angle_deg,
        mount=mount,
        voltage_v=2.5 + ax + 2e-3 * ax * ay + 0.01 * ay + 0.01 * az + size_v * ax**3,
    )
    return Oracle(rows, np.repeat(["", *further], len(ANGLES_DEG)), "k_xxx", NOISE_V)


def test_what_is_small_beside_noise_is_not_visible():
    assert not oracle((), 1e-4).visible
    assert oracle((), 1e-3).visible


def test_a_cube_and_an_error_twice_a_turn_are_one_in_a_sweep_but_for_a_number():
    case = oracle((), 1e-3)

    assert case.first["head_second_harmonic"] == pytest.approx((1.0, 1.0), abs=0.1)
    assert case.open_to_doubt


def test_another_mount_tells_them_apart():
    run, expected = oracle(("face-down", "face-up-90"), 3e-3).best(6)

    assert run[0] == "face-up-90"
    assert min(expected.values()).least >= CLOSE


def test_small_effects_take_several_runs():
    few, many = (oracle(("edge", "face-up-90"), size_v).best(6)[0] for size_v in (3e-3, 1e-3))

    assert len(many) > len(few)


def test_no_more_is_run_than_may_be():
    run, expected = oracle(("face-down",), 1e-3).best(2)

    assert run == ("face-down", "face-down")
    assert expected["head_second_harmonic"].most <= CLOSE
