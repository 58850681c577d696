from dataclasses import replace

import numpy as np
import pytest
from tables import FLIPS, UNIT, sweep, table

from tumble.calibrations.methods.dividing_head.loop.loop import close_loop
from tumble.calibrations.methods.dividing_head.loop.seats import wrong_seat
from tumble.calibrations.methods.dividing_head.poses import mountings
from tumble.calibrations.methods.dividing_head.questions import questioned

NOISE_V = 1e-4
PARTS = (sweep("face-up", 20.0), sweep("face-down", 20.0), sweep("face-up-90", 20.0), sweep("end", 20.0))


def said(parts, *wrong, realisations=2, **more):
    """A table in which the parts that are numbered in `wrong` are said to be in another mount than they were."""
    rows = table(*parts, realisations=realisations, noise_v=NOISE_V, **more)
    mounts, numbers = rows.mount.astype("<U10"), mountings(rows)
    for number, mount in wrong:
        mounts[numbers == number] = mount
    spread = np.full(len(rows), NOISE_V * 10.0)
    return replace(rows, mount=mounts, voltage_sd_v=spread, samples=np.full(len(rows), 100))


def test_a_table_that_says_where_the_unit_sat_is_asked_nothing():
    assert wrong_seat(said(PARTS)) == ""


def test_a_mount_that_was_not_changed_though_confirmed_is_asked_about():
    rows = said((PARTS[0], sweep("face-up", 25.0), PARTS[2], PARTS[3]), realisations=1)
    mounts = rows.mount.copy()
    mounts[20:36] = "face-down"

    assert wrong_seat(replace(rows, mount=mounts)) == (
        "table: rows 21 to 36 are said to be in face-down and fit face-up, where the unit sat before; was the unit "
        "seated as asked? Measure these rows again, or correct their mount"
    )


def test_a_unit_in_another_mount_than_the_one_before_is_asked_about_too():
    assert "rows 41 to 60 are said to be in edge and fit face-up-90; was" in wrong_seat(said(PARTS, (2, "edge")))


@pytest.mark.parametrize(
    ("true", "rows"), [("face-up", "1 to 20 are said to be in face-up-90"), ("face-up-90", "21 to 40 are said")]
)
def test_of_two_mountings_the_one_is_asked_about_that_leaves_x_the_most_sensitive_axis(true, rows):
    table_of_one = said((sweep(true, 20.0), sweep(true, 20.0)), realisations=1)
    mounts = np.repeat(["face-up-90", "face-up"], 20)

    assert f"rows {rows}" in wrong_seat(replace(table_of_one, mount=mounts))


def test_two_mountings_that_were_wrong_are_both_named():
    question = wrong_seat(said(PARTS, (2, "edge"), (6, "edge")))

    assert "rows 41 to 60 are said to be in edge and fit face-up-90" in question
    assert "rows 121 to 140 are said to be in edge and fit face-up-90" in question


def test_a_gross_contradiction_needs_no_noise_to_be_asked_about():
    rows = replace(said(PARTS, (3, "edge")), voltage_sd_v=None)

    assert "are said to be in edge and fit end" in wrong_seat(rows)


def test_it_is_asked_before_anything_is_traced():
    rows = said(PARTS, (2, "edge"))

    assert not questioned(rows).answerable
    assert close_loop(rows).effects == ()


def test_a_unit_without_cross_axes_gives_nothing_to_ask():
    plain = UNIT | {"ky": 0.0, "kz": 0.0, "kxy": 0.0}
    rows = said((PARTS[0], PARTS[1]), (1, "edge"), unit=plain)

    assert wrong_seat(rows) == ""


@pytest.mark.parametrize(
    "effect_v",
    [
        lambda _, angle_deg: 3e-3 * np.sin(np.deg2rad(angle_deg)) ** 2,
        lambda mount, _: 5e-3 if mount == "end" else 0.0,
        lambda _, angle_deg: 2e-3 * np.cos(3 * np.deg2rad(angle_deg)),
    ],
)
def test_an_effect_is_not_taken_for_a_wrong_seat(effect_v):
    assert wrong_seat(said((*FLIPS, *PARTS), extra_v=effect_v)) == ""
