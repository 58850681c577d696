"""Letters in a figure: how large they are, and how much room they take."""

from html import escape
from typing import Final

SIZE: Final = 11
"""Of letters, in units of which a page is 720 wide."""
LETTER: Final = 6.0
BOLD: Final = 7.4
"""So wide one is at most, on the whole."""
LINE: Final = 15.0
"""From one line to the next."""


def to_fit(text: str, room: float, letter: float = LETTER) -> str:
    """The size of letters in which a text is no longer than the room that it has; nothing where it is short enough."""
    size = SIZE * min(1.0, room / (letter * max(len(text), 1)))
    return "" if size == SIZE else f' font-size="{size:.1f}"'


def in_lines(text: str, lines: int) -> list[str]:
    """A text in one line, or in two where there are words to divide, at the space nearest to its middle."""
    spaces = [place for place, letter in enumerate(text) if letter == " "]
    if lines == 1 or not spaces:
        return [text]
    middle = min(spaces, key=lambda place: abs(place - len(text) / 2))
    return [text[:middle], text[middle + 1 :]]


def text_at(x: float, y: float, text: str, anchor: str, more: str = "") -> str:
    """A text that begins, ends or has its middle (`anchor`) at a place."""
    return f'<text x="{x:.1f}" y="{y:.1f}" text-anchor="{anchor}"{more}>{escape(text)}</text>'
