"""Whatever an instrument or a run raises for a person to read is a message, not text that nobody can translate."""

import ast
import inspect
from pathlib import Path

import pytest

from tumble.drivers import errors as of_drivers
from tumble.messages import Language, Message
from tumble.procedures import errors as of_procedures

ROOT = Path(__file__).parents[2]
FOLDERS = ("app", "procedures", "drivers", "emulators", "calibrations", "window")
FAULTS_OF_THE_PROGRAM = {
    "AssertionError",
    "AttributeError",
    "ProcedureError",  # a procedure asks for what makes no sense
    "PydanticCustomError",  # whose text `procedures.validation` knows
}
"""Nobody but a programmer reads them; or somebody puts them into words elsewhere."""


def is_text(node):
    """Whether a node is words for a person, and no message: formatted, or a literal of more than one word."""
    return isinstance(node, ast.JoinedStr) or (
        isinstance(node, ast.Constant) and isinstance(node.value, str) and " " in node.value.strip()
    )


def makes_error(call):
    return ast.unparse(call.func).rpartition(".")[2].endswith(("Error", "Exception"))


def texts_of_errors(source):
    """Lines on which an exception is given text that is no message, whether it is raised there or handed on."""
    nodes = list(ast.walk(ast.parse(source)))
    raised = [node.exc for node in nodes if isinstance(node, ast.Raise) and isinstance(node.exc, ast.Call)]
    made = [node for node in nodes if isinstance(node, ast.Call) and makes_error(node)]
    for call in {*raised, *made}:
        given = [*call.args, *(keyword.value for keyword in call.keywords)]
        if ast.unparse(call.func).rpartition(".")[2] not in FAULTS_OF_THE_PROGRAM and any(map(is_text, given)):
            yield call.lineno


@pytest.mark.parametrize("folder", FOLDERS)
def test_no_exception_is_given_plain_text(folder):
    paths = sorted((ROOT / folder).rglob("*.py"))
    found = [f"{path.relative_to(ROOT)}:{line}" for path in paths for line in texts_of_errors(path.read_text("utf-8"))]
    assert found == []


@pytest.mark.parametrize(
    "source",
    [
        'raise ValueError(f"{x} is no angle")',
        'raise DeviceError("head", Message("is lost"), "look for it")',
        'raise self._lost("the port is closed")',
        'error = errors.LinkLostError(device, happened=f"{x}", remedy=Message("go"))',
    ],
)
def test_plain_text_is_found(source):
    assert list(texts_of_errors(source)) == [1]


DEVICE_ERRORS = [
    kind for _, kind in inspect.getmembers(of_drivers, inspect.isclass) if issubclass(kind, of_drivers.DeviceError)
]


@pytest.mark.parametrize("kind", DEVICE_ERRORS, ids=lambda kind: kind.__name__)
def test_a_fault_of_a_device_is_one_sentence_in_every_language(kind):
    fault = kind(Message("dividing head"), of_drivers.NO_ANSWER, of_drivers.CHECK_CABLE)
    assert str(fault) == "dividing head: does not answer; check its cable, then resume the run"
    assert (
        str(fault).in_language(Language.GERMAN) == "Teilkopf: antwortet nicht; Kabel prüfen, dann den Lauf fortsetzen"
    )


PROCEDURE_ERRORS = [kind for _, kind in inspect.getmembers(of_procedures, inspect.isclass)]


@pytest.mark.parametrize("kind", PROCEDURE_ERRORS, ids=lambda kind: kind.__name__)
def test_what_ends_a_run_keeps_its_message(kind):
    error = kind(Message("the recording failed: {what}; then resume the run", what=OSError(Message("is no file"))))
    assert str(error).in_language(Language.GERMAN).endswith("keine Datei; dann den Lauf fortsetzen")
