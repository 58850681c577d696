"""The screen Run shows the run that runs, and what it waits for."""

from datetime import UTC, datetime, timedelta

import numpy as np
import pytest
from PySide6.QtCore import Qt
from window_driver import STAND, TINY

from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.drivers.protocols import PositionerStatus
from tumble.procedures.methods.dividing_head.layout import LAYOUT
from tumble.window.look.plots import Plot
from tumble.window.methods.dividing_head.mount_prompt import MountPrompt
from tumble.window.methods.dividing_head.pose_picture import _ARROW, _ZERO_LABEL, _flat, _seat_z
from tumble.window.screens.run_state import Mood

MANUAL = STAND.replace('driver = "simulated"\nlimits', 'driver = "manual"\nserial = "OG-7"\nlimits')


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def test_nothing_is_asked_before_a_run(driver):
    driver.running._restart()
    assert not driver.run.view.asks


def test_the_form_folds_to_a_line_that_says_what_runs(driver, long):
    driver.start(long, "SN-7")
    assert driver.run.line.text().startswith("SN-7 · long · ")
    assert "600 points, 1 mounting, about" in driver.run.line.text()
    assert driver.run.line.isVisible()
    assert not driver.run.form.isVisible()
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    assert driver.run.form.isVisible()
    assert not driver.run.line.isVisible()


def test_a_run_of_another_programme_than_the_form_is_shown_as_it_is(driver, long):
    driver.start(long)
    driver.run.form.programme.setCurrentText("seed")
    assert " · long · " in driver.run.line.text()
    assert not driver.run.form.summary.isVisible()


def test_a_programme_from_a_file_is_chosen_the_next_time(driver, long):
    driver.run.form.add_programme(str(long))
    driver.running._restart()
    assert (driver.run.form.chosen, driver.run.form.programme.currentText()[-9:]) == (str(long), "long.toml")


def test_a_programme_whose_file_is_gone_is_told_and_no_other_takes_its_place(driver, long):
    driver.run.form.add_programme(str(long))
    long.unlink()
    driver.running._restart()
    assert "there is no such file" in driver.run.form.summary.text()
    driver.window.open(driver.run)
    driver.scan("SN-1")
    driver.press(Qt.Key.Key_F5)
    driver.wait(lambda: bool(driver.complaints), 10)
    assert "there is no such file" in driver.complaints[0]


def test_a_head_read_by_eye_waits_for_the_person(driver, write):
    driver.window.stand.open(write("manual.toml", MANUAL))
    driver.start(write("tiny.toml", TINY), imagined=False)
    driver.wait(lambda: driver.run.view.asks)
    driver.press(Qt.Key.Key_F9)
    driver.wait(driver.run.view.reading.isVisible)
    assert driver.run.course.now.mood is Mood.WAITING
    assert driver.window.stop_bar.state.text() == "Waits for you"
    driver.bot.wait(100)
    assert "↻" not in driver.window.stop_bar._angle.text()


@pytest.mark.parametrize(
    ("angle_deg", "by_hand", "said"),
    [
        (0.0, False, "Seat the unit on edge, as in the picture. The head is at 0°."),
        (720.001, False, "Seat the unit on edge, as in the picture. The head is at 0°."),
        (330.0, False, "The head is at 330° and turns by itself once you confirm"),
        (330.0, True, "The head is at 330°: turn it to 0° yourself"),
    ],
)
def test_the_prompt_for_a_mount_says_where_the_head_is_and_who_turns_it(
    qtbot, qapp, settings, angle_deg, by_hand, said
):
    prompt = MountPrompt(None)
    qtbot.addWidget(prompt)
    prompt.ask(LAYOUT.ask("mount", "edge"))
    prompt.see("head", PositionerStatus(angle_deg=angle_deg, moving=False, device_time_s=0.0, by_hand=by_hand))
    assert said in prompt.words.text


@pytest.mark.parametrize("mount", list(MOUNTS))
def test_nothing_is_written_over_the_mark_of_zero(mount):
    axes = MOUNTS[mount]
    zero = _flat(np.array([*_ZERO_LABEL, _seat_z(axes)]), 1.0)
    letters = [_flat(axes[axis] * (_ARROW + 0.18), 1.0) for axis in range(3)]
    assert min(max(abs(zero.x() - at.x()), abs(zero.y() - at.y())) for at in letters) > 0.2


def test_what_is_overdue_is_said_in_the_run(driver, write, tiny):
    yesterday = datetime.now(tz=UTC).date() - timedelta(days=1)
    driver.window.stand.open(write("due.toml", STAND.replace("[daq]\n", f"[daq]\ncalibration_due = {yesterday}\n")))
    driver.start(tiny)
    driver.wait(lambda: "was due" in driver.log, 10)


def test_a_head_without_reference_has_no_angle(driver):
    dial = driver.window.stand.dials.of("head")
    dial.show_status(PositionerStatus(angle_deg=0.0, moving=False, device_time_s=0.0, referenced=False))
    assert dial.accessibleName() == ""
    dial.show_status(PositionerStatus(angle_deg=0.0, moving=False, device_time_s=0.0))
    assert dial.accessibleName() == "0.0000°"


def test_a_new_run_has_axes_of_its_own(driver, tiny, long):
    driver.start(long)
    driver.wait_for_points(3)
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    for plot in driver.run.view.findChildren(Plot):
        plot.setRange(xRange=(900, 1000), yRange=(7, 8))
    driver.start(tiny)
    for plot in driver.run.view.findChildren(Plot):
        assert plot.viewRange()[0] != [900, 1000]
        box = plot.getViewBox()
        abscissa = box.linkedView(0) or box
        assert abscissa.autoRangeEnabled()[0]
        assert box.autoRangeEnabled()[1]


def test_output_and_residual_have_one_abscissa(driver, long):
    driver.start(long)
    driver.wait_for_points(12)
    figures = driver.run.view.figures
    figures.residual.setXRange(3.0, 7.0, padding=0)
    assert figures.output.viewRange()[0] == pytest.approx([3.0, 7.0])
    figures.residual.way_back.home()
    driver.wait(lambda: figures.output.viewRange()[0][1] > 10.0)
    driver.wait(lambda: figures.residual.viewRange()[0][1] > 10.0)


def test_every_step_is_listed_with_what_is_done(driver, long):
    driver.start(long)
    driver.wait_for_points(3)
    driver.press(Qt.Key.Key_F6)
    driver.wait(lambda: driver.run.course.now.paused)
    texts, done = driver.run.view.steps.texts(), len(driver.run.view.points)
    assert len(texts) == 601
    assert texts[0].startswith("✓ 1  seat the unit in face up")
    assert texts[1].startswith("✓ 2  face up at 0°")
    assert [text[0] for text in texts[done : done + 3]] == ["✓", "▶", "·"]
