"""The person in front of the window, asked from the thread of a run."""

from threading import Thread

import pytest

from tumble.procedures.operator import Answer
from tumble.procedures.steps import Ask
from tumble.window.work.operator import CONFIRMED, WindowOperator

YES = Answer(text=CONFIRMED, confirmed=True)


def mount(value):
    return Ask(condition="mount", value=value, task="seat it", remedy="seat it", prompt="Seat it?", hint="")


@pytest.fixture
def operator(qapp):
    return WindowOperator()


def put(question, *arguments):
    """Have the thread of a run ask something; the event loop does not see it yet."""
    thread = Thread(target=question, args=arguments)
    thread.start()
    thread.join()


def test_what_is_answered_on_screen_answers_it(operator, qapp):
    put(operator.ask, mount("end"))
    qapp.processEvents()
    operator.answer(CONFIRMED)
    assert operator.poll() == YES


def test_an_answer_to_the_mount_on_screen_confirms_no_other(operator, qapp):
    put(operator.ask, mount("end"))
    qapp.processEvents()
    put(operator.ask, mount("face-up"))
    operator.answer(CONFIRMED)
    assert operator.poll() is None
    qapp.processEvents()
    operator.answer(CONFIRMED)
    assert operator.poll() == YES


def test_an_answer_to_a_mount_is_no_reading(operator, qapp):
    put(operator.ask, mount("end"))
    qapp.processEvents()
    put(operator.ask_reading, "Reading?")
    operator.answer(CONFIRMED)
    assert operator.poll() is None


def test_what_was_said_twice_answers_one_question(operator, qapp):
    put(operator.ask, mount("end"))
    qapp.processEvents()
    operator.answer(CONFIRMED)
    operator.answer(CONFIRMED)
    assert operator.poll() == YES
    put(operator.ask, mount("face-up"))
    qapp.processEvents()
    assert operator.poll() is None
