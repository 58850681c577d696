"""The stand file is changed on the screen Stand, never while the stand is at work."""

import pytest
from PySide6.QtCore import Qt
from window_driver import STAND

from tumble.window.widgets.dialog import QuestionDialog


@pytest.fixture
def driver(lent_driver, write):
    """A window with a stand file, whose editor is closed afterwards."""
    lent_driver.window.stand.open(write("bench.toml", STAND))
    yield lent_driver
    lent_driver.window.stand._edit(False)


@pytest.fixture
def editor(driver):
    driver.window.stand.edit_button.click()
    return driver.window.stand.editor


def test_the_file_is_shown_as_it_is(editor):
    assert editor.isVisible()
    assert editor.text.toPlainText() == STAND
    assert editor.said.text() == "✓ This file can be used."


def test_a_mistake_is_said_with_its_line_which_is_marked(editor):
    editor.text.setPlainText(STAND.replace("[-180.0, 760.0]", '"wide"'))
    assert "bench.toml, line 5" in editor.said.text()
    (marked,) = editor.text.extraSelections()
    assert marked.cursor.blockNumber() == 4
    assert not editor.save_button.isEnabled()


def test_what_is_no_toml_is_said_too(editor):
    editor.text.setPlainText(STAND + "[oops\n")
    assert "line 12" in editor.said.text()


def test_saved_it_is_the_stand_on_screen(driver, editor, tmp_path):
    editor.text.setPlainText(STAND.replace("bench-1", "bench-2"))
    editor.save_button.click()
    assert driver.window.stand.loaded.file.name == "bench-2"
    assert 'name = "bench-2"' in (tmp_path / "bench.toml").read_text("utf-8")
    (former,) = tmp_path.glob("bench.toml.2*")
    assert former.read_text("utf-8") == STAND
    assert former.name in editor.said.text()


def test_a_copy_is_the_stand_on_screen(driver, editor, tmp_path):
    editor._write(tmp_path / "copy.toml", None)
    assert driver.window.stand.loaded.path == tmp_path / "copy.toml"
    assert (tmp_path / "bench.toml").read_text("utf-8") == STAND


def test_what_another_program_wrote_is_kept(driver, editor, tmp_path):
    (tmp_path / "bench.toml").write_text(STAND.replace("bench-1", "theirs"), encoding="utf-8")
    editor.text.setPlainText(STAND.replace("bench-1", "mine"))
    editor.save_button.click()
    assert "was changed by another program" in driver.complaints[0]
    assert "theirs" in (tmp_path / "bench.toml").read_text("utf-8")


def test_leaving_what_is_not_saved_asks(driver, editor):
    editor.text.setPlainText(STAND + "# a remark\n")
    editor.back_button.click()
    (question,) = driver.window.dialogs.open
    assert isinstance(question, QuestionDialog)
    assert editor.isVisible()
    driver.press(Qt.Key.Key_F3)
    driver.wait(lambda: not editor.isVisible())


def test_leaving_what_was_not_changed_does_not(driver, editor):
    editor.back_button.click()
    assert not editor.isVisible()
    assert driver.window.dialogs.open == []


def test_nothing_is_changed_while_the_stand_is_at_work(driver, editor, long):
    driver.window.stand.simulation.speed.setCurrentIndex(2)
    driver.start(long)
    assert editor.text.isReadOnly()
    assert not editor.save_button.isEnabled()
    driver.press(Qt.Key.Key_F12)
    driver.wait_for_end()
    driver.wait(editor.save_button.isEnabled)
    driver.window.stand.simulation.speed.setCurrentIndex(0)


def test_the_stand_that_is_built_in_has_no_file_to_change(driver):
    driver.window.stand._built_in.click()
    assert not driver.window.stand.edit_button.isEnabled()
