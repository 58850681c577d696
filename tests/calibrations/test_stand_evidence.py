from dataclasses import replace

import numpy as np
import pytest
from stand_examples import ANOTHER, STAND, eccentric_deg, eccentric_run, rows, run_on

from tumble.calibrations.methods.dividing_head.budget import StandUncertainty
from tumble.calibrations.methods.dividing_head.stand.evidence import Run, doubts
from tumble.calibrations.stand_records.agreement import agreement, updated
from tumble.calibrations.stand_records.corrections import Corrections, corrections_from_json
from tumble.calibrations.stand_records.terms import Term, harmonic_term, head_course, union

ECCENTRICITY = harmonic_term(1)
SINE, COSINE = 0.05 * np.cos(np.deg2rad(30.0)), 0.05 * np.sin(np.deg2rad(30.0))
PERIOD_V = 1.1


def one(term, *values, variance):
    return Corrections(terms=(term,), values=np.array(values), covariance=np.eye(len(values)) * variance)


def test_a_run_tells_the_effects_of_its_stand():
    run = eccentric_run()

    assert run.terms == (ECCENTRICITY,)
    assert run.objections == ()


def test_an_estimate_is_the_truth_within_its_uncertainty():
    estimate = eccentric_run().estimate([ECCENTRICITY])

    off = (estimate.values - [SINE, COSINE]) / np.sqrt(np.diag(estimate.covariance))
    assert np.abs(off).max() < 3.0
    assert 1e-4 < np.sqrt(estimate.covariance[0, 0]) < 2e-3


def test_the_uncertainty_of_seat_and_voltmeter_is_in_the_estimate_and_that_of_the_head_is_not():
    whole = rows()
    observations = whole.select((whole.mounts == "face-up-90") | (whole.angle_deg < 120.0))
    variance = {
        name: run_on(observations, stand).estimate([ECCENTRICITY]).covariance[0, 0]
        for name, stand in {
            "nothing": StandUncertainty(),
            "head": StandUncertainty(head_accuracy_arcsec=60.0),
            "seat": StandUncertainty(seating_arcsec=60.0),
        }.items()
    }

    assert variance["head"] == pytest.approx(variance["nothing"])
    assert variance["seat"] > 2 * variance["nothing"]


def test_what_a_run_cannot_tell_is_left_out_of_its_estimate():
    forward = rows()
    forward = forward.select(forward.direction > 0)

    assert run_on(forward).estimate([ECCENTRICITY, Term(effect="backlash")]).terms == (ECCENTRICITY,)


def test_an_effect_with_rivals_is_mentioned_and_not_taken():
    run = eccentric_run()
    (effect,) = run.loop.effects
    doubtful = replace(run, loop=replace(run.loop, effects=(replace(effect, also_possible=("k_xx",)),)))

    assert doubtful.terms == ()
    assert doubts(doubtful) == [
        "in this run alone head_eccentricity is not distinguishable from k_xx: by itself it says nothing of it"
    ]


def test_a_cut_run_is_no_evidence():
    run = run_on(replace(rows(), complete=False))

    assert run.objections == ("it was cut off",)


def test_two_units_that_agree_know_more_together():
    first, second = eccentric_run(), eccentric_run(2, True)
    found = agreement(first, second)

    assert found.holds
    assert found.corrections.terms == (ECCENTRICITY,)
    spreads = [float(np.trace(each.covariance)) for each in found.each]
    assert np.trace(found.corrections.covariance) == pytest.approx(1 / sum(1 / spread for spread in spreads), rel=0.05)


def test_two_units_with_another_head_each_do_not_agree():
    found = agreement(eccentric_run(), eccentric_run(2, True, 0.06))

    assert not found.holds
    assert found.p_value < 1e-6


def test_what_only_one_unit_sees_is_not_agreed_on():
    straight = run_on(rows(2, ANOTHER, error_deg=lambda angle: 0.0 * angle))
    found = agreement(eccentric_run(), straight)

    assert not found.holds
    assert found.corrections.terms == ()


