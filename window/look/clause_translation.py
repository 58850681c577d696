"""Translation of what the analysis says as English text alone, clause by clause.

It stands in until every message of the analysis carries its template and fields. Then this file and `analysis_clauses`
go, and `tumble.window.look.sentences.in_language`, the only one that asks here, gives plain text back as it is.
"""

import re
from functools import cache
from typing import Final

from tumble.messages import translatable, translate
from tumble.window.look.analysis_clauses import ANALYSIS_CLAUSES
from tumble.window.look.language import spoken
from tumble.window.look.names import EFFECT_NAMES, effect_name

_BRACES: Final = "((?:(?!; ).)+?)"
"""Anything but the border of two clauses."""
_BETWEEN: Final = {", ": ", ", " and ": translatable(" and "), " or ": translatable(" or ")}
_BORDER: Final = re.compile(f"({'|'.join(_BETWEEN)})")


def by_clauses(text: str) -> str:
    """Text of which every clause that is known is put into the language of the window; any other stays as it is."""
    for clause, end in ((text.removesuffix("."), "." * text.endswith(".")), (text, "")):
        if (whole := _clause(clause)) is not None:
            return whole + end
    if set((names := _BORDER.split(text))[::2]) <= EFFECT_NAMES.keys():
        return "".join(translate(_BETWEEN[part], spoken()) if part in _BETWEEN else effect_name(part) for part in names)
    for separator in (". ", "; "):
        if separator in text:
            return separator.join(map(by_clauses, text.split(separator)))
    return text


def _clause(text: str) -> str | None:
    """A clause that is known; of several that fit, the one with the most words of its own."""
    fitting = [(template, found) for template, pattern in _patterns() if (found := pattern.fullmatch(text))]
    if not fitting:
        return None
    template, found = max(fitting, key=lambda fit: len(fit[0].replace("{}", "")))
    return translate(template, spoken()).format(*map(by_clauses, found.groups()))


@cache
def _patterns() -> list[tuple[str, re.Pattern[str]]]:
    return [(template, re.compile(re.escape(template).replace(r"\{\}", _BRACES))) for template in ANALYSIS_CLAUSES]
