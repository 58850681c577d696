import pytest

from benchmarks.active.cases import make
from benchmarks.active.grading import failures, report
from tumble.app.stand import load_stand
from tumble.procedures.programmes import programme_from_text

PART = {"open": True, "ambiguous": True, "failure": None, "outside": False, "effect": "k_xx", "seconds": 1.0, "seed": 1}
PART |= {"first": "sweep", "seat": "every mount", "before": [["k_xx", "k_yy"]], "experiments": ["probe-end"]}
PART |= {"differences": [[40.0, 50.0]], "stand_time_s": 600.0, "everything_s": 6000.0, "why": ""}
TOLD = PART | {"found": [["k_xx"]], "ended": "told apart", "best": [], "expected": {"k_yy": [20.0, 70.0]}}
LEFT = PART | {"found": [["k_yy", "k_xx"]], "ended": "no available experiment"}
LEFT |= {"best": [], "expected": {"k_yy": [1.0, 3.0]}}
BETWEEN = LEFT | {"expected": {"k_yy": [2.0, 9.0]}}
PLACE = {"effect": "offset × time", "again_found": [["offset × time"]], "everything_found": [["offset × time"]]}
UNNAMED = {key: value for key, value in LEFT.items() if key != "expected"} | PLACE
CLEAR = PART | {"ambiguous": False, "found": [["k_xx"]]}
PASSED_OVER = CLEAR | {"open": False}


@pytest.mark.parametrize("seed", range(40))
def test_every_case_is_a_stand_and_a_programme_that_fits_it(seed, tmp_path):
    case = make(seed)
    (tmp_path / "stand.toml").write_text(case.stand_text, "utf-8")
    programme = programme_from_text(case.programme_text, "first.toml")
    assert load_stand(tmp_path / "stand.toml").file.simulated.seed == seed
    assert programme.realisations in {2, 3}
    assert bool(case.physics_text) is case.outside
    assert make(seed) == case


def test_cases_are_counted_by_what_could_be_told():
    text = report([TOLD, LEFT, CLEAR, BETWEEN, PASSED_OVER])
    assert "5 cases, 4 of them visible and open to doubt, 0 failed, 3 ambiguous" in text
    assert "the noise decides, told apart or said so: 1 of 1 (100.0%)" in text
    assert "some available experiment parts the rivals, told apart: 1 of 1 (100.0%)" in text
    assert "nothing available parts the rivals, said so: 1 of 1 (100.0%)" in text
    assert "stand time of these: 10 min in the median, against 100 min" in text


@pytest.mark.parametrize(
    "record",
    [
        TOLD | {"found": [["k_yy"]]},
        TOLD | {"found": [["k_xx", "k_yy"]]},
        TOLD | {"found": [["k_xx"], ["backlash"]]},
        LEFT | {"found": [["k_yy"]], "ended": "told apart"},
        BETWEEN | {"found": [["k_yy"]], "ended": "told apart"},
        UNNAMED,
        LEFT | {"ended": "as many as were asked for"},
        CLEAR | {"failure": "ValueError()"},
    ],
    ids=[
        "wrong name",
        "a rival left",
        "an effect too many",
        "wrongly told",
        "by chance the wrong one",
        "not located",
        "not said",
        "failed",
    ],
)
def test_what_goes_wrong_is_listed(record):
    assert len(failures([TOLD, LEFT, CLEAR, record])) == 1
