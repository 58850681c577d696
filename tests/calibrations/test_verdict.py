"""The verdict: which numbers may decide, and which may not."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from loop_examples import clean, found, misread, with_k_xx
from tables import FLIPS, UNIT, gravity_on, sweep, table

from tumble.calibrations.core.provenance import LimitCheck
from tumble.calibrations.core.verdict import verdict_from_json
from tumble.calibrations.methods.dividing_head.judging import judge
from tumble.calibrations.methods.dividing_head.loop.loop import Loop, close_loop
from tumble.calibrations.tracing.findings import Unexplained

SEED = (*FLIPS, sweep("face-up", 10.0))
REVERSAL = (*SEED, sweep("face-down", 10.0))
SWEEP = (sweep("face-up", 10.0),)
DESIGNS = {"seed": SEED, "reversal": REVERSAL, "sweep": SWEEP}


def limit(name, minimum, maximum):
    return LimitCheck(name=name, minimum=minimum, maximum=maximum, inside=False)


KY = limit("ky", -0.03, 0.03)


def of_gravity(axis, power, size):
    """An undeclared term of the unit, in V."""
    return lambda mount, angle_deg: size * gravity_on(mount, angle_deg + UNIT["alpha0"])[axis] ** power


def of_the_head(amplitude_deg, order, phase_deg):
    """An undeclared error of the head: the reported angle falls short of the true one by it."""

    def extra_v(mount, angle_deg):
        error_rad = np.deg2rad(amplitude_deg * np.sin(np.deg2rad(order * angle_deg + phase_deg)))
        along, further = (gravity_on(mount, angle_deg + UNIT["alpha0"] + turn)[0] for turn in (0.0, 90.0))
        return along * (np.cos(error_rad) - 1.0) + further * np.sin(error_rad)

    return extra_v


def of_the_axis(tilt_deg):
    """An undeclared tilt of the head's axis: gravity along it, of which each mount feels another axis."""
    along = {"face-up": 0.002, "face-down": -0.002, "edge": -0.0098}
    return lambda mount, angle_deg: np.full(len(angle_deg), np.deg2rad(tilt_deg) * along[mount])


UNDECLARED = {
    "k_xx": of_gravity(0, 2, 2e-3),
    "small k_xx": of_gravity(0, 2, -1e-4),
    "k_yy": of_gravity(1, 2, 2e-3),
    "axis_tilt": of_the_axis(0.5),
    "eccentricity": of_the_head(0.1, 1, 90.0),
    "second harmonic": of_the_head(0.1, 2, 0.0),
}

HIDDEN = list(zip(UNDECLARED, (0.0098, 0.06, 0.06, 0.06, 0.0098, 0.0098), strict=True))
"""Each with a good or a bad unit."""


@cache
def loop_of(design, effect="", ky=0.0098, seed=1):
    """A unit with something undeclared in it, measured by a design."""
    parts = DESIGNS[design]
    return close_loop(table(*parts, unit=dict(UNIT, ky=ky), extra_v=UNDECLARED.get(effect), seed=seed, realisations=5))


def verdict(loop: Loop, *limits):
    return judge(loop.declared, limits, loop)


def only(loop: Loop, limits):
    (judgement,) = verdict(loop, limits).parameters
    return judgement


def with_parameter(loop, name, **changes):
    def changed(calibration):
        parameters = {**calibration.parameters, name: replace(calibration.parameters[name], **changes)}
        return replace(calibration, parameters=parameters)

    return replace(loop, declared=changed(loop.declared), augmented=changed(loop.augmented))


def with_augmented(loop, **changes):
    return replace(loop, augmented=replace(loop.augmented, **changes))


def test_a_bad_unit_does_not_pass_by_a_value_that_rests_on_the_curvature():
    judgement = only(loop_of("seed", "small k_xx", ky=0.06), KY)

    assert judgement.outcome == "not_decided"
    assert judgement.reason.startswith("it rests on kxy alone: identifiable through the curvature kxy alone")
    assert judgement.remedy.startswith(
        "one sweep in face-down, edge-back or end would settle it: tumble run --programme"
    )


