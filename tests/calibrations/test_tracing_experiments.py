import re

import numpy as np
import pytest
from tables import gravity_on
from tracing_runs import FLIPS, SWEEP, dwells, programme, runs

from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.observations import Observations
from tumble.calibrations.methods.dividing_head.probes import PROBES, Probe
from tumble.calibrations.tracing import experiments
from tumble.calibrations.tracing.experiments import next_experiments
from tumble.calibrations.tracing.least import nearest_to_nothing
from tumble.calibrations.tracing.penalties import CLOSE
from tumble.calibrations.tracing.rivals import rivals, with_best_names
from tumble.calibrations.tracing.separation import APART, Expected, PlannedRows, Question
from tumble.calibrations.tracing.trace import Tracer
from tumble.procedures.programmes import shipped_programmes

UP = SWEEP.format("face-up", "up")
BACK = SWEEP.format("face-up", "there-and-back")
DOWN = SWEEP.format("face-down", "up")
BY_NAME = {probe.programme: probe for probe in PROBES}


def ax_g(columns):
    ax = np.empty(len(columns["angle_deg"]))
    for mount in np.unique(columns["mount"]):
        here = columns["mount"] == mount
        ax[here] = gravity_on(mount, columns["angle_deg"][here] + 0.1121)[0]
    return ax


def k_xx(columns):
    return 2e-4 * ax_g(columns) ** 2


def traced(observations):
    """The table, what it was traced to, and every rival by how far it is behind."""
    base = dividing_head_table(fit_jointly(observations), CATALOGUE)
    tracer = Tracer(base)
    trace, _ = with_best_names(tracer, tracer.trace())
    return base, trace, {name: rivals(tracer, trace, name) for name in trace.names}


def close(found):
    return {name: [rival for rival in listed if rival.behind < CLOSE] for name, listed in found.items()}


def behind(found, name, rival):
    """How far a rival is behind; infinitely far where it is not even listed."""
    return next((each.behind for each in found[name] if each.name == rival), np.inf)


def shown(experiment):
    """Every difference that an experiment would show: true, other, and the separation n ln(1 + T/n) of its rows."""
    outlook = experiment.outlook
    count = len(outlook.rows)
    squares = [np.sum(each.left_v**2) / outlook.dwell_v**2 for each in outlook.differences]
    pairs = [(each.true, each.other) for each in outlook.differences]
    return [(*pair, count * np.log1p(square / count)) for pair, square in zip(pairs, squares, strict=True)]


def proposed(base, trace, found):
    return next_experiments(base, trace, close(found), PROBES)


def test_every_probe_is_a_programme_that_comes_along():
    assert sorted(BY_NAME) == [name for name in shipped_programmes() if name.startswith("probe-")]


@pytest.mark.parametrize("probe", PROBES, ids=lambda probe: probe.programme)
def test_a_probe_takes_the_dwells_of_its_programme(probe):
    steps = [dwell for dwell, _ in dwells(probe.programme)]
    assert {step.conditions["mount"] for step in steps} == {probe.mount}
    assert [step.targets_deg["head"] for step in steps] == probe.angles_deg.ravel().tolist()
    assert [step.realisation for step in steps] == np.repeat(
        np.arange(1, probe.realisations + 1), len(steps) // probe.realisations
    ).tolist()


def test_stand_time_counts_moves_dwells_the_mounting_and_the_wait():
    moves_s = (3 * 395 + 2 * 395) / 20
    assert BY_NAME["probe-face-down"].stand_time_s == pytest.approx(60 + 240 * 1.5 + moves_s)
    assert BY_NAME["probe-later"].stand_time_s == pytest.approx(7200 + BY_NAME["probe-repeat"].stand_time_s)


def short_table(**columns):
    return Observations(
        row=np.array([1, 2]), angle_deg=np.array([0.0, 10.0]), voltage_v=np.array([1.5, 1.6]), **columns
    )


