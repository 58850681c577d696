"""TOML that breaks a parser is refused with its line, and a byte order mark is passed over."""

import pytest

from tumble.procedures.errors import InputError
from tumble.procedures.methods.dividing_head.programme import DividingHeadProgramme
from tumble.procedures.programmes import load_programme
from tumble.procedures.toml_lines import MOST_BYTES, line_of, load_toml, parse_toml, read_text
from tumble.procedures.toml_text import read_toml

PROGRAMME = 'name = "p"\n[[procedure]]\nkind = "flip"\naxes = ["x"]\n'
BEYOND = {
    "deep arrays": (f"a = 1\nb = {'[' * 9000}", "line 2: more than 32 brackets within each other"),
    "deep tables": ("a = " + "{b = " * 500, "line 1: more than 32 brackets within each other"),
    "brackets after text over lines": (
        'a = """[[\n[[[["""\n# [[[[\nb = ' + "[" * 40,
        "line 4: more than 32 brackets within each other",
    ),
    "a key of many parts": ("a = 1\n" + "k." * 5000 + "k = 1", "line 2: a key of more than 32 parts"),
    "the same, spaced": ("k . " * 5000 + "k = 1", "line 1: a key of more than 32 parts"),
    "the same, quoted": ('"k".' * 5000 + "k = 1", "line 1: a key of more than 32 parts"),
    "a header of many parts": ("[" + "k." * 5000 + "k]", "line 1: a key of more than 32 parts"),
    "a huge integer": ("a = 1\nrealisations = " + "9" * 5000, "line 2: a number of 5000 characters"),
    "a huge hexadecimal integer": ("a = 0x" + "f" * 300, "line 1: a number of 302 characters"),
    "a huge float": ("a = -" + "1" * 400 + ".0", "line 1: a number of 403 characters"),
    "a key twice": ("a = 1\na = 2", "line 2: not TOML: Cannot overwrite a value"),
    "a table twice": ("[a]\n[a]", "line 2: not TOML: Cannot declare ('a',) twice"),
    "a day that is none": ("a = 2026-02-30", "line 1: not TOML: Invalid date or datetime"),
    "a control character": ('a = 1\nb = "\0"', "line 2: not TOML: Illegal character '\\x00'"),
    "half a pair": ('a = "\\ud800"', "line 1: not TOML: Escaped character is not a Unicode scalar value"),
    "nothing but quotes": ('"' * 999, "line 1: not TOML: "),
}


@pytest.mark.parametrize(("text", "complaint"), BEYOND.values(), ids=BEYOND)
def test_it_is_refused_with_its_line(text, complaint):
    with pytest.raises(InputError) as told:
        read_toml(text, "s.toml")
    assert str(told.value).startswith(f"s.toml, {complaint}")
    assert len(str(told.value)) < 200


@pytest.mark.parametrize("text", ["a = 1", f'a = "{"[" * 99}"', "a = [[1.5, 2.5], [3.5, 4.5]]", "a.b.c = 1"])
def test_what_people_write_is_read(text):
    assert "a" in read_toml(text, "s.toml")


VALUES = {
    "infinite": ("dwell_s = inf", "dwell_s: Input should be"),
    "too large for a double": ("dwell_s = 1e999", "dwell_s: Input should be"),
    "no number": ("settle_s = nan", "settle_s: Input should be"),
    "a date": ("dwell_s = 2026-01-01", "dwell_s: Input should be a valid number"),
    "an array": ("dwell_s = [[1.0]]", "dwell_s: Input should be a valid number"),
    "an integer beyond 64 bits": ("realisations = 99999999999999999999999", "realisations: Input should be less"),
}


@pytest.mark.parametrize(("line", "complaint"), VALUES.values(), ids=VALUES)
def test_values_that_are_none_are_refused_with_their_line(line, complaint):
    with pytest.raises(InputError) as told:
        parse_toml(PROGRAMME.replace("[[", f"{line}\n[[", 1), DividingHeadProgramme, "p.toml")
    assert str(told.value).startswith(f"p.toml, line 2: {complaint}")


@pytest.mark.parametrize("name", ["x" * 101, "x" * 900_000, "a\\u0000b", "a\\nb", "\\u001b[2J", "\\u202Eevil"])
def test_a_name_that_cannot_be_shown_is_refused(name):
    with pytest.raises(InputError) as told:
        parse_toml(PROGRAMME.replace('"p"', f'"{name}"'), DividingHeadProgramme, "p.toml")
    assert str(told.value).startswith("p.toml, line 1: name: ")
    assert str(told.value).isprintable()
    assert len(str(told.value)) < 200


def test_a_byte_order_mark_is_passed_over_and_lines_stay_what_they_are(tmp_path):
    file = tmp_path / "p.toml"
    file.write_bytes(b"\xef\xbb\xbf" + PROGRAMME.encode())
    assert load_programme(file).name == "p"
    assert load_toml(file, DividingHeadProgramme).name == "p"
    assert line_of(file.read_text("utf-8"), ("name",)) == 1


def test_a_separator_of_lines_that_toml_does_not_know_counts_for_none():
    assert line_of("a = '\u2028\x0b'\nb = 1", ("b",)) == 2


def test_a_file_without_an_end_is_refused(tmp_path):
    file = tmp_path / "p.toml"
    file.write_bytes(b"#" * (MOST_BYTES + 1))
    with pytest.raises(InputError, match="more than 1,000,000 bytes are no such file"):
        read_text(file)


def test_a_name_of_a_file_that_cannot_be_is_refused(tmp_path):
    with pytest.raises(InputError, match="null"):
        read_text(tmp_path / "a\0b")
