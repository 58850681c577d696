"""Repeats and short arcs are no independent evidence."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from sparse_tables import nine_settings, pieces, with_labels
from tables import FLIPS, gravity_on, sweep, table

from tumble.calibrations.methods.dividing_head.document import document
from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.joint import fit_jointly
from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.loop.sentences import headline
from tumble.calibrations.methods.dividing_head.loop.table import dividing_head_table
from tumble.calibrations.methods.dividing_head.poses import distinct_settings
from tumble.calibrations.tracing.evidence import evidence
from tumble.calibrations.tracing.noise import NoiseModel
from tumble.calibrations.tracing.trace import Trace, Tracer, found


@cache
def nine():
    return close_loop(nine_settings())


def said(loop):
    """Effects with their values, and what is unexplained: everything that may not depend on labels."""
    coefficients = {
        (effect.name, key): quantity.value for effect in loop.effects for key, quantity in effect.coefficients.items()
    }
    parameters = {name: parameter.value for name, parameter in loop.augmented.parameters.items()}
    return coefficients, loop.unexplained, loop.withheld, parameters, loop.augmented.held_out_rms_v


def test_nine_settings_in_four_pieces_name_no_effect():
    assert nine().effects == ()


def test_what_nine_settings_leave_is_said_with_its_size():
    assert nine().unexplained.description == (
        "9 settings over 180° differ from the model by 17 mV where repeats scatter by 510 µV, in no shape that so many "
        "can show"
    )


def test_a_shape_that_would_fit_nine_settings_is_withheld_and_says_why():
    (shape,) = nine().withheld
    assert (shape.name, shape.reason) == (
        "head_second_harmonic",
        "as stated it would be 93 times as large as what these rows show of it",
    )


def test_more_settings_over_a_longer_arc_are_proposed():
    (experiment,) = nine().next_experiment
    assert experiment.command == "tumble run --programme probe-repeat --serial SERIAL"
    assert "9 settings over 180°" in experiment.why


def test_the_document_counts_settings_and_names_what_is_withheld():
    found = document(nine())
    assert found["settings"] == {"count": 9, "arc_deg": 180.0, "spare": 4, "few": True}
    assert [each["name"] for each in found["withheld"]] == ["head_second_harmonic"]


def test_repeats_of_a_setting_that_is_held_out_leave_with_it():
    assert nine().augmented.held_out_rms_v == pytest.approx(39.4e-3, rel=1e-2)


@pytest.mark.parametrize(
    "numbers",
    [np.ones(36, int), np.tile([1, 2, 3, 4], 9), np.tile([3, 1, 4, 2], 9), np.tile([2, 2, 1, 1], 9), np.arange(1, 37)],
    ids=["one", "pieces", "permuted", "halves", "each"],
)
def test_how_repeats_are_labelled_changes_nothing(numbers):
    assert said(close_loop(with_labels(nine_settings(), numbers))) == said(nine())


@pytest.mark.parametrize("seed", [1, 2])
def test_the_order_of_the_rows_within_a_setting_changes_nothing(seed):
    rows = nine_settings()
    generator = np.random.default_rng(seed)
    mixed = np.concatenate([generator.permutation(np.arange(4)) + 4 * setting for setting in range(9)])

    other = close_loop(replace(rows, voltage_v=rows.voltage_v[mixed]))

    assert (other.effects, other.unexplained) == ((), nine().unexplained)
    assert other.augmented.parameters["kx"].value == pytest.approx(nine().augmented.parameters["kx"].value, rel=1e-9)


def k_xx(mount, angle_deg):
    return 4e-4 * gravity_on(mount, angle_deg)[0] ** 2


SWEEPS = (*FLIPS, sweep("face-up", 15.0), sweep("face-down", 15.0))


@pytest.mark.parametrize("relabel", [None, (3, 1, 2)], ids=["without the column", "permuted"])
def test_passes_are_passes_however_they_are_numbered(relabel):
    rows = table(*SWEEPS, realisations=3, extra_v=k_xx)
    number = None if relabel is None else np.array(relabel)[rows.realisation - 1]

    assert said(close_loop(replace(rows, realisation=number))) == said(close_loop(rows))


def spring(angle_deg):
    """A stop that stiffens: no square, no cubic, no wave."""
    return 5e-3 * np.exp(3.0 * (-np.sin(np.deg2rad(angle_deg)) - 1.0))


@pytest.mark.parametrize(
    ("first_deg", "last_deg", "settings"),
    [(15.0, 56.0, 5), (-90.0, -30.0, 7), (-90.0, 90.0, 12), (0.0, 330.0, 12)],
)
def test_a_bend_that_no_name_has_gets_none_from_few_settings(first_deg, last_deg, settings):
    loop = close_loop(pieces(np.linspace(first_deg, last_deg, settings), 10, spring))

    assert loop.effects == ()


@pytest.mark.parametrize("settings", [5, 9])
def test_settings_that_were_set_by_hand_have_no_shape(settings):
    off = np.random.default_rng(4).normal(0.0, 5e-3, settings)
    loop = close_loop(pieces(np.linspace(-90.0, 90.0, settings), 20, lambda _: off))

    assert loop.effects == ()


def test_a_clean_table_of_few_settings_is_not_said_to_leave_nothing():
    text = headline(close_loop(pieces([-90.0, -45.0, 0.0, 45.0, 90.0, 135.0], 10, np.zeros_like)))

    assert "Nothing is left" not in text
    assert text.startswith("6 settings over 225° leave 1 number beyond the model")


def test_a_cubic_that_is_plain_is_identified_by_seventeen_settings():
    angles_deg = np.linspace(0.0, 340.0, 17)
    loop = close_loop(pieces(angles_deg, 10, lambda angle_deg: 5e-3 * np.sin(np.deg2rad(angle_deg)) ** 3))

    assert [effect.name for effect in loop.effects] == ["k_xxx"]
    assert "head_second_harmonic" in loop.effects[0].also_possible


def cubic(angle_deg):
    return 5e-3 * np.sin(np.deg2rad(angle_deg)) ** 3


@pytest.mark.parametrize("repeats", [2, 20])
def test_a_chance_counts_settings_and_not_rows(repeats):
    assert evidence_for(pieces(np.linspace(0.0, 340.0, 18), repeats, cubic), "k_xxx").freedom == 12


def two_temperatures(visits):
    """Sweeps at 20 °C and 40 °C by turns as listed, the bias 1 mV more where it is warm."""
    rows = table(sweep("face-up", 30.0), realisations=len(visits))
    warm = np.array(visits)[rows.realisation - 1]
    noise = 0.02 * np.random.default_rng(1).normal(size=len(rows))
    return replace(
        rows,
        voltage_v=rows.voltage_v + 1e-3 * warm,
        temperature_degc=20.0 + 20.0 * warm + noise,
        time_s=10.0 * np.arange(len(rows)),
    )


def evidence_for(rows, name):
    """What speaks for the first form of an effect, alone in a table."""
    base = dividing_head_table(fit_jointly(rows), CATALOGUE)
    problem = Tracer(base).problem(NoiseModel())
    alone = found(problem, problem.forms[name].start)
    return evidence(base, Trace(found=(alone,), noise=NoiseModel(), deviance=0.0), name)


def test_one_visit_of_a_second_temperature_is_no_slope():
    found = evidence_for(two_temperatures([0, 0, 1]), "bias_temperature")
    assert (found.variable, found.blocks, found.stands) == ("temperature", 3, False)


def test_a_second_temperature_that_is_visited_again_and_again_is_one():
    found = evidence_for(two_temperatures([0, 1, 0, 1, 0, 1, 0, 1]), "bias_temperature")
    assert (found.blocks, found.stands) == (8, True)


def test_a_drift_in_a_table_where_each_setting_was_visited_once_rests_on_settings():
    rows = pieces(np.linspace(0.0, 330.0, 12), 4, np.zeros_like)
    hours = np.arange(len(rows)) / len(rows)
    drifting = replace(rows, time_s=3600.0 * hours, voltage_v=rows.voltage_v + 1e-3 * hours)

    assert evidence_for(drifting, "bias_drift").variable == "angle"


def reversals(gap_v):
    """Eight settings over a turn from both sides, five times; the output differs by a gap at each."""
    up_deg = np.arange(0.0, 360.0, 45.0)
    angle_deg = np.tile(np.concatenate([up_deg, up_deg[::-1]]), 5)
    direction = np.tile(np.repeat([1, -1], 8), 5)
    rows = table(("sweep", "face-up", angle_deg), realisations=1)
    gaps_v = np.asarray(gap_v)[np.round(angle_deg / 45.0).astype(int)]
    return replace(rows, direction=direction, voltage_v=rows.voltage_v + np.where(direction < 0, gaps_v, 0.0))


def test_a_reversal_error_that_differs_from_setting_to_setting_is_no_backlash():
    """The gaps of a public test by ISO 230-2 (paulscherrerinstitute/ecmccfg, in mm), as mV."""
    gaps_v = 1e-3 * np.array([32, -15, -4, 23, 46, 32, -15, -4])
    assert not evidence_for(reversals(gaps_v), "backlash").stands


def test_a_reversal_error_that_is_a_play_of_the_head_is_backlash():
    slope_v = -np.cos(np.deg2rad(np.arange(0.0, 360.0, 45.0) + 0.1121)) * np.deg2rad(0.5)
    found = evidence_for(reversals(slope_v), "backlash")
    assert (found.variable, found.stands) == ("angle", True)


def test_what_is_stated_of_an_effect_is_compared_with_what_is_seen_of_it():
    rows = table(*FLIPS, sweep("face-up", 15.0), extra_v=lambda mount, deg: 4.0 * k_xx(mount, deg))
    found = evidence_for(rows, "k_xx")
    assert 1.0 < found.inflation < 30.0


def test_a_table_of_one_row_for_each_setting_has_as_many_blocks_as_rows():
    rows = table(("sweep", "face-up", 5.0 * np.arange(72)), realisations=1)
    assert evidence_for(rows, "k_xxx").blocks == 72


def test_a_whole_turn_more_is_the_same_setting():
    rows = table(("sweep", "face-up", [-90.0, 0.0, 90.0, 180.0, 270.0, 359.999, 450.0]), realisations=3)
    assert len(set(distinct_settings(rows).tolist())) == 4