def test_a_probe_goes_on_where_the_table_ends():
    table = short_table(
        time_s=np.array([5.0, 9.0]),
        direction=np.array([1, 1]),
        temperature_degc=np.array([np.nan, 22.0]),
        realisation=np.array([1, 2]),
        velocity_deg_s=np.array([0.0, 10.0]),
        extra={"lamp": np.array(["on", "off"])},
    )
    joined = Probe(programme="warm", does="", mount="edge", realisations=2, warmer_k=3.0, wait_s=5.0).after(table)
    assert len(joined) == 2 + 160
    assert joined.row.tolist() == list(range(1, 163))
    assert joined.time_s[2:4] == pytest.approx([9.0 + 65.0 + 0.5 + 1.5, 9.0 + 65.0 + 0.5 + 1.5 + 0.25 + 1.5])
    assert joined.direction[2:5].tolist() == [-1, 1, 1]
    assert joined.temperature_degc[2:].tolist() == [25.0] * 160
    assert joined.realisation[2:].tolist() == [3] * 80 + [4] * 80
    assert joined.mounts.tolist() == ["face-up"] * 2 + ["edge"] * 160
    assert joined.velocity_deg_s[2:].tolist() == [0.0] * 160
    assert joined.runs.tolist() == [0] * 2 + [1] * 160
    assert joined.extra["lamp"][2:].tolist() == ["off"] * 160


def test_a_column_that_the_table_lacks_is_not_made_up():
    joined = BY_NAME["probe-repeat"].after(short_table())
    assert (joined.time_s, joined.direction, joined.temperature_degc, joined.samples) == (None, None, None, None)
    assert joined.realisation.tolist() == [1, 1] + [2] * 80 + [3] * 80 + [4] * 80


def test_a_direction_holds_where_the_head_does_not_move():
    table = short_table(direction=np.array([1, 1]))
    joined = BY_NAME["probe-back"].after(table)
    assert joined.direction[2 + 158 : 2 + 160].tolist() == [-1, -1]


def test_no_rivals_ask_for_no_experiment():
    base, trace, found = traced(runs(programme(FLIPS, UP, realisations=2), seed=3))
    assert proposed(base, trace, found) == ()


def test_once_per_turn_and_a_square_are_distinguished_by_a_turn_of_90_degrees():
    own = programme(FLIPS, BACK, DOWN, realisations=2)
    base, trace, found = traced(runs(own, extra_v=k_xx, seed=2))
    assert behind(found, "k_xx", "head_eccentricity") < 4.0
    with_it = {"k_xx": [rival for rival in found["k_xx"] if rival.name == "head_eccentricity"]}
    (experiment,) = next_experiments(base, trace, with_it, PROBES)
    assert experiment.separates == ("k_xx", "head_eccentricity")
    assert experiment.command == "tumble run --programme probe-face-up-90 --serial SERIAL"
    assert experiment.separation > APART
    assert shown(experiment) == [("k_xx", "head_eccentricity", pytest.approx(experiment.separation))]
    assert experiment.outlook.rows.mounts[experiment.outlook.probed].tolist() == ["face-up-90"] * 240
    assert len(experiment.outlook.rows) == len(base.joint.observations) + 240
    _, _, after = traced(runs(own, "probe-face-up-90", extra_v=k_xx, seed=2))
    assert behind(after, "k_xx", "head_eccentricity") > experiment.separation / 4


def test_squares_of_the_three_projections_are_distinguished_by_another_mount():
    own = programme(FLIPS, UP, realisations=3)

    def square(columns):
        return 2 * k_xx(columns)

    base, trace, found = traced(runs(own, extra_v=square))
    name = next(iter(found))
    squares = [rival for rival in found[name] if rival.name in {"k_xx", "k_yy", "k_zz"}]
    assert all(rival.behind < CLOSE for rival in squares)
    (experiment,) = next_experiments(base, trace, {name: squares}, PROBES)
    assert BY_NAME[experiment.programme].mount != "face-up"
    _, _, after = traced(runs(own, experiment.programme, extra_v=square))
    assert {"k_yy", "k_zz"} & {rival.name for rival in after.get("k_xx", []) if rival.behind < CLOSE} == set()
    assert "k_xx" in after