def test_a_good_unit_does_not_fail_by_a_value_that_the_loop_withdraws():
    loop = loop_of("seed", "k_xx")
    assert loop.declared.parameters["ky"].value == pytest.approx(0.535, abs=0.01)

    found_verdict = verdict(loop, KY)

    assert (found_verdict.judged, found_verdict.outcome) == ("augmented", "not_decided")
    (judgement,) = found_verdict.parameters
    assert judgement.reason.startswith("no value: it differs between k_xx and")
    assert judgement.remedy.startswith("tumble run --programme probe-")


@pytest.mark.parametrize(("effect", "ky"), HIDDEN)
@pytest.mark.parametrize("design", DESIGNS)
def test_no_undeclared_effect_turns_a_verdict(design, effect, ky):
    truth = dict(UNIT, ky=ky)
    limits = [limit("u0", 2.4995, 2.5005), KY, limit("kxy", 0.0, 0.002), limit("alpha0", -1.0, 1.0)]

    for check, judgement in zip(limits, verdict(loop_of(design, effect, ky), *limits).parameters, strict=True):
        wrong = "fail" if check.minimum <= truth[check.name] <= check.maximum else "pass"
        assert judgement.outcome != wrong, judgement.sentence


@pytest.mark.parametrize("seed", [1, 2])
def test_a_clean_unit_passes_and_a_bad_one_fails(seed):
    limits = [limit("kx", 0.95, 1.05), KY, limit("kz", -0.03, 0.03), limit("u0", 2.49, 2.51)]

    good, bad = (verdict(loop_of("reversal", ky=ky, seed=seed), *limits) for ky in (0.0098, 0.06))

    assert (good.outcome, good.judged) == ("pass", "declared")
    assert (bad.outcome, bad.named("fail")) == ("fail", ("ky",))


def test_a_sweep_alone_does_not_decide_on_what_k_xx_would_imitate():
    judgement = only(loop_of("sweep"), limit("u0", 2.4995, 2.5005))

    assert judgement.outcome == "not_decided"
    assert judgement.reason.startswith("it rests on the absence of k_xx, which these data cannot show")


def test_it_decides_where_no_such_effect_could_carry_it_over_the_limits():
    assert only(loop_of("sweep"), limit("u0", 2.49, 2.51)).outcome == "pass"
    assert only(loop_of("sweep"), limit("u0", 2.6, 2.7)).outcome == "fail"


def test_with_effects_found_the_augmented_model_is_judged():
    found_verdict = verdict(with_k_xx(), limit("ky", 0.0, 0.02), limit("kx", 1.1, 1.2))

    assert found_verdict.judged == "augmented"
    assert [each.outcome for each in found_verdict.parameters] == ["pass", "fail"]
    assert verdict(misread(), KY).judged == "augmented"


def test_what_the_loop_withholds_decides_nothing_though_nothing_was_found():
    loop = with_augmented(clean(), parameters={**clean().augmented.parameters, "ky": withheld("ky")})

    judgement = only(loop, KY)

    assert (judgement.outcome, judgement.reason) == ("not_decided", "no value: nobody knows")


def withheld(name):
    parameter = clean().augmented.parameters[name]
    nothing = {"value": None, "standard_uncertainty": None, "interval_95": None}
    return replace(parameter, **nothing, reason="nobody knows")


@pytest.mark.parametrize(
    ("changes", "reason"),
    [
        ({"given": {"alpha0": 0.0}}, "it stands for alpha0 = 0° only"),
        ({"rests_on": "kxy"}, "it rests on kxy alone"),
    ],
)
def test_a_conditional_value_decides_nothing(changes, reason):
    judgement = only(with_parameter(clean(), "ky", **changes), KY)

    assert (judgement.outcome, judgement.reason) == ("not_decided", reason)


@pytest.mark.parametrize(
    ("p_value", "reason"),
    [(0.0099, "the declared model does not describe the poses (lack of fit: p = 0.0099)"), (0.9995, "repeats scatter")],
)
def test_a_model_that_the_data_contradicts_decides_nothing(p_value, reason):
    declared = replace(clean().declared, lack_of_fit_p=p_value)

    (judgement,) = judge(declared, [KY], replace(clean(), declared=declared)).parameters

    assert judgement.outcome == "not_decided"
    assert judgement.reason.startswith(reason)


def test_flips_that_do_not_close_decide_nothing():
    declared = replace(clean().declared, closure=replace(clean().declared.closure, p_value=5e-4))

    (judgement,) = judge(declared, [KY], replace(clean(), declared=declared)).parameters

    assert judgement.reason == "the flips do not agree on u0 (p = 0.00050)"


