"""The bank of tables with too few settings."""

import numpy as np
import pytest

from benchmarks.bank import DEVELOPMENT
from benchmarks.bank.sparse import KINDS, SparseSpec, make_sparse, sparse
from benchmarks.loop.measures import MEASURES


def spec(**changes):
    usual = {"settings": 9, "repeats": 4, "arc_deg": 180.0, "kind": "clean", "layout": "pieces", "signal_v": 1e-2}
    return SparseSpec(**{**usual, **changes})


def rows(**changes):
    return make_sparse(spec(**changes), 1).observations


def test_kinds_come_by_turns_and_a_longer_list_begins_as_a_shorter_one():
    listed = sparse(DEVELOPMENT, 6)
    assert [each.kind for each, _ in listed] == [*KINDS, *KINDS]
    assert sparse(DEVELOPMENT, 3) == listed[:3]


@pytest.mark.parametrize(("layout", "first"), [("pieces", [0, 0, 0, 0]), ("passes", [0, 1, 2, 3])])
def test_pieces_stay_at_a_setting_and_passes_go_through_all(layout, first):
    angles = rows(layout=layout).angle_deg
    places = np.searchsorted(np.unique(angles), angles)
    assert places[:4].tolist() == first


def test_pieces_share_what_a_setting_is_off_by():
    found = rows(kind="by hand")
    within = [np.ptp(found.voltage_v[found.angle_deg == angle]) for angle in np.unique(found.angle_deg)]
    assert max(within) < 1e-3


def test_flips_are_six_poses_in_two_mounts():
    found = rows(arc_deg=0.0)
    assert len({*zip(found.angle_deg.tolist(), found.mount.tolist(), strict=True)}) == 6


def test_the_second_temperature_comes_in_the_second_half():
    degc = rows(layout="two temperatures").temperature_degc
    assert [round(float(part.mean())) for part in np.split(degc, 2)] == [20, 40]


def test_a_name_is_a_false_statement_and_a_remark_on_a_bend_is_none():
    measure = MEASURES["sparse"]
    usual = {"spec": {}, "seed": 1, "failure": None, "withheld": [], "said": "it"}
    named = {**usual, "list": "bend", "named": ["k_xx"], "unexplained": False}
    remarked = {**usual, "list": "bend", "named": [], "unexplained": True}
    assert measure.failures([named, remarked]) == ["{}, seed 1: it"]
    assert "| bend | 2 | 1 (50.00 %) | 1 (50.00 %)" in measure.report([named, remarked])
