"""The closed loop names effects in words of the language, those that could not be told apart among them."""

import pytest

import tumble.calibrations.methods.dividing_head.method  # noqa: F401  # declares the words
from tumble.calibrations.tracing.experiments import Experiment
from tumble.calibrations.tracing.sentences import Finding
from tumble.messages import Language
from tumble.window.look.language import speak
from tumble.window.screens.loop_view import LoopView
from tumble.window.work.presentation import Drawn, LoopSummary

FOUND = Finding(
    name="k_yy",
    others=("k_zz", "head_eccentricity"),
    belongs_to="unit",
    coefficients="1.0",
    p_value="0.001",
)


@pytest.fixture
def shown(qtbot, qapp):
    """What the line of a finding says, in a language."""

    def show(language):
        speak(language)
        view = LoopView()
        qtbot.addWidget(view)
        view.show_loop(LoopSummary(findings=[FOUND], experiments=[]))
        return view.findings.texts()[0]

    yield show
    speak(Language.ENGLISH)


@pytest.mark.parametrize(
    ("language", "words"),
    [
        (Language.ENGLISH, "second-order nonlinearity k_zz or eccentricity of the head's circle"),
        (Language.GERMAN, "Nichtlinearität zweiter Ordnung k_zz oder Exzentrizität des Teilkreises"),
        (Language.UKRAINIAN, "нелінійність другого порядку k_zz або ексцентриситет лімба головки"),
    ],
)
def test_what_could_not_be_told_apart_is_named_as_what_was_found(shown, language, words):
    _, others, *_ = shown(language)
    assert others == words


PROBE = Experiment(
    separates=("k_yy",), programme="probe-edge", why="parts them", command="", separation=20.0, stand_time_s=519.0
)
PICTURE = "<svg xmlns='http://www.w3.org/2000/svg' width='40' height='20'></svg>"


@pytest.fixture
def view(qtbot, qapp):
    made = LoopView()
    qtbot.addWidget(made)
    return made


def test_the_button_says_what_it_runs_and_how_long_that_takes(view):
    view.show_loop(LoopSummary(experiments=[PROBE]))
    assert view.run_button.text() == "Run probe-edge, about 8:39  [F5]"
    assert view.run_button.accessibleName() == "Run probe-edge, about 8:39"


def test_the_residual_before_and_after_is_a_picture_beside_the_numbers(view):
    view.show_loop(LoopSummary(experiments=[], figures=[Drawn(title="", svg=PICTURE, caption="Before and after.")]))
    assert len(view.figures.figures) == 1
    view.show_loop(LoopSummary(experiments=[]))
    assert view.figures.figures == []
    assert view.figures.isHidden()
