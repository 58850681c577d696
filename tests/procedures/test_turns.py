"""Two positioners that one person sets: the questions come one after the other."""

from tumble.drivers.clock import VirtualClock
from tumble.procedures.eyepiece import OperatorEyepiece
from tumble.procedures.operator import Answer
from tumble.procedures.turns import Turns


class Person:
    """Hears prompts, and answers what is put into `answers`."""

    def __init__(self):
        self.heard, self.answers = [], []

    def ask_reading(self, prompt):
        self.heard.append(prompt)

    def poll(self):
        return Answer(text=self.answers.pop(0), confirmed=True) if self.answers else None


def two_eyepieces():
    person = Person()
    turns, clock = Turns(person), VirtualClock()
    askers = [turns.asker(), turns.asker()]
    names = ("outer", "inner")
    return person, [OperatorEyepiece(a, clock, 0.01, n, a.withdraw) for a, n in zip(askers, names, strict=True)]


def test_only_the_first_question_is_asked_at_once():
    person, (outer, inner) = two_eyepieces()
    outer.show(90.0)
    inner.show(45.0)
    assert person.heard == ["Set outer to 90° 00′ 00″; Enter when it reads so, or type the reading."]


def test_an_answer_goes_to_the_question_that_was_asked():
    person, (outer, inner) = two_eyepieces()
    outer.show(90.0)
    inner.show(45.0)
    person.answers = ["90 00 10"]
    assert (inner.reading_deg(), outer.reading_deg()) == (None, 90.0 + 10 / 3600)
    person.answers = ["45 00 02"]
    assert (outer.reading_deg(), inner.reading_deg()) == (None, 45.0 + 2 / 3600)


def test_a_question_that_was_withdrawn_holds_up_no_other():
    person, (outer, inner) = two_eyepieces()
    outer.show(90.0)
    inner.show(45.0)
    outer.withdraw()
    inner.show(45.0)
    person.answers = [""]
    assert inner.reading_deg() == 45.0
