"""The closed loop names effects in words of the language, those that could not be told apart among them."""

from types import SimpleNamespace

import pytest

import tumble.calibrations.methods.dividing_head.method  # noqa: F401  # declares the words
from tumble.calibrations.tracing.sentences import Finding
from tumble.messages import Language
from tumble.window.look.language import speak
from tumble.window.screens.loop_view import LoopView

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
        view.show_loop(
            SimpleNamespace(
                headline="", findings=[FOUND], comparisons=[], not_identifiable=[], dependence="", experiments=[]
            )
        )
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
