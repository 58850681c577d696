"""From runs of a triad at several temperatures to the table that the method `temperature` traces."""

import json

import numpy as np
import pytest
from app_jobs import tumble
from triad_tables import made, read, written

from tumble.calibrations.methods.temperature.table import read_runs
from tumble.calibrations.methods.triad.by_temperature import parameter_runs


def sequence(temperatures_degc, bias_v_per_k=2e-5, programme="12o"):
    """A list of positions at each temperature, one after the other; the bias of x follows the temperature."""
    parts = [made(programme, seed=seed) for seed, _ in enumerate(temperatures_degc)]
    columns = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    columns["temperature_degC"] = np.repeat(np.array(temperatures_degc, float), len(parts[0]["time_s"]))
    columns["time_s"] = 175.0 * np.arange(len(columns["time_s"]))
    columns["u_x_V"] = columns["u_x_V"] + bias_v_per_k * (columns["temperature_degC"] - 23.0)
    return columns


def test_each_temperature_is_a_run_of_its_own(tmp_path):
    found = parameter_runs([read(tmp_path, sequence([10, 35, 60, 35, 10]))])

    assert found["temperature_degC"] == [10.0, 35.0, 60.0, 35.0, 10.0]
    assert np.diff(found["bias_x_V"]) == pytest.approx(2e-5 * np.array([25, 25, -25, -25]), abs=5e-5)
    assert "scale_x_V_per_g" in found
    assert "m_xz_arcsec" in found


def test_several_tables_are_runs_one_after_the_other(tmp_path):
    tables = [read(tmp_path, sequence([degc])) for degc in (20.0, 30.0)]

    assert parameter_runs(tables)["run"] == [1.0, 2.0]


def test_a_table_without_temperature_is_refused(tmp_path):
    with pytest.raises(ValueError, match="a temperature is missing"):
        parameter_runs([read(tmp_path, made("12o"))])


def test_too_few_positions_at_a_temperature_are_refused(tmp_path):
    columns = sequence([20, 40])
    columns["temperature_degC"][:3] = 90.0

    with pytest.raises(ValueError, match="fewer than 5 positions"):
        parameter_runs([read(tmp_path, columns)])


def test_the_table_is_traced_by_the_method_temperature(tmp_path):
    path = written(tmp_path / "runs.csv", sequence([-10, 0, 10, 20, 30, 40, 50, 60], bias_v_per_k=4e-4))

    ran = tumble("export", path, "--parameters", "--out", tmp_path / "parameters.csv")
    traced = tumble("close-loop", tmp_path / "parameters.csv", "--json", tmp_path / "t.json")

    assert ran.status == 0, ran.err
    assert "8 runs in" in ran.err
    assert "bias_x_V" in read_runs(tmp_path / "parameters.csv").parameters
    assert traced.status == 0, traced.err
    document = json.loads((tmp_path / "t.json").read_text("utf-8"))
    assert document["method"] == "temperature"


def test_of_a_head_no_such_table_is_made(tmp_path):
    path = tmp_path / "head.csv"
    path.write_text("mount,angle_deg,voltage_V\nface-up,0,1\nface-up,90,0\n", "utf-8")

    ran = tumble("export", path, "--parameters", "--out", tmp_path / "p.csv")

    assert ran.status == 2
    assert "no table of parameters is made" in ran.err
