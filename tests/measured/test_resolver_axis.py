"""A motorised axis against a resolver, before and after rewiring (anderssandstrom/amci_resolver_issue, public)."""

import json

import numpy as np
import pytest
from app_jobs import tumble

from tumble.calibrations.core.table import write_table
from tumble.calibrations.methods.dividing_head.table import read_table


def closed(tmp_path, *paths):
    ran = tumble("close-loop", *paths, "--json", tmp_path / "loop.json")
    assert ran.status == 0, ran.err
    return ran, json.loads((tmp_path / "loop.json").read_text("utf-8"))


@pytest.fixture(scope="module")
def axis(shared, tmp_path_factory):
    """What is said of the measured axis: its two tables, each by itself and compared."""
    paths = [shared / "data" / f"head_reference_{name}.csv" for name in ("fault", "rewired")]
    return closed(tmp_path_factory.mktemp("axis"), *paths)[1]


@pytest.mark.parametrize("number", [0, 1])
def test_the_passes_of_the_measured_axis_differ_because_the_reference_is_read_late(axis, number):
    document = axis["tables"][number]
    latency = next(effect for effect in document["effects"] if effect["name"] == "latency")
    assert latency["also_possible"] == []
    assert latency["coefficients"]["latency"]["value"] == pytest.approx(0.0345, abs=0.002)
    assert document["passes"]["difference_before_deg"] > 2.4
    assert document["passes"]["difference_after_deg"] < 0.1
    assert document["augmented"]["held_out_rms_deg"] < 0.1 * document["declared"]["held_out_rms_deg"]


def test_of_constant_speed_alone_nobody_can_tell_lateness_from_backlash(shared, tmp_path):
    table = read_table(shared / "data" / "head_reference_rewired.csv")
    write_table(table.select(np.abs(np.abs(table.velocity_deg_s) - 36.0) < 0.01), tmp_path / "cut.csv")
    _, document = closed(tmp_path, tmp_path / "cut.csv")
    disputed = [{each["name"], *each["also_possible"]} for each in document["effects"] if each["also_possible"]]
    assert {"latency", "backlash"} in disputed
    asked = [set(each["separates"]) for each in document["next_experiment"] if "third of the speed" in each["why"]]
    assert {"latency", "backlash"} in asked


def test_the_rewiring_took_four_waves_a_turn_away(axis):
    first = axis["changed"][0]
    assert (first["name"], first["order"], first["after"]) == ("graduation", 4, 0.0)
    assert first["before"] == pytest.approx(7.9, abs=0.2)