def test_an_error_without_a_simple_shape_becomes_the_harmonics_that_it_has():
    def bent_deg(angle):
        return eccentric_deg(angle) + eccentric_deg(4 * angle, 0.03)

    class Unshaped(Run):
        terms = (head_course(11),)

    runs = (run_on(rows(seed, unit, bent_deg)) for seed, unit in ((1, ANOTHER), (2, {**ANOTHER, "kx": 1.0})))
    found = agreement(*(Unshaped(**vars(run)) for run in runs))

    assert found.holds
    assert found.corrections.terms == (harmonic_term(1), harmonic_term(4))


def test_a_wave_of_the_voltmeter_has_its_period():
    def wave_v(volts, _mounts):
        return 1e-3 * np.sin(2 * np.pi * volts / PERIOD_V)

    run = run_on(rows(error_deg=lambda angle: 0.0 * angle, added_v=wave_v), STAND)

    (term,) = run.terms
    estimate = run.estimate([term])
    assert term.scanned["period_V"] == pytest.approx(PERIOD_V, rel=0.01)
    assert np.hypot(*estimate.values) == pytest.approx(1e-3, rel=0.1)
    assert not term.of_angle


def test_terms_of_two_runs_are_put_together_and_a_scanned_value_halfway():
    first, second = (Term(effect="range_step", scanned={"threshold_V": volts}) for volts in (2.6, 2.7))

    (step, wave) = union((first,), (second, harmonic_term(7)))

    assert step.scanned == {"threshold_V": pytest.approx(2.65)}
    assert wave.label == "graduation (7 per turn)"


def test_a_course_of_the_head_holds_single_harmonics():
    assert union((harmonic_term(2), Term(effect="backlash")), (head_course(5),)) == (
        head_course(5),
        Term(effect="backlash"),
    )


def test_an_update_is_a_weighted_mean():
    known = one(ECCENTRICITY, 1.0, 0.0, variance=1.0)
    mean, p_value = updated(known, one(ECCENTRICITY, 2.0, 0.0, variance=0.25))

    assert mean.values == pytest.approx([1.8, 0.0])
    assert mean.covariance == pytest.approx(np.eye(2) * 0.2)
    assert p_value == pytest.approx(np.exp(-0.4))


def test_an_update_of_one_term_moves_what_hangs_together_with_it():
    terms = (Term(effect="backlash"), Term(effect="axis_tilt"))
    known = Corrections(terms=terms, values=np.zeros(2), covariance=np.array([[1.0, 0.5], [0.5, 1.0]]))

    mean, _ = updated(known, one(terms[1], 1.0, variance=1.0))

    assert mean.values == pytest.approx([0.25, 0.5])


@pytest.mark.parametrize(
    ("corrections", "text"),
    [
        (one(Term(effect="axis_tilt"), 0.0, variance=1e-6), "axis_tilt 0.0000(10)°"),
        (one(ECCENTRICITY, 0.0, 0.05, variance=1e-6), "head_eccentricity amplitude 0.0500(10)°, phase 90°"),
        (one(harmonic_term(7), -0.01, 0.0, variance=1e-6), "graduation (7 per turn) amplitude 0.0100(10)°, phase 180°"),
        (one(head_course(2), 0.03, 0.0, 0.04, 0.0, variance=1e-6),
         "an error of the head of any shape (1 to 2 per turn) amplitude 0.0500(10)°"),
        (one(Term(effect="range_step", scanned={"threshold_V": 2.7}), 5e-4, variance=1e-12),
         "range_step (threshold 2.7 V) 500.0(10) µV"),
    ],
)  # fmt: skip
def test_a_term_is_told_with_its_size(corrections, text):
    assert corrections.text(corrections.terms[0]) == text


def test_a_course_of_the_head_has_its_place_among_harmonics():
    known = one(ECCENTRICITY, 0.05, 0.0, variance=1e-6)
    play, wave = Term(effect="backlash"), harmonic_term(7)

    assert known.without_a_place_for([ECCENTRICITY, head_course(11), play, wave]) == [play, wave]


def test_corrections_come_back_from_json():
    estimate = eccentric_run().estimate([ECCENTRICITY])

    again = corrections_from_json(estimate.as_json())

    assert again.terms == estimate.terms
    assert again.values.tolist() == estimate.values.tolist()
    assert again.covariance.tolist() == estimate.covariance.tolist()