def test_what_only_the_voltmeter_can_separate_is_said_and_has_no_command():
    def cube(columns):
        return 4e-4 * ax_g(columns) ** 3

    base, trace, found = traced(runs(programme(FLIPS, BACK, DOWN, realisations=2), extra_v=cube))
    (name,) = found
    nonlinear = {name: [rival for rival in found[name] if rival.name == "daq_nonlinearity"]}
    (experiment,) = next_experiments(base, trace, nonlinear, [BY_NAME["probe-end"]])
    assert (experiment.programme, experiment.command) == ("", "")
    assert "exchange one of these" in experiment.why
    assert experiment.outlook is None


def test_many_runs_that_are_likely_to_tell_are_proposed_though_nothing_is_promised(monkeypatch):
    def separations(mounts):
        return [[0.6 * (len(mounts) - 1)]] * 2

    proposed = next_experiments_of(monkeypatch, ("b",), separations)

    assert sum(each.runs for each in proposed) == 5  # of three realisations each, 1.8 in -2 ln L a run: 9 of 16
    assert all(each.why.endswith("; so much is likely, but not sure") for each in proposed)


def test_what_is_likely_is_more_than_what_is_promised():
    base, trace, found = traced(runs(programme(FLIPS, BACK, DOWN, realisations=2), extra_v=k_xx, seed=2))
    (rival,) = (rival for rival in found["k_xx"] if rival.name == "head_eccentricity")
    question = Question(base, trace, "k_xx", [rival])
    then = question.expected(question.table.followed_by(BY_NAME["probe-end"]))
    assert (then.promises < then.likely).all()


def test_a_wave_cannot_bend_into_more_than_the_longest_that_is_looked_for():
    def cube(columns):
        return 4e-4 * ax_g(columns) ** 3

    base, trace, found = traced(runs(programme(FLIPS, BACK, DOWN, realisations=2), extra_v=cube, noise_v=4e-5))
    (rival,) = (rival for rival in found["k_xxx"] if rival.name == "daq_nonlinearity")
    question = Question(base, trace, "k_xxx", [rival])

    (if_found,), (if_rival,) = question.separations(question.table)

    assert if_found == pytest.approx(if_rival, rel=0.2)
    assert if_rival == pytest.approx(9.4, rel=0.1)


class Stub(Question):
    """A question whose separations depend on the mounts that were visited, and on how often."""

    dwell_v = 1e-4

    def __init__(self, names, separations):
        self.name, self.rivals, self._separations = "a", names, separations
        self.table = PlannedRows(rows=short_table(), weights=np.ones(2), programmes=np.full(2, ""))

    def belongs_to(self, name):
        return "unit"

    def expected(self, rows):
        there = self.separations(rows)
        return Expected(separations=there, promises=there, likely=there)

    def left(self, rows):
        realisations = rows.rows.realisations[:, None]
        visited = np.unique(np.column_stack([rows.rows.mounts[:, None], realisations.astype(str)]), axis=0)
        separations = np.array(self._separations([mount for mount, _ in visited]), dtype=float)
        count = len(rows.rows)
        return np.repeat(np.sqrt(np.expm1(separations / count))[:, None, :], count, axis=1)


def answers(monkeypatch, names, separations):
    monkeypatch.setattr(experiments, "Question", lambda *_: Stub(names, separations))
    return [
        (experiment.programme, experiment.separates, experiment.why.partition(" standard deviations")[2])
        for experiment in next_experiments(None, None, {"a": ["some"]}, PROBES)
    ]


