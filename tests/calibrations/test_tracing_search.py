"""WhitenedFit, problem and search: the same answers as a plain least-squares fit, only faster."""

from dataclasses import replace

import numpy as np
import pytest
from tables import FLIPS, UNIT, gravity_on, sweep, table

from tumble.calibrations.core.compression import compress
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.fit import joint_fit
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.tracing.neighbours import neighbours
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.problem import Problem
from tumble.calibrations.tracing.rivals import put_back
from tumble.calibrations.tracing.search import begun_anew, penalised, penalties, runners_up, search, settled
from tumble.calibrations.tracing.trace import Tracer, found, refined

WHITE = NoiseModel()


def bent(mount, angle_deg):
    return 4e-4 * gravity_on(mount, angle_deg)[0] ** 2


@pytest.fixture(scope="module")
def tracer():
    rows = table(*FLIPS, sweep("face-up"), sweep("face-down"), sweep("face-up-90"), extra_v=bent)
    return Tracer(dividing_head_table(fit_jointly(rows), CATALOGUE))


def numbers(tracer, name):
    return [number for number, offered in enumerate(tracer.offered) if offered.effect.name == name]


def test_a_set_of_effects_is_fitted_as_by_the_joint_fit(tracer):
    problem, joint = tracer.problem(WHITE), tracer.table.joint
    chosen = (numbers(tracer, "k_xx")[0], numbers(tracer, "graduation")[4])
    explained = problem.explain(chosen)
    columns = np.column_stack([tracer.table.declared, tracer.columns[:, problem.columns_of(chosen)]])
    plain = joint_fit(compress(columns, joint.observations.output_v, joint.weights))

    assert problem.parameters(explained) == pytest.approx(plain.theta, rel=1e-6, abs=1e-9)
    assert explained.fit.squares == pytest.approx(plain.squares_v2, rel=1e-9)


@pytest.mark.parametrize("name", ["k_xx", "backlash", "graduation", "daq_nonlinearity", "realisation_bias"])
def test_a_gain_is_what_adding_the_effect_brings(tracer, name):
    problem = tracer.problem(WHITE)
    nothing = problem.explain(())
    number = numbers(tracer, name)[0]
    added = problem.explain((number,))

    assert problem.gains(nothing)[number] == pytest.approx(nothing.deviance - added.deviance, rel=1e-3, abs=0.05)


def test_an_effect_that_is_there_has_nothing_left_to_gain(tracer):
    problem = tracer.problem(WHITE)
    there = problem.explain((numbers(tracer, "k_xx")[0],))

    assert problem.gains(there)[numbers(tracer, "k_xx")[0]] == 0.0


def test_the_search_ends_with_the_cheapest_set(tracer):
    problem = tracer.problem(WHITE)
    found = search(problem)

    assert [problem.offered[number].effect.name for number in found.chosen] == ["k_xx"]
    assert penalised(problem, found) == found.deviance + penalties([problem.offered[number] for number in found.chosen])


def test_the_sets_that_were_followed_are_given_once_each_the_cheapest_first(tracer):
    problem = tracer.problem(WHITE)
    listed = list(runners_up(problem))
    names = [frozenset(problem.offered[number].effect.name for number in each.chosen) for each in listed]

    assert names[0] == {"k_xx"}
    assert len(set(names)) == len(names)
    assert [penalised(problem, each) for each in listed] == sorted(penalised(problem, each) for each in listed)


def test_an_effect_in_two_forms_stays_a_rival_of_the_simpler_one_that_it_was_exchanged_for(tracer):
    problem, trace = tracer.problem(WHITE), tracer.trace()
    forms = [found(problem, number) for number in numbers(tracer, "graduation")[1:3]]
    rival = put_back(tracer, trace, "k_xx", forms)
    fitted = problem.explain(tuple(item.number for item in forms)).deviance

    assert (rival.name, rival.trace.names) == ("graduation", ("graduation",))
    assert rival.behind == pytest.approx(fitted - trace.deviance + 2.0 * (sum(each.coefficients for each in forms) - 1))


