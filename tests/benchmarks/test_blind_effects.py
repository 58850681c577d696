"""The blind bank's simulation says what the contract says."""

from dataclasses import replace

import numpy as np
import pytest

from benchmarks.blind import KINDS
from benchmarks.blind.clock import drawn_run
from benchmarks.blind.geometry import projections
from benchmarks.blind.named import CATALOGUE, OF_NO_SIZE, stated
from benchmarks.blind.sizing import signal_v, sized, visible_units, world_of
from benchmarks.blind.unnamed.kind import Kind
from benchmarks.blind.world import Unit, respond_v

UNIT = Unit(u0=2.5, kx=1.0, ky=0.0098, kz=0.002, kxy=0.001, alpha0_deg=0.1121)
STRAIGHT = replace(UNIT, ky=0.0, kz=0.0, kxy=0.0, alpha0_deg=0.0)


def run_of(design, realisations=3):
    return drawn_run(design, realisations, 1, np.random.default_rng(3))


@pytest.mark.parametrize(
    ("mount", "gravity"),
    [  # contract, observations.md, at a = 30 deg
        ("face-up", (-0.5, -(0.75**0.5), 0.0)),
        ("face-up-90", (-(0.75**0.5), 0.5, 0.0)),
        ("face-down", (-0.5, 0.75**0.5, 0.0)),
        ("edge", (-0.5, 0.0, -(0.75**0.5))),
        ("edge-back", (-0.5, 0.0, 0.75**0.5)),
        ("end", (0.0, -0.5, -(0.75**0.5))),
    ],
)
def test_gravity_is_that_of_the_contract(mount, gravity):
    assert projections(np.array([mount]), np.array([30.0]), np.zeros(1))[0] == pytest.approx(gravity, abs=1e-12)


def test_tilted_axis_points_down_at_its_z_end():
    assert projections(np.array(["end"]), np.zeros(1), np.array([1.0]))[0, 0] == pytest.approx(0.0174524, abs=1e-7)


def test_sweep_is_the_published_fourier_series():
    """domain.md, equations (14) and (15)."""
    run = run_of("seed")
    rows = run.procedure == "sweep"
    angle, offset = np.radians(run.angle_deg[rows]), np.radians(0.1121)
    sine, cosine = np.sin(offset), np.cos(offset)
    series = (
        2.5
        + (0.0098 * sine - cosine) * np.sin(angle)
        - (sine + 0.0098 * cosine) * np.cos(angle)
        + 0.0005 * np.cos(2 * offset) * np.sin(2 * angle)
        + 0.0005 * np.sin(2 * offset) * np.cos(2 * angle)
    )
    assert respond_v(run, UNIT)[rows] == pytest.approx(series, abs=1e-12)


@pytest.mark.parametrize("kind", KINDS.values(), ids=KINDS)
def test_structure_without_a_name_is_as_visible_as_asked(kind: Kind):
    run = run_of(kind.designs[0])
    effect = sized(kind.drawn(run, UNIT, np.random.default_rng(1)), run, UNIT, 20.0)
    assert visible_units(run, UNIT, [effect]) == pytest.approx(20.0, rel=0.01)


def test_there_are_at_least_25_kinds_and_none_is_of_the_catalogue():
    assert len(KINDS) >= 25
    assert not KINDS.keys() & CATALOGUE.keys()


@pytest.mark.parametrize("name", sorted(CATALOGUE.keys() - OF_NO_SIZE))
def test_named_effect_is_as_visible_as_asked(name):
    run = run_of("all_mounts")
    run = replace(run, voltage_sd_v=1e-3 * (1.0 + run.place / 400.0))
    effect = sized(CATALOGUE[name](run, UNIT, np.random.default_rng(5)), run, UNIT, 12.0)
    assert visible_units(run, UNIT, [effect]) == pytest.approx(12.0, rel=0.01)


@pytest.mark.parametrize(
    "name", sorted(CATALOGUE.keys() - {"bias_random_walk", "realisation_bias", "seating", "misreading"})
)
def test_coefficients_say_what_the_effect_does(name):
    run = run_of("all_mounts")
    effect = CATALOGUE[name](run, UNIT, np.random.default_rng(5))(1e-3)
    again = stated(name, effect.coefficients)
    if again is not None:  # the contract has no phase of daq_nonlinearity
        assert signal_v(run, UNIT, [again]) == pytest.approx(signal_v(run, UNIT, [effect]), abs=1e-12)


def test_positive_hysteresis_is_lower_after_ax_rose():
    run = run_of("mounts")
    world = world_of(run, STRAIGHT)
    rose = np.r_[False, np.diff(world.ax) > 0.061] & run.follows & (run.procedure == "sweep")
    effect = stated("hysteresis", {"hysteresis": 1e-4})
    assert effect is not None
    assert effect.amount(world)[rose] == pytest.approx(-1e-4)


def test_hysteresis_does_not_turn_where_ax_hardly_falls_after_the_pole():
    run = run_of("mounts")
    unit = replace(STRAIGHT, alpha0_deg=0.2)
    effect = stated("hysteresis", {"hysteresis": 1e-4})
    assert effect is not None
    past = (run.mount == "face-up") & (run.angle_deg == 270.0) & (run.direction > 0) & run.follows
    assert past.any()
    assert effect.amount(world_of(run, unit))[past] == pytest.approx(-1e-4, rel=1e-2)


def test_settling_leaves_nothing_over_a_change_of_mount():
    run = run_of("mounts")
    effect = stated("settling", {"settling": 0.01})
    assert effect is not None
    left_v = signal_v(run, UNIT, [effect])
    assert not left_v[~run.follows].any()
    readings_v = respond_v(run, UNIT)
    assert left_v[1] == pytest.approx(0.01 * (readings_v[0] - readings_v[1]))


def test_backlash_is_no_error_after_moves_in_plus_direction():
    run = run_of("mounts")
    effect = stated("backlash", {"backlash": 0.002})
    assert effect is not None
    error_deg = effect.amount(world_of(run, UNIT))
    assert set(error_deg[run.direction > 0]) == {0.0}
    assert set(error_deg[run.direction < 0]) == {0.002}
