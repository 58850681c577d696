"""Looking for English in what is said in another language."""

import re
from html import unescape

from tumble.messages import Message

WORDS = re.compile(r"(?<!\w)[A-Za-z]{2,} [A-Za-z]{2,}(?!\w)")
"""Two words in a row; numbers with units, symbols and names of columns have none."""


def plain_sentences(said):
    """Parts of what is said that no catalogue can translate: text with words in it that is no message."""
    if isinstance(said, Message):
        return [found for field in said.fields.values() for found in plain_sentences(field)]
    if isinstance(said, Exception):
        return plain_sentences(str(said))
    if isinstance(said, str):
        return [said] if WORDS.search(said) else []
    return []


def said_in(sections):
    """Every text of sections of a result."""
    for section in sections:
        yield from (section.title, section.caption, *section.lines, *section.headings)
        yield from (cell for row in section.rows for cell in row)


def texts(page):
    """The texts of a page without its style, and what is read out of figures and lists."""
    body = re.sub(r"<style>.*?</style>|<script>.*?</script>", "", page, flags=re.DOTALL)
    labels = re.findall(r'aria-label="([^"]*)"', body)
    shown = re.sub(r"<svg.*?</svg>", "", body, flags=re.DOTALL)
    return {unescape(text).strip() for text in [*labels, *re.split(r"<[^>]*>", shown)]}


def left_in_english(page, english_page):
    """Texts with words that stand in a page as in the English one."""
    same = texts(page) & texts(english_page)
    return sorted(text for text in same if WORDS.search(re.sub(r"\S+\.csv", "", text)))
