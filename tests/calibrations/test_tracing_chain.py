from dataclasses import replace
from functools import cache

import pytest
from loop_examples import clean, found

from tumble.calibrations.tracing.chain import Chain
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.link import Link
from tumble.calibrations.tracing.next_run import cannot, cheapest
from tumble.calibrations.tracing.stage import Stage


def experiment(programme="probe-end", separates=("k_xx", "k_yy"), stand_time_s=100.0, **fields):
    fields = {"why": "", "separation": 40.0, "command": f"tumble run --programme {programme}"} | fields
    return Experiment(programme=programme, separates=separates, stand_time_s=stand_time_s, **fields)


def stage(*effects, **behind):
    """What is known: each effect with its rivals."""
    listed = tuple(replace(found(name), also_possible=tuple(rivals)) for name, *rivals in effects)
    return Stage(loop=replace(clean(), effects=listed), behind=behind)


def link(before, after, **fields):
    return Link(experiment=experiment(**fields), recording="x.mcap", stand_time_s=90.0, before=before, after=after)


@cache
def three():
    return stage(("k_xx", "k_yy", "k_zz"))


def test_an_experiment_separates_what_is_no_rival_any_more():
    done = link(three(), stage(("k_yy", "k_xx"), k_zz=50.0))
    assert done.separated == ("k_xx", "k_yy", "k_zz")
    assert done.rivals_after == ("k_yy", "k_xx")
    assert done.decision == "against k_zz: k_yy or k_xx remain"
    assert done.realised == 50.0


def test_the_true_one_may_be_one_that_was_only_possible():
    done = link(three(), stage(("k_zz",), k_xx=30.0, k_yy=70.0))
    assert (done.separated, done.realised) == (("k_zz", "k_xx", "k_yy"), 30.0)
    assert done.decision == "against k_xx and k_yy: k_zz remains"


def test_an_experiment_that_leaves_all_rivals_has_separated_nothing():
    done = link(three(), three())
    assert (done.separated, done.realised) == ((), None)
    assert done.decision == "nothing: it could still be k_xx, k_yy or k_zz"


def test_where_something_else_is_found_none_of_the_names_is_distinguished():
    done = link(three(), stage(("backlash",)))
    assert done.separated == ()
    assert done.decision == "against k_xx, k_yy and k_zz: something else was found instead"


def test_what_is_said_of_an_experiment_is_all_in_the_document():
    chain = Chain(first=three(), links=(link(three(), stage(("k_xx",), k_yy=20.0, k_zz=30.0)),), ended=None)
    (entry,) = chain.as_json()["experiments"]
    assert entry["did"] == "ran probe-end to tell k_xx from k_yy"
    assert entry["separated"] == ["k_xx", "k_yy", "k_zz"]
    assert (entry["expected_difference"], entry["realised_difference"]) == (40.0, 20.0)


@pytest.mark.parametrize(
    ("links", "futile"),
    [
        ([], 0),
        ([link(three(), three())], 1),
        ([link(three(), three()), link(three(), three())], 2),
        ([link(three(), three()), link(three(), stage(("k_xx",), k_yy=20.0))], 0),
        ([link(three(), three(), runs=3)], 0),
        ([link(three(), three(), together=("probe-edge",))], 0),
    ],
    ids=["none", "one", "two", "then one that tells", "one of several runs", "one of two"],
)
def test_only_what_should_have_separated_something_by_itself_counts_as_futile(links, futile):
    assert Chain(first=three(), links=tuple(links)).futile == futile


@pytest.mark.parametrize(
    ("links", "unkept"),
    [
        ([link(three(), three())], False),
        ([link(three(), three(), runs=2)], False),
        ([link(three(), three(), runs=2), link(three(), three())], True),
        ([link(three(), three(), together=("probe-edge",)), link(three(), three(), programme="probe-edge")], True),
        ([link(three(), three(), together=("probe-edge",)), link(three(), three(), programme="probe-back")], False),
        ([link(three(), three(), runs=2), link(three(), stage(("k_xx",), k_yy=20.0))], False),
        ([link(three(), three(), runs=3), link(three(), three(), runs=2)], False),
        ([link(three(), three(), runs=6)] * 4, True),
    ],
    ids=[
        "one",
        "the first of two",
        "both of two",
        "two together",
        "one of two, and another",
        "the second tells",
        "planned anew",
        "planned anew for ever",
    ],
)
def test_a_plan_of_several_runs_is_unkept_once_all_of_them_told_nothing(links, unkept):
    assert Chain(first=three(), links=tuple(links)).unkept is unkept


def test_the_cheapest_experiment_tells_most_for_its_time():
    slow = experiment("probe-later", ("k_xx", "k_yy"), 9000.0)
    both = experiment("probe-end", ("k_xx", "k_yy", "k_zz"), 150.0)
    quick = experiment("probe-back", ("k_xx", "k_yy"), 100.0)
    assert cheapest([slow, both, quick]) is both


def test_an_experiment_that_needs_another_costs_both():
    pair = [experiment(name, stand_time_s=100.0, together=(other,)) for name, other in (("a", "b"), ("b", "a"))]
    single = experiment("c", ("k_zz", "k_yy"), 150.0)
    assert cheapest([*pair, single]) is single


def test_where_no_programme_helps_there_is_no_cheapest():
    assert cheapest([experiment("", command="")]) is None


def test_why_nothing_more_is_distinguished_names_what_would_help_elsewhere():
    nothing = experiment("", ("k_xx", "k_yy"), command="", separation=0.3)
    elsewhere = {"probe-end": (experiment("probe-end"), "the seat allows face-up only")}
    assert cannot([nothing], elsewhere) == (
        "No experiment that can be run here tells k_xx from k_yy: they would differ by 0.5 standard deviations at "
        "most, and 4 are needed. probe-end would tell k_xx from k_yy, but it cannot be run here: the seat allows "
        "face-up only."
    )


TOLD = stage(("k_xx",), k_yy=6.0)


def test_what_was_barely_told_apart_is_doubted_until_it_is_confirmed():
    chain = Chain(first=three(), links=(link(three(), TOLD), link(TOLD, TOLD)))
    before = replace(chain, links=chain.links[:1])
    assert (before.doubted, chain.doubted) == ({"k_xx", "k_yy", "k_zz"}, {"k_zz"})
    assert chain.links[1].rivals_before == ("k_xx", "k_yy")


def test_a_confirmation_that_names_another_confirms_nothing():
    chain = Chain(first=three(), links=(link(three(), TOLD), link(TOLD, stage(("k_yy",), k_xx=4.0))))
    assert chain.doubted == {"k_xx", "k_yy", "k_zz"}


def test_a_confirmation_that_brings_a_rival_back_is_not_futile():
    done = link(TOLD, stage(("k_xx", "k_yy")))
    assert (done.separated, done.futile) == ((), False)
    assert Chain(first=three(), links=(done,)).doubted == frozenset()


def test_what_turns_out_to_be_several_causes_is_told_apart():
    done = link(stage(("k_xx", "k_yy")), stage(("k_yy",), ("k_xx",)))
    assert done.separated == ("k_xx", "k_yy")
    assert done.decision == "that each of k_yy and k_xx is there"
    assert not done.futile