def test_the_augmented_model_may_be_contradicted_too():
    judgement = only(with_augmented(with_k_xx(), lack_of_fit_p=1e-5), KY)

    assert judgement.reason.startswith("the model with what was found does not describe the poses")


def test_without_a_loop_the_tests_of_the_fit_itself_stand_in_its_way():
    (judgement,) = judge(with_k_xx().declared, [limit("kx", 0.9, 1.1)]).parameters

    assert judgement.reason.startswith("the declared model does not describe the poses")


def test_what_no_effect_explains_leaves_nothing_decided():
    loop = replace(clean(), unexplained=Unexplained(depends_on="angle", description="a bump near 141 deg"))

    judgement = only(loop, KY)

    assert judgement.outcome == "not_decided"
    assert judgement.reason == "no effect of the catalogue explains what depends on angle: a bump near 141 deg"
    assert judgement.remedy


def test_a_table_that_contradicts_its_own_description_decides_nothing():
    rows = table(*REVERSAL, realisations=3)
    loop = close_loop(replace(rows, angle_deg=np.deg2rad(rows.angle_deg)))
    assert loop.not_traced

    assert only(loop, KY).outcome == "not_decided"


@pytest.mark.parametrize(
    ("minimum", "maximum", "outcome"),
    [
        (0.0, 0.01, "pass"),  # a limit belongs to the better zone
        (0.0099, 0.0101, "not_decided"),  # an interval of 0.8 mV/g in a tolerance of 0.2 mV/g
        (0.0096, 0.0104, "pass"),  # as wide as the tolerance: C_m = 1
        (0.0, 0.0099, "fail"),
        (0.011, 0.0111, "fail"),  # wide, but surely outside
        (None, 0.0101, "pass"),
        (0.0101, None, "fail"),
        (None, 0.0001, "fail"),
        (-0.0001, None, "pass"),
    ],
)
def test_simple_acceptance_needs_an_uncertainty_that_these_limits_support(minimum, maximum, outcome):
    loop = with_parameter(clean(), "ky", value=0.01, standard_uncertainty=2e-4, interval_95=(0.0096, 0.0104))

    assert only(loop, limit("ky", minimum, maximum)).outcome == outcome


def test_one_limit_near_zero_is_decided_only_by_what_lies_wholly_on_one_side():
    loop = with_parameter(clean(), "ky", value=0.001, standard_uncertainty=5e-3, interval_95=(-0.009, 0.011))

    judgement = only(loop, limit("ky", None, 0.002))

    assert judgement.outcome == "not_decided"
    assert judgement.reason == "the uncertainty is too large for up to 2 mV/g: the 95% interval is -9 to 11 mV/g"


def test_fail_outranks_not_decided_outranks_pass():
    loop = with_parameter(clean(), "kz", rests_on="kxy")
    passing, failing, open_one = limit("kx", 0.9, 1.1), limit("ky", 0.5, 0.6), limit("kz", -1.0, 1.0)

    assert verdict(loop, passing, failing, open_one).outcome == "fail"
    assert verdict(loop, passing, open_one).outcome == "not_decided"
    assert verdict(loop, passing).outcome == "pass"
    assert verdict(loop).outcome == "no_limits"


def test_the_verdict_as_json_is_what_the_contract_says_and_comes_back():
    decided = verdict(with_parameter(clean(), "kz", rests_on="kxy"), limit("kx", 0.9, 1.1), limit("kz", -1.0, 1.0))

    document = decided.as_json()

    assert (document["outcome"], document["judged"]) == ("not_decided", "declared")
    assert document["decision_rule"] == "simple acceptance"
    assert [set(each) for each in document["parameters"]] == [{"name", "outcome", "reason", "remedy"}] * 2
    assert [(each["name"], each["outcome"]) for each in document["parameters"]] == [
        ("kx", "pass"),
        ("kz", "not_decided"),
    ]
    assert verdict_from_json(document) == decided


def test_an_effect_with_rivals_leaves_decided_what_does_not_hang_on_them():
    loop = replace(with_k_xx(), effects=(found("k_xx", also_possible=("head_eccentricity",)),))

    assert only(loop, limit("ky", 0.0, 0.02)).outcome == "pass"
