"""The map of poses: what is done is filled as soon as it is, and stays so however the map is shown."""

import pytest

from tumble.app.running import Job
from tumble.app.stand import load_stand
from tumble.procedures.methods.dividing_head.layout import LAYOUT
from tumble.procedures.programmes import load_programme
from tumble.procedures.steps import Dwell
from tumble.window.look.theme import colours
from tumble.window.methods.dividing_head.pose_map import PoseMap, pose_of


@pytest.fixture
def dwells(tiny):
    plan = Job(stand=load_stand(), programme=load_programme(str(tiny)), serial_number="").plan()
    return [planned.step for planned in plan.steps if isinstance(planned.step, Dwell)]


@pytest.fixture
def pose_map(qtbot, qapp, dwells):
    """Six poses on a circle, the first of them on top."""
    shown = PoseMap(LAYOUT)
    qtbot.addWidget(shown)
    shown.resize(300, 300)
    shown.show()
    shown.show_plan(dwells)
    shown.grab()
    return shown


def filled(pose_map):
    """The colour in the middle of the topmost mark, and whether it is that of what is done."""
    cell = pose_map._cells()["face-up"]
    image = pose_map.grab().toImage()
    colour = image.pixelColor(round(cell.centre.x()), round(cell.centre.y() - cell.radius) + 1)
    return colour.name() == colours(pose_map).accent.lower()


def test_a_pose_is_hollow_until_it_is_done(pose_map, dwells):
    assert pose_of(dwells[0])[1] == 0.0
    assert not filled(pose_map)
    pose_map.complete(dwells[0], None)
    assert filled(pose_map)


def test_a_pose_stays_done_in_another_size(pose_map, dwells):
    pose_map.complete(dwells[0], None)
    pose_map.resize(200, 400)
    assert filled(pose_map)


def test_another_run_begins_with_nothing_done(pose_map, dwells):
    pose_map.complete(dwells[0], None)
    pose_map.show_plan(dwells)
    assert not filled(pose_map)
    pose_map.show_plan(dwells, points=[None])
    assert filled(pose_map)


def test_a_point_draws_its_own_pose_and_no_other(pose_map, dwells, monkeypatch):
    drawn = []
    draw = PoseMap._draw_pose
    monkeypatch.setattr(PoseMap, "_draw_pose", lambda *given: (drawn.append(given[3]), draw(*given)))
    pose_map.complete(dwells[1], None)
    pose_map.grab()
    assert drawn == [pose_of(dwells[1])]
