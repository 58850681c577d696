"""What there is only to tell is a notice: it takes no focus, waits for nobody, and offers what helps."""

import pytest
from PySide6.QtCore import Qt
from window_driver import STAND

from tumble.app.exits import Exit, JobError
from tumble.drivers.errors import DeviceError
from tumble.drivers.simulated.head import SimulatedHead
from tumble.messages import Message
from tumble.procedures.errors import InputError
from tumble.window import remedies
from tumble.window.widgets.dialog import Dialog, QuestionDialog
from tumble.window.widgets.notice import Action, Kind, Notice


@pytest.fixture
def driver(lent_driver):
    """A window that was lent."""
    return lent_driver


@pytest.fixture
def opened(monkeypatch):
    """Files that the desktop was asked to open."""
    files = []
    monkeypatch.setattr(remedies, "open_file", files.append)
    return files


def cards(driver):
    return driver.window.notices.cards


def test_a_fault_is_a_notice_and_no_dialog(driver):
    driver.window.tell(InputError("the file is bent; straighten it"))
    assert driver.window.dialogs.open == []
    (card,) = cards(driver)
    assert (card.notice.text, card.notice.kind) == ("the file is bent; straighten it", Kind.FAULT)
    assert card.accessibleName() == "the file is bent; straighten it"


def test_the_keyboard_stays_where_it_was(driver):
    driver.window.open(driver.run)
    driver.run.form.serial.setFocus()
    driver.window.tell(InputError("bent"))
    driver.bot.keyClicks(driver.window.focusWidget(), "SN-3")
    assert driver.run.form.serial.text() == "SN-3"


def test_esc_closes_the_dialog_first_and_then_the_newest_notice(driver):
    driver.window.tell(InputError("first"))
    driver.window.tell(InputError("second"))
    driver.window.dialogs.show_dialog(Dialog("a", "b"))
    driver.press(Qt.Key.Key_Escape)
    assert driver.window.dialogs.open == []
    assert driver.complaints == ["first", "second"]
    driver.press(Qt.Key.Key_Escape)
    assert driver.complaints == ["first"]


def test_one_that_says_the_same_is_there_once_and_the_newest(driver):
    for text in ("first", "second", "first"):
        driver.window.tell(InputError(text))
    assert driver.complaints == ["second", "first"]


def test_what_has_no_room_is_counted(driver):
    for number in range(30):
        driver.window.tell(InputError(f"{number} is bent; straighten it"))
    shown = [card for card in cards(driver) if card.isVisible()]
    assert shown[-1].notice.text.startswith("29 ")
    assert driver.window.notices._earlier.text() == f"{30 - len(shown)} earlier"
    assert driver.window.notices.geometry().bottom() <= driver.window.frame._middle.height()


def test_notices_never_lie_over_stop(driver):
    for number in range(30):
        driver.window.tell(InputError(f"{number} is bent"))
    button = driver.window.stop_bar.button
    assert driver.window.childAt(button.mapTo(driver.window, button.rect().center())) is button


def test_what_went_well_goes_by_itself_and_faults_stay(driver):
    driver.window.notices.show_notice(Notice(text="It is done."))
    driver.window.tell(InputError("bent"))
    driver.window.notices._wait.timeout.emit()
    assert [card.notice.text for card in cards(driver)] == ["bent"]


def test_a_key_does_what_the_newest_offers(driver):
    done = []
    driver.window.notices.show_notice(Notice(text="a", action=Action(title="Do it", act=lambda: done.append("a"))))
    driver.press(Qt.Key.Key_F11)
    assert done == ["a"]
    assert cards(driver) == []


def test_only_the_newest_names_the_keys(driver):
    for text in ("a", "b"):
        driver.window.notices.show_notice(Notice(text=text, action=Action(title="Do it", act=lambda: None)))
    assert [card._act.text() for card in cards(driver)] == ["Do it", "Do it  [F11]"]


def test_a_file_that_is_wrong_is_opened_by_the_notice(driver, write, opened):
    path = write("bad.toml", 'name = "x"\n[head]\ndriver = "simulated"\n')
    driver.window.stand.open(path)
    driver.press(Qt.Key.Key_F11)
    assert opened == [path]


def test_a_file_that_is_not_there_is_not_offered(driver, tmp_path):
    driver.window.stand.open(tmp_path / "absent.toml")
    assert cards(driver)[0].notice.action is None


def test_a_stand_that_did_not_answer_is_connected_again(driver, monkeypatch):
    def fail(_head):
        raise DeviceError("head", "does not answer", "check its cable")

    monkeypatch.setattr(SimulatedHead, "identify", fail)
    driver.window.stand.connect_button.click()
    driver.wait(lambda: driver.complaints and not driver.window.busy)
    monkeypatch.undo()
    assert cards(driver)[0].notice.action.title == "Connect again"
    driver.press(Qt.Key.Key_F11)
    driver.wait(lambda: driver.window.worker.session.is_connected)


def test_a_run_that_broke_off_is_resumed_by_the_notice(driver, tmp_path, monkeypatch):
    recording = tmp_path / "run.mcap"
    recording.write_bytes(b"a header")
    resumed = []
    object.__setattr__(driver.window._remedies, "resume", resumed.append)
    driver.window.tell(JobError(Message("{happened}; kept in {path}", happened="x", path=recording), Exit.DEVICE_FAULT))
    driver.press(Qt.Key.Key_F11)
    object.__setattr__(driver.window._remedies, "resume", driver.window.records.resume)
    assert resumed == [recording]


def test_details_of_a_fault_of_the_program_are_opened_by_the_notice(driver, opened, tmp_path):
    driver.window.tell(ZeroDivisionError("x"))
    driver.press(Qt.Key.Key_F11)
    assert opened == [tmp_path / "state" / "tumble" / "window-faults.log"]


def test_there_are_never_two_dialogs(driver, write):
    driver.window.way_out._ask()
    driver.window.stand._choose()
    assert [type(dialog).__name__ for dialog in driver.window.dialogs.open] == ["FileDialog"]


def test_a_question_whose_place_is_taken_is_declined(driver):
    question, agreed = QuestionDialog("a", "b", "yes"), []
    question.agreed.connect(lambda: agreed.append(1))
    driver.window.dialogs.show_dialog(question)
    driver.window.dialogs.show_dialog(Dialog("c", "d"))
    driver.press(Qt.Key.Key_F3)
    assert agreed == []


def test_text_of_a_file_is_no_markup(driver, write):
    driver.window.stand.open(write("b.toml", STAND.replace("bench-1", "<b>x</b>") + "[oops]\n"))
    assert "oops" in driver.complaints[0]


def test_what_offers_something_with_a_file_is_withdrawn_by_any_path_to_it(driver, tmp_path):
    file, other = tmp_path / "run.jsonl", tmp_path / "other.jsonl"
    for path in (file, other):
        action = Action(title="Go on", act=lambda: None, about=path)
        driver.window.notices.show_notice(Notice(text=path.name, kind=Kind.FAULT, action=action))
    (tmp_path / "sub").mkdir()
    driver.window.notices.withdraw(tmp_path / "sub" / ".." / "run.jsonl")
    assert [card.notice.text for card in cards(driver)] == ["other.jsonl"]
