import numpy as np
import pytest

from benchmarks.head_map import Outcome, _catalogue, _outside, _stand, _truth_deg, report
from tumble.app.stand import load_stand


def outcome(**changed):
    given = {
        "seed": 1,
        "kind": "catalogue",
        "rms_deg": 0.01,
        "left": 0.05,
        "stated": 0.04,
        "before_v": 3e-4,
        "after_v": 1e-4,
    }
    return Outcome(**{**given, **changed})


@pytest.mark.parametrize("seed", range(5))
def test_a_head_and_its_unit_are_drawn_from_the_seed(tmp_path, seed):
    drawn = []
    for name in ("first", "second"):
        (tmp_path / name).mkdir()
        rng = np.random.default_rng(seed)
        stand = _stand(rng, tmp_path / name, "7", _catalogue(rng), 1e-3)
        drawn.append((stand.file.simulated, _truth_deg(stand).tolist()))

    assert drawn[0] == drawn[1]
    assert 0.005 < np.std(drawn[0][1]) < 0.13


def test_a_head_with_physics_of_its_own_is_periodic(tmp_path):
    rng = np.random.default_rng(3)
    stand = _stand(rng, tmp_path, "7", _outside(rng, tmp_path), 1e-3)
    truth_deg = _truth_deg(load_stand(stand.path))

    assert np.std(truth_deg) > 0.004
    assert abs(truth_deg[0] - truth_deg[-1]) < 0.01


def test_a_report_counts_maps_within_a_tenth():
    lines = report(
        [outcome(), outcome(left=0.2), outcome(left=None, after_v=None), outcome(kind="outside")]
    ).splitlines()

    assert lines[-2] == ("catalogue: 2 maps of 3 heads, 1 within a tenth of the error, median 0.125, largest 0.200")
    assert lines[-1].startswith("outside: 1 maps of 1 heads, 1 within a tenth")
    assert "| no map | 0.040 | 300.0 µV |  |" in lines[4]
