"""No catalogue lacks a key of the source, holds one that is gone, or loses what stands in braces."""

import ast
import gettext
import re
import subprocess
import sys
from pathlib import Path
from string import Formatter

import pytest
from babel.messages.pofile import read_po

from tumble.messages import Language

ROOT = Path(__file__).parents[2]
LANGUAGES = [language for language in Language if language is not Language.ENGLISH]


@pytest.fixture(scope="module")
def source(tmp_path_factory):
    found = tmp_path_factory.mktemp("texts") / "tumble.pot"
    command = [sys.executable, "setup.py", "--quiet", "extract_messages", "--output-file", found]
    subprocess.run(command, cwd=ROOT, check=True, capture_output=True)
    return keys(read(found))


def read(path):
    with path.open("rb") as file:
        return [message for message in read_po(file) if message.id]


def keys(messages):
    return {message.id for message in messages}


def catalogue(language):
    return ROOT / "tumble" / "locales" / language / "LC_MESSAGES" / "tumble.po"


def translated(language):
    """The messages that have words, which stand in the catalogue in two languages."""
    return [message for message in read(catalogue(language)) if message.string]


def wordings(text):
    return [text] if isinstance(text, str) else list(text)


def fields(text):
    """What stands in braces, with conversion and format; bare braces by their place."""
    found = [part[1:] for part in Formatter().parse(text) if part[1] is not None]
    return sorted((name or str(place), *rest) for place, (name, *rest) in enumerate(found))


def has_words(key):
    """Whether anything stands beside the fields; `{path}: {error}` is the same in every language."""
    return any(
        letter.isalpha() for wording in wordings(key) for text, *_ in Formatter().parse(wording) for letter in text
    )


@pytest.mark.parametrize("language", LANGUAGES)
def test_it_holds_every_key_of_the_source_and_no_other(language, source):
    held = keys(read(catalogue(language)))
    assert source - held == set(), "run `make texts`, and translate what is new"
    assert held - source == set(), "run `make texts`, which takes out what is gone"


@pytest.mark.parametrize("language", LANGUAGES)
def test_it_leaves_nothing_untranslated(language):
    wanting = [m.id for m in read(catalogue(language)) if m.fuzzy or not all(wordings(m.string))]
    assert [key for key in wanting if has_words(key)] == []


@pytest.mark.parametrize("language", LANGUAGES)
def test_it_keeps_what_stands_in_braces(language):
    for message in translated(language):
        allowed = [fields(wording) for wording in wordings(message.id)]
        assert all(fields(wording) in allowed for wording in wordings(message.string)), message.id


@pytest.mark.parametrize("language", LANGUAGES)
def test_it_keeps_access_keys_marks_and_the_space_at_the_ends(language):
    for message in translated(language):
        for text in wordings(message.string):
            of = wordings(message.id)[0]
            assert text.count("&") == of.count("&"), of
            assert re.findall("[✓✗⚠⬢…\n]", text) == re.findall("[✓✗⚠⬢…\n]", of), of
            assert (text[0] == " ", text[-1] == " ") == (of[0] == " ", of[-1] == " "), of


@pytest.mark.parametrize("language", LANGUAGES)
def test_what_is_compiled_is_what_was_written(language):
    compiled = gettext.translation("tumble", ROOT / "tumble" / "locales", [language])
    stale = [m.id for m in translated(language) if isinstance(m.id, str) and compiled.gettext(m.id) != m.string]
    assert stale == [], "run `make setup`, which compiles the catalogues"


def test_bare_braces_count_by_their_place():
    assert fields("{} of {}") == fields("{1} von {0}") != fields("{} von {x}")


TR = ROOT / "window" / "look" / "language.py"
"""Where `tr` hands on what the others gave it."""
KEYS = {"Message": 1, "Message.counted": 2, "translatable": 1, "tr": 1}
"""What marks text for the catalogue, and how many of its arguments are keys."""


def computed_keys(path):
    """Calls whose key is no literal, which nobody can find for the catalogue."""
    calls = [node for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call)]
    for call in calls:
        marked = call.args[: KEYS.get(ast.unparse(call.func), 0)]
        if not all(isinstance(argument, ast.Constant) for argument in marked):
            yield f"{path.name}:{call.lineno}"