def test_experiments_are_proposed_until_every_rival_is_distinguished(monkeypatch):
    def separations(mounts):
        each = [20.0 * ("edge" in mounts), 20.0 * ("end" in mounts), 20.0 * ("end" in mounts)]
        return [each, each]

    assert answers(monkeypatch, ("b", "c", "d"), separations) == [
        ("probe-end", ("a", "c", "d"), ""),
        ("probe-edge", ("a", "b"), ""),
    ]


def test_two_mounts_are_proposed_together_where_neither_separates_anything_alone(monkeypatch):
    def separations(mounts):
        return [[20.0 * ({"face-down", "edge"} <= set(mounts))]] * 2

    assert answers(monkeypatch, ("b",), separations) == [
        ("probe-face-down", ("a", "b"), "; only together with probe-edge"),
        ("probe-edge", ("a", "b"), "; only together with probe-face-down"),
    ]


def test_a_probe_is_run_several_times_where_once_is_not_enough(monkeypatch):
    def separations(mounts):
        return [[2.5 * mounts.count("edge")]] * 2

    assert answers(monkeypatch, ("b",), separations) == [("probe-edge", ("a", "b"), "; run it 3 times")]


def test_the_smallest_difference_that_is_shown_is_the_separation_that_is_stated(monkeypatch):
    def separations(mounts):
        return [[40.0 * ("edge" in mounts), 30.0 * ("edge" in mounts)], [20.0, 50.0]]

    monkeypatch.setattr(experiments, "Question", lambda *_: Stub(("b", "c"), separations))
    (experiment,) = next_experiments(None, None, {"a": ["some"]}, PROBES)
    assert shown(experiment) == [("b", "a", pytest.approx(20.0)), ("a", "c", pytest.approx(30.0))]
    assert experiment.separation == pytest.approx(20.0)


def test_of_two_mounts_each_shows_its_own_rows(monkeypatch):
    def separations(mounts):
        return [[20.0 * ({"face-down", "edge"} <= set(mounts))]] * 2

    monkeypatch.setattr(experiments, "Question", lambda *_: Stub(("b",), separations))
    proposed = next_experiments(None, None, {"a": ["some"]}, PROBES)
    seen = [set(each.outlook.rows.mounts[each.outlook.probed].tolist()) for each in proposed]
    assert seen == [{"face-down"}, {"edge"}]


def test_an_experiment_that_separates_only_if_the_rival_is_true_says_so(monkeypatch):
    def separations(mounts):
        return [[0.0], [30.0 * ("edge" in mounts)]]

    assert answers(monkeypatch, ("b",), separations) == [("probe-edge", ("a", "b"), ", if b is the true one")]
    (experiment,) = next_experiments(None, None, {"a": ["some"]}, PROBES)
    assert shown(experiment) == [("b", "a", pytest.approx(30.0))]


def test_a_later_pass_parts_what_jumps_from_what_drifts():
    def jumps(columns):
        return np.array([-1.0, 0.1, 0.9])[columns["realisation"] - 1] * 1e-4

    base, trace, found = traced(runs(programme(UP, realisations=3), extra_v=jumps))
    (name,) = found
    others = [rival for rival in found[name] if rival.name in {"bias_drift", "bias_random_walk", "realisation_bias"}]
    question = Question(base, trace, name, others)
    now, later = (
        question.separations(rows) for rows in (question.table, question.table.followed_by(BY_NAME["probe-later"]))
    )
    assert (later.max(axis=0) > now.max(axis=0)).all()


