"""`tumble gyrocompass-errors`, and a table of gyrocompassing by `tumble close-loop`."""

import json

import numpy as np
import pytest
from click.testing import CliRunner

from benchmarks.gyrocompass.__main__ import write
from benchmarks.gyrocompass.effects import UNIT
from benchmarks.gyrocompass.world import Design, make
from tumble.app.cli import cli


def test_the_costs_and_the_ways_are_written(tmp_path):
    out = tmp_path / "errors.json"

    ran = CliRunner().invoke(cli, ["gyrocompass-errors", "--runs", "500", "--target", "0.12", "--json", str(out)])

    assert ran.exit_code == 0, ran.output
    told = json.loads(out.read_text("utf-8"))
    assert told["schema"] == "tumble.gyrocompass-errors/1"
    assert {each["cause"] for each in told["causes"]} >= {"all", "latitude"}
    assert [each["order"] for each in told["orders"]][:1] == ["0/90/180"]
    assert all(each["heading"]["rms_deg"] <= 0.12 for each in told["quickest"])


@pytest.mark.parametrize("size", ["0"])
def test_a_gyro_without_noise_is_refused(size):
    ran = CliRunner().invoke(cli, ["gyrocompass-errors", "--gauss-markov", size])

    assert ran.exit_code == 2
    assert "a gyro has noise" in ran.output


def test_a_table_is_closed_with_the_keys_of_its_method(tmp_path):
    made = make(np.random.default_rng(2), Design(angles_deg=(0.0, 90.0, 180.0, 270.0), passes=2))
    write(tmp_path / "table.csv", made.columns)

    ran = CliRunner().invoke(cli, ["close-loop", str(tmp_path / "table.csv"), "--json", "-"])

    assert ran.exit_code == 0, ran.output
    told = json.loads(ran.stdout)
    assert told["method"] == "gyrocompass"
    assert told["augmented"].keys() >= {"parameters", "residual_rms_deg_h", "held_out_rms_deg_h"}
    assert told["effects"] == []


def test_a_record_whose_heading_is_withheld_between_effects_verifies(tmp_path):
    design = Design(angles_deg=(0.0, 90.0, 180.0, 270.0), passes=3, lean_deg=3.0)
    made = make(np.random.default_rng(3), design, unit=[(UNIT["g_unbalance"], 1.5)])
    table, store = tmp_path / "table.csv", tmp_path / "store"
    write(table, made.columns)

    recorded = CliRunner().invoke(cli, ["close-loop", str(table), "--record", "--store", str(store), "--json", "-"])
    verified = CliRunner().invoke(cli, ["records", "verify", "--store", str(store)])

    assert json.loads(recorded.stdout)["augmented"]["parameters"]["alpha0"]["value"] is None
    assert verified.exit_code == 0, verified.output
