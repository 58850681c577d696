"""Text from outside cannot command a terminal, and a name can be seen."""

import pytest

from tumble.drivers.text import LONGEST_NAME, check_name, reason_of, visible


@pytest.mark.parametrize(
    ("text", "shown"),
    [
        ("DXL[rev2]7", "DXL[rev2]7"),
        ("жук 日本 12°34′56″ C:\\new", "жук 日本 12°34′56″ C:\\new"),
        ("\x1b[2J", r"\x1b[2J"),
        ("a\0b\nc\rd\te", r"a\x00b\x0ac\x0dd\x09e"),
        ("\x9b31m", r"\x9b31m"),
        ("\u202egpj.exe", r"\u202egpj.exe"),
        ("\u2066a\u2069", r"\u2066a\u2069"),
        ("a\u2028b", r"a\u2028b"),
        ("\udcff", r"\udcff"),
        ("\U000e0041", r"\U000e0041"),
    ],
)
def test_what_cannot_be_seen_is_shown_as_an_escape(text, shown):
    assert visible(text) == shown


@pytest.mark.parametrize("number", [*range(0x20), *range(0x7F, 0xA0), *range(0x202A, 0x202F), *range(0x2066, 0x206A)])
def test_no_control_character_is_left(number):
    assert chr(number) not in visible(f"a{chr(number)}b")


def test_the_middle_of_a_long_text_gives_way():
    shown = visible("begin" + "x" * 10_000 + "end", 100)
    assert shown.startswith("begin")
    assert shown.endswith("end")
    assert len(shown) == 103


@pytest.mark.parametrize("text", ["", "SN-7", "[bold]x[/foo]", "../x", "NUL", "日本", "a/b\\c", "x" * LONGEST_NAME])
def test_plain_text_is_a_name(text):
    assert check_name(text) == text


@pytest.mark.parametrize("text", ["x" * (LONGEST_NAME + 1), "a\nb", "a\0", "\udcff", "\x1b", "\u202e"])
def test_what_cannot_be_seen_or_read_is_no_name(text):
    with pytest.raises(ValueError, match=r"are no name|cannot be seen"):
        check_name(text)


def test_an_error_that_cannot_say_why_has_a_reason_all_the_same():
    class SilentError(Exception):
        def __str__(self):
            raise self

    assert reason_of(SilentError()) == "SilentError: it cannot say why"
