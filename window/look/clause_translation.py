"""Translation of what comes as English text alone, clause by clause.

It stands in until every message of the engine, the drivers and the analysis carries its template and fields, and goes
then with `clauses` and `analysis_clauses`.
"""

import re
from functools import cache
from typing import Final

from tumble.messages import translatable, translate
from tumble.window.look.analysis_clauses import ANALYSIS_CLAUSES
from tumble.window.look.clauses import CLAUSES
from tumble.window.look.language import spoken
from tumble.window.look.names import effect_name, has_name

_BRACES: Final = "((?:(?!; ).)+?)"
"""Anything but the border of two clauses."""
_BETWEEN: Final = {", ": ", ", " and ": translatable(" and "), " or ": translatable(" or ")}
_BORDER: Final = re.compile(f"({'|'.join(_BETWEEN)})")


def by_clauses(text: str) -> str:
    """Text of which every clause that is known is put into the language of the window; any other stays as it is."""
    for clause, end in ((text.removesuffix("."), "." * text.endswith(".")), (text, "")):
        if (whole := _clause(clause)) is not None:
            return whole + end
    if all(map(has_name, (names := _BORDER.split(text))[::2])):
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
    templates = (*CLAUSES, *ANALYSIS_CLAUSES)
    return [(template, re.compile(re.escape(template).replace(r"\{\}", _BRACES))) for template in templates]
