"""The stand that is built in is that of the method whose programme is chosen."""

import pytest
from window_driver import STAND

from tumble.app.stand import load_stand


@pytest.mark.parametrize(
    ("programme", "method"),
    [("12o", "triad"), ("0-90-180-270", "gyrocompass"), ("vibration", "vibration"), ("quick", "dividing_head")],
)
def test_a_programme_brings_the_stand_of_its_method(lent_driver, programme, method):
    lent_driver.run.form.programme.setCurrentText(programme)
    assert lent_driver.window.stand.loaded.file.name == load_stand(None, method).file.name
    assert "no " not in lent_driver.run.form.summary.text().split(",")[0]


def test_a_stand_file_that_was_chosen_stays(lent_driver, write):
    lent_driver.window.stand.open(write("bench.toml", STAND))
    lent_driver.run.form.programme.setCurrentText("12o")
    assert lent_driver.window.stand.loaded.file.name == "bench-1"


def test_built_in_is_what_the_programme_wants(lent_driver, write):
    lent_driver.window.stand.open(write("bench.toml", STAND))
    lent_driver.run.form.programme.setCurrentText("12o")
    lent_driver.window.stand._built_in.click()
    assert lent_driver.window.stand.loaded.file.name == "simulated-two-axes"