def test_every_key_is_a_literal_of_the_source():
    folders = ("window", "app", "procedures", "drivers", "calibrations")
    paths = [path for folder in folders for path in (ROOT / folder).rglob("*.py")]
    found = [place for path in paths if path != TR for place in computed_keys(path)]
    assert found == []


def literal_keys(path):
    """The keys that stand in a file, as its syntax tree has them."""
    calls = [node for node in ast.walk(ast.parse(path.read_text("utf-8"))) if isinstance(node, ast.Call)]
    for call in calls:
        arguments = [each.value for each in call.args if isinstance(each, ast.Constant)]
        match ast.unparse(call.func), arguments:
            case "Message" | "translatable" | "tr", [key, *_]:
                yield key
            case "Message.counted", [singular, plural, *_]:
                yield singular, plural
            case "Message.named", [*_, wording]:
                yield wording


def test_none_is_overlooked_when_they_are_collected(source):
    """As happens after a variable that is called like one of the functions that mark text."""
    folders = ("window", "app", "procedures", "drivers", "calibrations")
    written = {key for folder in folders for path in (ROOT / folder).rglob("*.py") for key in literal_keys(path)}
    assert written - source - {""} == set()


def test_the_window_takes_no_text_from_qt():
    taken = re.compile(r"self\.tr\(|QCoreApplication\.translate|QT_TRANSLATE_NOOP")
    found = [path.name for path in (ROOT / "window").rglob("*.py") if taken.search(path.read_text("utf-8"))]
    assert found == []


@pytest.mark.parametrize("word", ["Standdatei", "Standdatensatz", "Ablage", "Messstand"])
def test_german_has_one_word_for_stand_file_stand_record_and_store(word):
    strings = [text for message in translated("de") for text in wordings(message.string)]

    assert [text for text in strings if word in text] == []


NEVER_ONE = {
    "{length} characters": "said of what is too long",
    "{samples} samples at": "said of what is too many",
    "of {angles} angles those": "said of more than are listed",
    "comes back {count} times": "asked only where a pose comes back",
    "{turns} turns for one": "asked only where they are more",
}
"""Parts of keys that have a number before a plural, and why that number is never one."""
BOUNDS = ("most", "fewest", "tries", "attempts")
"""Fields with numbers that the program sets, none of which is one."""


def words(text):
    return re.findall(r"[a-z]+", re.sub(r"\{[^}]*\}", " ", text))


def counted_nouns(source):
    """What is counted anywhere, in the plural."""
    pairs = [key for key in source if not isinstance(key, str)]
    return {word for one, many in pairs for word in set(words(many)) - set(words(one)) if word.endswith("s")}


def wrongly_plural(key, nouns):
    """Whether a key would read `1 points`; a number with a format is a measure, or has thousands."""
    counted = any(field not in BOUNDS and noun in nouns for field, noun in _pairs(key))
    return counted and not any(part in key for part in NEVER_ONE)


def _pairs(key):
    """Every field with the word after it, and with the one after that."""
    for field, first, second in re.findall(r"\{(\w+)\} ([a-z]+)(?: ([a-z]+))?\b", key):
        yield field, first
        if first != "and":
            yield field, second


def test_what_is_counted_has_a_wording_for_one(source):
    nouns = counted_nouns(source)
    assert {"points", "rows", "dwells", "samples", "times", "settings", "records"} <= nouns
    assert [key for key in source if isinstance(key, str) and wrongly_plural(key, nouns)] == []


@pytest.mark.parametrize(
    ("key", "wrong"),
    [
        ("The run goes on; {points} points are there", True),
        ("{rows} usable rows are too few", True),
        ("{rows:,} rows are too many", False),
        ("row {row} and rows like it", False),
        ("its output turns {factor:g} times as far", False),
        ("points: {count}", False),
    ],
)
def test_a_number_before_a_plural_is_noticed(key, wrong):
    assert wrongly_plural(key, {"points", "rows", "times"}) is wrong


def test_in_ukrainian_a_number_is_said_in_the_form_of_one_too_which_is_that_of_21():
    counted = [message.string for message in translated("uk") if not isinstance(message.id, str)]
    assert [one for one, *_, many in counted if "{count" in many and "{count" not in one] == []
