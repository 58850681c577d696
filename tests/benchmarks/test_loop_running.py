import json

import pytest

from benchmarks.bank import DEVELOPMENT, Spec, mixture
from benchmarks.loop import running
from benchmarks.loop.jobs import Job, spread_out
from benchmarks.loop.measures import MEASURES
from benchmarks.loop.results import read_results


@pytest.fixture
def asked(monkeypatch):
    """Jobs that were graded, in place of a grading that takes time."""
    jobs = []

    def graded(job):
        jobs.append(job.seed)
        return {"key": job.key, "seed": job.seed}

    monkeypatch.setattr(running, "graded", graded)
    return jobs


def tables(*seeds):
    return [Job(measure="clean", list_name="clean", spec=Spec(), seed=seed) for seed in seeds]


def small(measure, seed):
    """Four rounds of flips: a table that takes no time."""
    return Job(measure=measure, list_name="clean", spec=Spec(design="f", realisations=4), seed=seed)


def test_a_run_that_continues_makes_only_what_is_missing(tmp_path, asked):
    out = tmp_path / "results.jsonl"
    running.run(tables(1, 2), 1, out)
    assert [record["seed"] for record in running.run(tables(1, 2, 3), 1, out)] == [1, 2, 3]
    assert asked == [1, 2, 3]
    assert len(out.read_text().splitlines()) == 3


def test_a_line_that_was_cut_off_is_made_again(tmp_path, asked):
    out = tmp_path / "results.jsonl"
    running.run(tables(1, 2), 1, out)
    out.write_bytes(out.read_bytes()[:-5])
    running.run(tables(1, 2), 1, out)
    assert asked == [1, 2, 2]
    assert [json.loads(line)["seed"] for line in out.read_text().splitlines()] == [1, 2]
    assert len(read_results(out)) == 2


def test_another_spec_with_the_same_seed_is_another_table(tmp_path, asked):
    out = tmp_path / "results.jsonl"
    running.run(tables(1), 1, out)
    running.run([Job(measure="clean", list_name="clean", spec=Spec(realisations=3), seed=1)], 1, out)
    assert asked == [1, 1]


def test_a_chosen_part_of_a_list_reaches_from_its_beginning_to_its_end():
    assert [job.seed for job in spread_out(tables(*range(9)), 3)] == [0, 4, 8]
    assert len(spread_out(tables(1, 2), 5)) == 2


@pytest.mark.parametrize("measure", sorted(MEASURES))
def test_every_measure_grades_a_table_and_reports_it(measure, tmp_path):
    (record,) = running.run([small(measure, 1)], 1, tmp_path / "results.jsonl")
    assert record["shown"]
    assert record["failure"] is None
    assert "1" in MEASURES[measure].report([record])
    assert isinstance(MEASURES[measure].failures([record]), list)


def test_two_processes_give_what_one_gives(tmp_path):
    wanted = [small("coverage", 1), small("coverage", 2)]
    one, two = running.run(wanted, 1, None), running.run(wanted, 2, tmp_path / "results.jsonl")
    for record in (*one, *two):
        record.pop("seconds")
    assert one == two


def test_a_table_on_which_the_analysis_fails_is_kept_as_a_failure(monkeypatch):
    def fails(_):
        raise ValueError("no row")

    monkeypatch.setattr(running, "close_loop", fails)
    (record,) = running.run(tables(1), 1, None)
    assert record["shown"]
    assert "no row" in record["failure"]


@pytest.mark.parametrize("measure", sorted(MEASURES))
def test_every_measure_wants_different_tables_with_the_seeds_it_is_given(measure):
    wanted = MEASURES[measure].wanted(DEVELOPMENT, 12)
    assert len({job.key for job in wanted}) == len(wanted) >= 12
    assert all(job.seed in DEVELOPMENT for job in wanted)


def test_a_longer_mixture_begins_as_a_shorter_one_does():
    assert mixture(count=60)[:24] == mixture(count=24)


def test_of_twelve_mixed_tables_four_are_clean_four_hold_one_effect_and_three_hold_two():
    sizes = [len(spec.effects) for spec, _ in mixture(count=24)]
    assert sizes[:12] == [0] * 4 + [1] * 4 + [2] * 3 + [3]
    assert sizes[23] == 1
