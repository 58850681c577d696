from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context

import pytest

from benchmarks.endurance.cuts import cut_correctly, recorded, wrong_cuts
from tumble.procedures.methods.dividing_head.rows import row_of

PROGRAMME = """\
name = "eight"
dwell_s = 0.1

[[procedure]]
kind = "sweep"
step_deg = 45.0
points = 8
"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    folder = tmp_path_factory.mktemp("whole")
    programme = folder / "eight.toml"
    programme.write_text(PROGRAMME, "utf-8")
    return recorded(folder, str(programme))


def read_correctly(whole, size, tmp_path):
    return cut_correctly(whole, whole.path.read_bytes(), size, tmp_path / "cut.mcap")


def test_a_recording_that_is_cut_anywhere_gives_every_complete_point(whole, tmp_path):
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:  # where no coverage is traced
        assert pool.submit(wrong_cuts, whole, tmp_path, count=40, seed=1).result() == []


def test_a_point_that_is_not_read_is_noticed(whole, tmp_path):
    size = whole.sizes[5]
    assert read_correctly(whole, size, tmp_path)
    earlier = replace(whole, sizes=[size - 3000 for size in whole.sizes])
    assert not read_correctly(earlier, whole.sizes[5] - 3000, tmp_path)


def test_a_point_that_is_read_with_another_voltage_is_noticed(whole, tmp_path):
    changed = replace(row_of(whole.points[2]), voltage_v=0.0).point
    other = replace(whole, points=(*whole.points[:2], changed, *whole.points[3:]))
    assert not read_correctly(other, whole.sizes[5], tmp_path)
