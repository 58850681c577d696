import io
import time
from pathlib import Path
from threading import Event

import pytest

from tumble.procedures.errors import InputError, UnansweredError
from tumble.procedures.methods.dividing_head.layout import mounting
from tumble.procedures.operator import Answer, Answers, ConsoleOperator, ScriptedOperator, SeatingOperator, understand
from tumble.procedures.typed import Typed

YES = Answer(text="yes", confirmed=True)
SILENCE = Answer(text="", confirmed=False)


@pytest.mark.parametrize("text", ["edge", " Edge\n", "yes", "YES\n", "done", "seated"])
def test_the_mount_or_a_clear_word_confirms(text):
    assert understand(text, "edge") == Answer(text=text.strip(), confirmed=True)


@pytest.mark.parametrize("text", ["no", "abort\n", "Cancel"])
def test_a_clear_word_declines(text):
    assert understand(text, "edge") == Answer(text=text.strip(), confirmed=False)


@pytest.mark.parametrize("text", ["", "\n", "   ", "y", "edge-back", "face-up", "ok?"])
def test_nothing_else_says_anything(text):
    assert understand(text, "edge") is None


def operator(tmp_path: Path, text):
    path = tmp_path / "answers.toml"
    path.write_text(text, encoding="utf-8")
    return ScriptedOperator.from_file(path)


@pytest.mark.parametrize(
    ("text", "mount", "answer"),
    [
        ('[mounts]\nedge = "yes"', "edge", YES),
        ('[mounts]\nedge = "no"\ndefault = "yes"', "edge", Answer(text="no", confirmed=False)),
        ('[mounts]\nedge = "no"\ndefault = "yes"', "end", YES),
        ('[mounts]\nedge = "yes"', "end", SILENCE),
        ("", "end", SILENCE),
    ],
)
def test_an_answers_file_answers(tmp_path: Path, text, mount, answer):
    scripted = operator(tmp_path, text)
    assert scripted.poll() is None
    scripted.ask(mounting(mount))
    assert scripted.poll() == answer


def test_a_default_reading_that_is_no_angle_is_refused(tmp_path: Path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("answers.toml").write_text('[readings]\n7 = "abc"\ndefault = "abc"\n', "utf-8")
    with pytest.raises(InputError, match=r"^answers\.toml, line 1: readings: .*default: 'abc' is no angle"):
        ScriptedOperator.from_file(Path("answers.toml"))


def test_an_answers_file_that_says_something_else_is_refused(tmp_path: Path):
    with pytest.raises(InputError, match=r"^answers\.toml, line 2: mounts: edge: Input should be 'yes' or 'no'"):
        operator(tmp_path, '[mounts]\nedge = "maybe"')


class Terminal(io.StringIO):
    """A terminal on which nobody types any more than was typed; reading past it waits."""

    def __init__(self, text, typed):
        super().__init__(text)
        self.typed = typed
        self.read = Event()

    def isatty(self):
        return True

    def __next__(self):
        self.typed.wait(10.0)
        line = self.readline()
        if not line:
            self.read.set()
            raise StopIteration
        return line


def answer_of(console):
    """Poll until there is an answer; the reader is another thread, which gets its turn meanwhile."""
    deadline_s = time.monotonic() + 10.0
    while time.monotonic() < deadline_s:
        if (answer := console.poll()) is not None:
            return answer
    raise AssertionError("no answer within 10 s")


def test_lines_from_a_pipe_answer_one_request_each():
    shown = []
    console = ConsoleOperator(Typed(io.StringIO("edge\nno\n")), shown.append)
    console.ask(mounting("edge"))
    assert answer_of(console) == Answer(text="edge", confirmed=True)
    console.ask(mounting("end"))
    assert answer_of(console) == Answer(text="no", confirmed=False)
    assert shown == [mounting("edge").prompt, mounting("end").prompt]


def test_a_stray_enter_is_asked_again():
    shown = []
    console = ConsoleOperator(Typed(io.StringIO("\n\nedge\n")), shown.append)
    console.ask(mounting("edge"))
    assert answer_of(console) == Answer(text="edge", confirmed=True)
    again = "Type edge or yes when the unit sits there, or no to end the run."
    assert shown == [mounting("edge").prompt, again, again]


def test_at_the_end_of_the_input_a_request_stays_unanswered():
    console = ConsoleOperator(Typed(io.StringIO("")), lambda text: None)
    console.ask(mounting("edge"))
    assert answer_of(console) == SILENCE
    console.ask(mounting("end"))
    assert answer_of(console) == SILENCE


class Idle(io.StringIO):
    """A pipe that stays open, or a terminal at which nobody types."""

    def __init__(self, *, terminal):
        super().__init__()
        self.isatty = lambda: terminal

    def __next__(self):
        Event().wait(60.0)
        raise StopIteration


@pytest.mark.parametrize(("terminal", "answer"), [(False, SILENCE), (True, None)])
def test_nobody_waits_for_ever_for_a_line_through_a_pipe(terminal, answer):
    moments_s = iter([0.0, 3599.0, 3601.0] if not terminal else [3599.0, 1e9])
    console = ConsoleOperator(Typed(Idle(terminal=terminal)), lambda text: None, lambda: next(moments_s))
    console.ask(mounting("edge"))
    assert console.poll() is None
    assert console.poll() == answer


def test_what_was_typed_on_a_terminal_before_the_request_is_no_answer():
    typed = Event()
    typed.set()
    terminal = Terminal("yes\nyes\n", typed)
    console = ConsoleOperator(Typed(terminal), lambda text: None)
    assert terminal.read.wait(10.0)
    console.ask(mounting("edge"))
    assert answer_of(console) == SILENCE


def test_nobody_waits_for_a_terminal():
    typed = Event()
    console = ConsoleOperator(Typed(Terminal("edge\n", typed)), lambda text: None)
    console.ask(mounting("edge"))
    assert console.poll() is None
    typed.set()
    assert answer_of(console) == Answer(text="edge", confirmed=True)


def test_a_simulated_unit_is_seated_once_it_is_confirmed():
    seated = []
    operator = SeatingOperator(ScriptedOperator(Answers(mounts={"edge": "yes", "end": "no"})), {"mount": seated.append})
    operator.ask(mounting("end"))
    assert operator.poll() == Answer(text="no", confirmed=False)
    operator.ask(mounting("edge"))
    assert operator.poll() == YES
    assert seated == ["edge"]


def test_input_that_cannot_be_read_is_told_with_its_reason():
    console = ConsoleOperator(Typed(io.TextIOWrapper(io.BytesIO(b"\xff\xfe\n"), "utf-8")), lambda text: None)
    console.ask(mounting("edge"))
    with pytest.raises(UnansweredError, match=r"the answer could not be read .UnicodeDecodeError: .* resume the run"):
        answer_of(console)


@pytest.mark.parametrize(("word", "confirmed"), [("ja", True), ("так", True), ("nein", False), ("ні", False)])
def test_a_yes_and_a_no_of_every_language_are_understood(word, confirmed):
    assert understand(word, "edge").confirmed is confirmed