def test_a_set_of_other_effects_that_the_search_followed_is_a_neighbour(tracer):
    """Of two effects of which neither is there, the search followed the one that is."""
    problem = tracer.problem(WHITE)
    pair = tuple(found(problem, numbers(tracer, name)[0]) for name in ("hysteresis", "settling"))
    worse = refined(tracer.table, replace(tracer.trace(), found=pair))
    others = [set(each.trace.names) for each in neighbours(tracer, worse, {}, ())]

    assert {"k_xx"} in others


@pytest.mark.parametrize("rounding_v", [1e-12, -1e-12])
def test_of_two_that_fit_alike_the_first_is_taken_however_rounding_falls(tracer, rounding_v):
    curve = tracer.columns[:, numbers(tracer, "k_xx")[0]]
    offered = [
        replace(tracer.offered[numbers(tracer, name)[0]], columns=slice(place, place + 1))
        for place, name in enumerate(["k_xx", "k_yy"])
    ]
    alike = np.column_stack([curve, curve + rounding_v * np.sign(tracer.table.joint.residual_v)])
    whole = tracer.table.whole
    found = search(Problem(whole.whitened_fit(WHITE), whole.turned(alike), offered, 2), beam=1)

    assert found.chosen == (0,)


def found_in(extra_v, realisations):
    sweeps = sweep("face-up"), sweep("face-down"), sweep("face-up-90")
    rows = table(*FLIPS, *sweeps, realisations=realisations, seed=4, extra_v=extra_v)
    problem = Tracer(dividing_head_table(fit_jointly(rows), CATALOGUE)).problem(WHITE).named()
    found = begun_anew(problem, search(problem))
    return {problem.offered[number].effect.name for number in found.chosen}


def test_a_step_and_a_wave_of_one_voltage_are_found_together():
    """Each alone is put where the other is missing, and a parabola and an asymmetry are added to that."""

    def wave_and_step(mount, angle_deg):
        ax, _, _ = gravity_on(mount, angle_deg)
        return 1e-4 * np.sin(2 * np.pi * ax / 0.95 + 1.7) + np.where(ax > -0.64, 1.5e-4, 0.0)

    assert found_in(wave_and_step, realisations=2) == {"daq_nonlinearity", "range_step"}


def test_six_effects_at_once_are_found():
    def six(mount, angle_deg):
        ax, _, _ = gravity_on(mount, angle_deg)
        error_deg = 0.012 * np.sin(np.deg2rad(9 * angle_deg)) + 0.012 * np.sin(np.deg2rad(2 * angle_deg + 40.0))
        head = gravity_on(mount, angle_deg + error_deg)[0] - ax
        return head + 2e-4 * np.sin(2 * np.pi * ax / 0.31) + np.where(ax > 0.3, 3e-4, 0.0) + 4e-4 * ax**2 + 6e-4 * ax**3

    assert found_in(six, realisations=5) == {
        "graduation", "head_second_harmonic", "daq_nonlinearity", "range_step", "k_xx", "k_xxx",
    }  # fmt: skip


def test_an_effect_that_only_mends_the_form_of_another_is_dropped():
    rows = table(*FLIPS, sweep("face-up"), sweep("face-down", -5.0), seed=2)
    plain = dividing_head_table(fit_jointly(rows), CATALOGUE)
    lagging = replace(rows, voltage_v=rows.voltage_v + 3e-4 * plain.scene.play(0.03))
    tracer = Tracer(dividing_head_table(fit_jointly(lagging), CATALOGUE))
    problem, kept = tracer.problem(WHITE), numbers(tracer, "hysteresis")[-1]
    mended = problem.explain((kept, numbers(tracer, "k_yy")[0], numbers(tracer, "k_xxx")[0]))

    (found,) = settled(problem, mended).chosen

    assert problem.offered[found].form.scanned == {"reach_g": 0.03}


def test_what_only_two_rows_could_show_is_not_on_offer():
    """Of az there is ±1 alone in the z flips: ax az is nothing but the two rows that were read a little wrong there."""
    rows = table(*FLIPS, sweep("face-up"), sweep("face-down"), unit=dict(UNIT, alpha0=0.0))
    angle_deg = rows.angle_deg.copy()
    angle_deg[4:6] += 0.02, 0.05
    offered = Tracer(dividing_head_table(fit_jointly(replace(rows, angle_deg=angle_deg)), CATALOGUE)).offered
    names = {candidate.effect.name for candidate in offered}

    assert "k_xx" in names
    assert "k_xz" not in names
