import pytest

from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.calibrations.methods.dividing_head.loop.misreading import MISREADING
from tumble.calibrations.methods.head_reference.effects import HEAD_EFFECTS
from tumble.calibrations.methods.temperature.effects import run_effects
from tumble.messages import Language
from tumble.window.look.language import speak
from tumble.window.look.names import effect_name, has_name, mount_name


@pytest.fixture
def german(qapp):
    speak(Language.GERMAN)
    yield
    speak(Language.ENGLISH)


def test_every_mount_has_a_name_for_the_operator():
    assert all(has_name(mount) for mount in MOUNTS)


def test_every_effect_has_a_name_for_the_operator():
    effects = (*CATALOGUE, *HEAD_EFFECTS, *run_effects("mV/g"))
    assert all(has_name(word) for word in (MISREADING, *(effect.word for effect in effects)))


def test_names_are_those_of_the_language(german):
    assert mount_name("face-down") == "Grundfläche oben"
    assert effect_name("scale_drift") == "Drift des Skalenfaktors"


def test_an_effect_of_the_users_own_keeps_its_word(german):
    assert effect_name("magnet {2}") == "magnet {2}"
