"""Later runs held against a model over temperature: `later` of the document, and what is shown."""

import json

import numpy as np
import pytest
from app_jobs import tumble

from tumble.calibrations.methods.temperature.later import later_values
from tumble.calibrations.methods.temperature.loop import close_temperature_loop
from tumble.calibrations.methods.temperature.table import read_later, read_runs

TEMPERATURES = (-20.0, -10.0, 0.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0)


def written(path, temperatures, bias):
    rows = [
        f"{number},{degc},{value:.9f}" for number, (degc, value) in enumerate(zip(temperatures, bias, strict=True), 1)
    ]
    path.write_text("run,temperature_degC,bias_x_V\n" + "\n".join(rows) + "\n", "utf-8")
    return path


def course(degc):
    """A bias that follows its temperature."""
    degc = np.asarray(degc, float)
    return 1e-3 + 2e-5 * degc + 3e-7 * degc**2


@pytest.fixture
def model(tmp_path):
    noise = np.random.default_rng(3).normal(0.0, 5e-6, len(TEMPERATURES))
    return written(tmp_path / "model.csv", TEMPERATURES, course(TEMPERATURES) + noise)


def held(tmp_path, model, temperatures, off_v=0.0):
    later = read_later(written(tmp_path / "later.csv", temperatures, course(temperatures) + off_v))
    return later_values(close_temperature_loop(read_runs(model)), [later])


def test_a_later_run_is_expected_where_the_earlier_ones_put_its_temperature(tmp_path, model):
    (value,) = held(tmp_path, model, [25.0])

    assert value.expected == pytest.approx(float(course(25.0)), abs=1e-5)
    assert not value.contradicts


def test_a_later_run_that_is_off_contradicts(tmp_path, model):
    assert [value.contradicts for value in held(tmp_path, model, [5.0, 35.0], off_v=1e-4)] == [True, True]


def test_beyond_the_temperatures_nothing_is_contradicted(tmp_path, model):
    (value,) = held(tmp_path, model, [90.0], off_v=1.0)

    assert value.beyond
    assert not value.contradicts


def test_it_is_shown_and_written(tmp_path, model):
    later = written(tmp_path / "later.csv", [25.0], course([25.0]) + 2e-4)

    ran = tumble("close-loop", model, later, "--json", tmp_path / "t.json")

    assert ran.status == 0, ran.err
    assert "1 value is further from what the earlier runs say" in ran.out
    (value,) = json.loads((tmp_path / "t.json").read_text("utf-8"))["later"]
    assert value["contradicts"]


def test_a_record_of_it_verifies(tmp_path, model):
    later = written(tmp_path / "later.csv", [25.0], course([25.0]))

    assert tumble("close-loop", model, later, "--record", "--store", tmp_path / "s").status == 0
    assert tumble("records", "verify", "--store", tmp_path / "s").status == 0


def test_a_later_table_of_other_parameters_is_refused(tmp_path, model):
    other = tmp_path / "other.csv"
    other.write_text("run,temperature_degC,scale_y_ppm\n1,20,3\n", "utf-8")

    ran = tumble("close-loop", model, other)

    assert ran.status == 2
    assert "has no parameter of" in ran.err
