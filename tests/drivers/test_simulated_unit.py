"""The response of the simulated unit, term by term, and its memory."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from tumble.drivers.simulated.effects import Effects
from tumble.drivers.simulated.external import load_function
from tumble.drivers.simulated.presets import UnitParameters
from tumble.drivers.simulated.unit import Accelerometer, ExternalUnit, Hysteresis

AX, AY, AZ = 0.6, -0.5, 0.4
GRAVITY_G = np.array([[AX, AY, AZ]])
SILENT = {"u0": 0.0, "kx": 0.0, "ky": 0.0, "kz": 0.0, "kxy": 0.0, "alpha0_deg": 0.0}


def unit(parameters=None, effects=None) -> Accelerometer:
    return Accelerometer(UnitParameters(**(SILENT | (parameters or {}))), Effects.model_validate(effects or {}))


@pytest.mark.parametrize(
    ("name", "expected"),
    [("u0", 1.0), ("kx", 0.6), ("ky", -0.5), ("kz", 0.4), ("kxy", -0.3)],
)
def test_each_declared_parameter_multiplies_its_term(name, expected):
    assert unit({name: 1.0}).static_v(GRAVITY_G)[0] == pytest.approx(expected)


@pytest.mark.parametrize(
    ("name", "expected"),
    [
        ("k_xx", 0.36),
        ("k_yy", 0.25),
        ("k_zz", 0.16),
        ("k_xz", 0.24),
        ("k_yz", -0.2),
        ("k_xxx", 0.216),
        ("scale_asymmetry", 0.6),
    ],
)
def test_each_undeclared_coefficient_multiplies_its_term(name, expected):
    assert unit(effects={name: 1.0}).static_v(GRAVITY_G)[0] == pytest.approx(expected)


def test_asymmetry_is_even_in_ax():
    assert unit(effects={"scale_asymmetry": 2.0}).static_v(np.array([[-0.6, 0.0, 0.0]]))[0] == pytest.approx(1.2)


@pytest.mark.parametrize(
    ("effects", "expected"),
    [
        ({"bias_temperature": 1e-3}, 2e-3),
        ({"scale_temperature": 1e-3}, 1.2e-3),
        ({"bias_drift": 1e-3}, 0.5e-3),
        ({"scale_drift": 1e-3}, 0.3e-3),
        ({"warm_up": {"amplitude": 1.0, "tau_s": 900.0}}, 0.1353352832),
    ],
)
def test_two_kelvin_above_the_reference_after_half_an_hour(effects, expected):
    voltage_v = unit(effects=effects).voltage_v(GRAVITY_G, np.array([25.0]), np.array([1800.0]))
    assert voltage_v[0] == pytest.approx(expected)


def test_an_external_response_takes_the_place_of_the_unit(tmp_path: Path):
    (tmp_path / "physics.py").write_text(
        "def response(ax_g, ay_g, az_g, temperature_degC, time_s):\n"
        "    return ax_g + 10 * ay_g + 100 * az_g + 1000 * temperature_degC + 1e5 * time_s\n"
    )
    external = ExternalUnit(load_function("physics.py:response", tmp_path))
    voltage_v = external.voltage_v(GRAVITY_G, np.array([20.0, 21.0]), np.array([1.0, 2.0]))
    assert voltage_v == pytest.approx([120035.6, 221035.6])
    assert external.static_v(GRAVITY_G) == pytest.approx([23035.6])


@pytest.mark.parametrize(
    ("reference", "message"),
    [
        ("physics.py", "names nothing in a file"),
        ("physics.py:other", "has no 'other'"),
        ("physics.py:g", "is no function"),
        ("absent.py:response", "absent.py could not be loaded .FileNotFoundError"),
        ("broken.py:response", "broken.py could not be loaded .SyntaxError"),
        ("physics.txt:response", "is no Python file"),
    ],
)
def test_a_function_that_cannot_be_loaded_is_named(tmp_path: Path, reference, message):
    (tmp_path / "physics.py").write_text("response = abs\ng = 9.8\n")
    (tmp_path / "broken.py").write_text("def\n")
    with pytest.raises(ValueError, match=message):
        load_function(reference, tmp_path)


def test_hysteresis_lags_by_the_half_gap_once_reversed():
    memory = Hysteresis(half_gap_v=1e-4, reach_g=0.02, ax_g=0.0)
    assert memory.offset_v == 0.0
    memory.follow(0.5)
    assert memory.offset_v == pytest.approx(-1e-4)
    memory.follow(0.46)
    assert memory.offset_v == pytest.approx(1e-4)


def test_hysteresis_reverses_gradually():
    memory = Hysteresis(half_gap_v=1.0, reach_g=0.02, ax_g=0.0)
    memory.follow(0.5)
    memory.follow(0.49)  # half of the 20 mg slack of the second play, a quarter of the 40 mg of the fourth
    assert memory.offset_v == pytest.approx((1.0 + 0.0 - 1 / 3 - 0.5) / 4)


@given(st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=20))
def test_hysteresis_never_leaves_its_gap(path_g):
    memory = Hysteresis(half_gap_v=1.0, reach_g=0.02, ax_g=0.0)
    for ax_g in path_g:
        memory.follow(ax_g)
        assert abs(memory.offset_v) <= 1.0 + 1e-9


@given(st.floats(-1.0, 1.0), st.floats(-1.0, 1.0), st.integers(1, 9))
def test_hysteresis_does_not_depend_on_the_steps_of_the_way(start_g, end_g, steps):
    at_once = Hysteresis(half_gap_v=1.0, reach_g=0.02, ax_g=start_g)
    by_steps = Hysteresis(half_gap_v=1.0, reach_g=0.02, ax_g=start_g)
    at_once.follow(end_g)
    for step in range(1, steps + 1):
        by_steps.follow(start_g + (end_g - start_g) * step / steps)
    assert by_steps.offset_v == pytest.approx(at_once.offset_v, abs=1e-9)
