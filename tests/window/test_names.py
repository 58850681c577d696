import pytest

from tumble.calibrations.methods.dividing_head.effects import CATALOGUE
from tumble.calibrations.methods.dividing_head.geometry import MOUNTS
from tumble.calibrations.methods.dividing_head.loop.misreading import MISREADING
from tumble.calibrations.methods.head_reference.effects import HEAD_EFFECTS
from tumble.calibrations.methods.temperature.effects import run_effects
from tumble.messages import Language, Message, with_wording
from tumble.procedures.events import PointVerified
from tumble.window.look.conditions import ConditionWords
from tumble.window.look.language import speak
from tumble.window.look.names import effect_name
from tumble.window.look.sentences import sentence_of
from tumble.window.methods.dividing_head.mounts import mount_name
from tumble.window.widgets.run_plots import SamplesPlot


@pytest.fixture
def german(qapp):
    speak(Language.GERMAN)
    yield
    speak(Language.ENGLISH)


def test_every_mount_has_a_name_for_the_operator():
    assert all(isinstance(with_wording(mount), Message) for mount in MOUNTS)


def test_every_effect_has_a_name_for_the_operator():
    effects = (*CATALOGUE, *HEAD_EFFECTS, *run_effects("mV/g"))
    assert all(isinstance(with_wording(word), Message) for word in (MISREADING, *(effect.word for effect in effects)))


def test_names_are_those_of_the_language(german):
    assert mount_name("face-down") == "Grundfläche oben"
    assert effect_name("scale_drift") == "Drift des Skalenfaktors"


def test_an_effect_of_the_users_own_keeps_its_word(german):
    assert effect_name("magnet {2}") == "magnet {2}"


@pytest.mark.parametrize(
    ("channel", "said"),
    [
        ("voltage_v", "Point 7 was taken again: 1.500000 V now, 1.250000 V before."),
        ("pressure_hpa", "Point 7 was taken again: pressure_hpa 1.5 now, 1.25 before."),
    ],
)
def test_only_what_is_in_volts_is_said_to_be(qapp, channel, said):
    event = PointVerified(point=7, channel=channel, now=1.5, recorded=1.25, allowed=0.001)
    assert sentence_of(event, ConditionWords()) == said


@pytest.mark.parametrize(("channel", "title"), [("voltage_v", "samples (V)"), ("pressure_hpa", "samples")])
def test_samples_that_are_no_volts_are_not_called_so(qtbot, channel, title):
    plot = SamplesPlot()
    qtbot.addWidget(plot)
    plot.begin([channel])
    assert plot._left == title
