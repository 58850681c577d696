import pytest
from PySide6.QtCore import Qt
from window_driver import STAND

from tumble.drivers.manual import parse_reading
from tumble.procedures.recording.reader import read_recording

MANUAL = STAND.replace('driver = "simulated"\nlimits', 'driver = "manual"\nserial = "OG-7"\nlimits')
THIRTY = """\
name = "thirty"
dwell_s = 0.1
settle_s = 0.0

[[procedure]]
kind = "sweep"
step_deg = 12.0
points = 30
"""


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


def begin(driver, write):
    driver.window.stand.open(write("manual.toml", MANUAL))
    driver.start(write("thirty.toml", THIRTY), imagined=False)
    driver.wait(lambda: driver.run.view.asks)
    driver.press(Qt.Key.Key_F9)
    driver.wait(driver.run.view.reading.isVisible)


def answer(driver, text=""):
    """Type into whatever has the keyboard, and wait for the next question."""
    field = driver.run.view.reading.field
    before = driver.run.view.reading.setting.text, driver.run.view.reading.prompt, len(driver.run.view.points)
    driver.bot.keyClicks(field, text)
    driver.press(Qt.Key.Key_Return, at=field)
    driver.wait(
        lambda: (
            (driver.run.view.reading.prompt != "Measuring…" or not driver.run.course.now.running)
            and before
            != (driver.run.view.reading.setting.text, driver.run.view.reading.prompt, len(driver.run.view.points))
        )
    )


def test_thirty_points_by_keyboard_alone_with_a_mistyped_reading_caught(driver, write, tmp_path, no_report):
    begin(driver, write)
    assert driver.run.view.reading.field.hasFocus() or not driver.window.isActiveWindow()
    for index in range(30):
        assert driver.run.view.reading.setting.text == f"{12 * index}° 00′ 00″"
        if index == 5:
            answer(driver, "70 00 00")
            assert "the setting was 60° 00′ 00″" in driver.run.view.reading.prompt
        answer(driver, "204,0" if index == 17 else "")
    driver.wait_for_result()
    (path,) = (tmp_path / "store").glob("recordings/SN-1/*.mcap")
    angles_deg = [point.positions_deg["head"] for point in read_recording(path).points]
    assert angles_deg == [12.0 * index for index in range(30)]


def test_a_reading_that_the_voltage_contradicts_is_asked_about(driver, write):
    begin(driver, write)
    for _ in range(12):
        answer(driver)
    angle = parse_reading(driver.run.view.reading.setting.text)
    answer(driver, f"{angle + 10:g}")
    answer(driver, f"{angle + 10:g}")  # insisted on; the simulated hand turned the head to the setting all the same
    assert "a wrong degree?" in driver.run.view.reading.prompt
    answer(driver, f"{angle:g}")
    assert driver.run.view.points[-1].positions_deg["head"] == angle


def test_what_is_no_angle_is_asked_for_again(driver, write):
    begin(driver, write)
    answer(driver, "SN 123")
    assert "'SN 123' is no angle" in driver.run.view.reading.prompt
    assert driver.run.view.points == []
