"""How a unit is to be mounted is asked in the language of whoever mounts it."""

import pytest

from tumble.drivers.mountings import Mounting
from tumble.drivers.tables import MOUNT
from tumble.messages import Language
from tumble.procedures.methods.vibration.layout import LAYOUT


@pytest.mark.parametrize(
    ("language", "task"),
    [
        (
            Language.ENGLISH,
            "mount the unit with x along i, y along -o, p down (i: input, o: output, p: pendulous axis)",
        ),
        (
            Language.GERMAN,
            "den Prüfling mit x längs i, y längs -o, p nach unten montieren "
            "(i: Eingangs-, o: Ausgangs-, p: Pendelachse)",
        ),
    ],
)
def test_a_mounting_is_asked_for_in_the_language(language, task):
    ask = LAYOUT.ask(MOUNT, Mounting(x="i", y="-o", down="p").text)
    assert ask.task.in_language(language) == task


def test_the_condition_stays_what_the_contract_calls_it():
    text = Mounting(x="i", y="o", down="p").text
    assert (type(text), text) == (str, "x along i, y along o, p down")
