"""Recordings give what they gave: rows, parameters, effects and what is withheld."""

from pathlib import Path

import pytest
from app_jobs import tumble

from benchmarks.frozen import OF_RUNS, RECORDINGS, differences, read, results, results_of_a_run


def run(*arguments):
    return tumble(*arguments).status


@pytest.mark.parametrize("programme", ["quick", "probe-end"])
def test_a_run_of_the_simulated_stand_gives_its_frozen_results(programme, tmp_path: Path):
    now = results_of_a_run(run, programme, tmp_path)

    assert list(differences(read(OF_RUNS / f"{programme}.json"), now, relative=1e-6)) == []


@pytest.mark.parametrize("name", RECORDINGS)
def test_a_recording_of_an_earlier_version_gives_its_frozen_results(name, tmp_path: Path):
    now = results(run, [RECORDINGS[name]], tmp_path)

    assert list(differences(read(OF_RUNS / f"{name}.json"), now, relative=1e-6)) == []


@pytest.mark.parametrize(
    ("frozen", "now", "said"),
    [
        ({"a": 1.0, "b": None}, {"a": 1.0 + 1e-9, "b": None}, []),
        ({"a": 1.0}, {"a": 1.00001}, ["/a: 1.0 became 1.00001"]),
        ({"a": 1.0}, {"a": None}, ["/a: 1.0 became None"]),
        ({"a": 1, "b": 2}, {"b": 2, "a": 1}, [": keys a, b became b, a"]),
        ({"a": [1]}, {"a": [1, 2]}, ["/a: 1 entries became 2"]),
        ({"a": "k_xx"}, {"a": "k_yy"}, ["/a: 'k_xx' became 'k_yy'"]),
        ({"a": "a sentence"}, {"a": "another sentence"}, []),
        ({"a": 1}, {"a": 1.0}, ["/a: 1 became 1.0"]),
        ({"a": 1e-17}, {"a": -3e-16}, []),
    ],
)
def test_what_differs_is_said(frozen, now, said):
    assert list(differences(frozen, now, relative=1e-6)) == said