@pytest.mark.parametrize("separates", ["both", "either", "neither"])
def test_why_an_experiment_is_proposed_reads_as_a_sentence(monkeypatch, separates):
    """Programmes and effects have their names in it, and nothing else is a word of the program."""

    def separations(mounts):
        told = {"both": [30.0, 40.0], "either": [0.0, 40.0], "neither": [1.0, 2.0]}[separates]
        return [[0.0, told[0]], told] if "edge" in mounts else [[0.0, 0.0], [0.0, 0.0]]

    monkeypatch.setattr(experiments, "Question", lambda *_: Stub(("k_yy", "graduation"), separations))
    for experiment in next_experiments(None, None, {"a": ["some"]}, PROBES):
        words = experiment.why
        for name in (experiment.programme, "k_yy", "graduation"):
            words = words.replace(name, "NAME") if name else words
        assert re.fullmatch(r"[A-Za-z0-9 ,:;.°-]+", words)
        assert not words.endswith(".")
        assert "  " not in words
        assert (experiment.command == "") == experiment.why.startswith("no programme that comes along tells a from")


@pytest.mark.parametrize(
    ("products", "least"),
    [
        ([[25.0]], 25.0),
        ([[25.0, 5.0], [5.0, 1.0]], 16.0),
        ([[0.25, 0.5], [0.5, 1.0]], 0.0),
        ([[25.0, 0.0], [0.0, 4.0]], 25.0),
        ([[26.0, 5.0, 1.0], [5.0, 1.0, 0.0], [1.0, 0.0, 1.0]], (26.0**0.5 - 1.0) ** 2),
    ],
    ids=["nothing unknown", "its size", "within its uncertainty", "across it", "its size and something across"],
)
def test_the_least_that_an_effect_would_show_is_what_its_uncertainty_leaves(products, least):
    """|l + Ld|² for |d| up to 1, by hand: 5 less 1, say, or a vector of length √26 less 1."""
    assert nearest_to_nothing(np.array(products), 1.0) == pytest.approx(least, abs=1e-6)


def test_a_promise_counts_on_from_what_is_there_and_is_less_than_what_the_fit_says():
    base, trace, found = traced(runs(programme(FLIPS, BACK, DOWN, realisations=2), extra_v=k_xx, seed=2))
    (rival,) = (rival for rival in found["k_xx"] if rival.name == "head_eccentricity")
    question = Question(base, trace, "k_xx", [rival])
    now, then = (question.expected(rows) for rows in (question.table, question.table.followed_by(BY_NAME["probe-end"])))
    assert now.promises == pytest.approx(np.array([[rival.behind], [-rival.behind]]), abs=1e-6)
    assert (then.promises - now.promises < then.separations - now.separations).all()
    assert (then.promises > now.promises + APART).all()


def test_many_runs_that_each_tell_a_little_are_planned_together(monkeypatch):
    def separations(mounts):
        return [[1.2 * (len(mounts) - 1)]] * 2

    proposed = next_experiments_of(monkeypatch, ("b",), separations)
    assert sum(each.runs for each in proposed) == 5  # of three realisations each, 3.6 in -2 ln L a run


def test_what_a_reasonable_number_of_runs_would_tell_is_advised(monkeypatch):
    def separations(mounts):
        return [[0.5 * mounts.count("edge")]] * 2

    (experiment,) = next_experiments_of(monkeypatch, ("b",), separations)
    assert (experiment.command, experiment.remedy) == ("", "run probe-edge some 11 times")
    assert experiment.why.endswith("; run probe-edge some 11 times")


def next_experiments_of(monkeypatch, names, separations):
    monkeypatch.setattr(experiments, "Question", lambda *_: Stub(names, separations))
    return next_experiments(None, None, {"a": ["some"]}, PROBES)


def test_a_probe_that_holds_its_rows_is_planned_for_like_any_other(monkeypatch):
    """An array in it has no hash."""

    class Held:
        programme, does, command, stand_time_s, pairs = "held", "holds", "run it", 10.0, False
        __hash__ = None

        def after(self, rows):
            return BY_NAME["probe-edge"].after(rows)

    monkeypatch.setattr(
        experiments, "Question", lambda *_: Stub(("b",), lambda mounts: [[2.5 * mounts.count("edge")]] * 2)
    )
    (experiment,) = next_experiments(None, None, {"a": ["some"]}, [Held()])
    assert (experiment.programme, experiment.runs) == ("held", 3)
