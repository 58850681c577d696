"""The `[simulated]` table of a stand file."""

import tomllib

import pytest
from pydantic import ValidationError

from tumble.drivers.simulated import Simulated

CONTRACT = """
preset = "DXL203EB"
seed = 1
parameters = { u0 = 2.4, alpha0_deg = 0.2 }
noise_v = 2e-4
response = "physics.py:response"
head_error = "physics.py:head_error"
"""

EVERY_EFFECT = """
k_xx = 1e-4
k_yy = 1e-4
k_zz = 1e-4
k_xz = 1e-4
k_yz = 1e-4
k_xxx = 1e-4
scale_asymmetry = 1e-4
hysteresis = 1e-4
bias_temperature = 1e-5
scale_temperature = 1e-5
bias_drift = 1e-4
scale_drift = 1e-4
warm_up = { amplitude = 1e-3, tau_s = 900 }
bias_random_walk = 1e-4
realisation_bias = 1e-4
vibration_rectification = 5.0
head_eccentricity = { amplitude_deg = 0.01, phase_deg = 30 }
head_second_harmonic = { amplitude_deg = 0.01, phase_deg = 30 }
graduation = { order = 5, amplitude_deg = 0.01, phase_deg = 30 }
backlash = 0.002
axis_tilt = 0.01
base_tilt_drift = 0.001
seating = 0.002
misreading = { rows = [3, 7], error_deg = 1.0 }
settling = 1e-4
daq_nonlinearity = { amplitude = 1e-4, period_V = 0.5 }
range_step = { step = 1e-4, threshold_V = 2.1 }
latency = 0.01
"""


def test_a_table_overrides_only_the_parameters_that_it_states():
    settings = Simulated.model_validate(tomllib.loads(CONTRACT))
    p = settings.unit_parameters
    assert (p.u0, p.kx, p.ky, p.kz, p.kxy, p.alpha0_deg) == (2.4, 1.0, 0.0098, 0.002, 0.001, 0.2)
    assert settings.sample_noise_v == 2e-4


def test_without_a_word_the_published_unit_is_simulated():
    settings = Simulated()
    assert settings.unit_parameters.alpha0_deg == 0.1121
    assert settings.sample_noise_v == 1e-3


def test_every_name_of_the_catalogue_can_be_injected():
    table = tomllib.loads(EVERY_EFFECT)
    effects = Simulated.model_validate({"effects": table}).effects
    assert effects.model_fields_set == set(table)


@pytest.mark.parametrize(
    ("table", "message"),
    [
        ({"effects": {"k_qq": 1.0}}, "unknown effect 'k_qq'; known are .*axis_tilt.*k_xx.*warm_up"),
        ({"preset": "ADXL9"}, "unknown preset 'ADXL9'; known are DXL203EB, ideal"),
        ({"parameters": {"k0": 1.0}}, "parameters.k0"),
        ({"noise": 1.0}, "Extra inputs are not permitted"),
        ({"noise_v": -1.0}, "greater than or equal to 0"),
        ({"effects": {"k_xx": float("nan")}}, "finite number"),
        ({"effects": 4}, "valid dictionary"),
        ({"effects": {"graduation": {"order": 2, "amplitude_deg": 0.1}}}, "greater than or equal to 3"),
        (
            {"effects": {"misreading": {"rows": [1, 2], "error_deg": [1.0]}}},
            "misreading names 2 rows but 1 error",
        ),
        ({"response": "a.py:b", "effects": {"k_xx": 1e-4}}, r"effects of the unit \(k_xx\)"),
    ],
)
def test_a_mistake_is_named(table, message):
    with pytest.raises(ValidationError, match=message):
        Simulated.model_validate(table)


def test_an_error_for_each_misread_row_can_be_given():
    table = {"misreading": {"rows": [3, 7], "error_deg": [1.0, -0.5]}}
    misreading = Simulated.model_validate({"effects": table}).effects.misreading
    assert misreading is not None
    assert misreading.by_row() == {3: 1.0, 7: -0.5}


def test_the_vibration_level_spreads_only_where_rectification_is_injected():
    assert Simulated().vibration_level_spread == 0.0
    rectifying = {"effects": {"vibration_rectification": 5.0}}
    assert Simulated.model_validate(rectifying).vibration_level_spread == 0.5
    assert Simulated.model_validate(rectifying | {"vibration_spread": 0.1}).vibration_level_spread == 0.1
