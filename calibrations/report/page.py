"""A report in words as one HTML page that needs nothing else, with figures that can be zoomed and read."""

from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any, Final

from jinja2 import Environment, PackageLoader, StrictUndefined

_FOLDER: Final = Path(__file__).parent


def html(content: Mapping[str, Any]) -> str:
    """The page of what `written` made; the same content gives the same text."""
    return _templates().get_template("report.html.j2").render(content)


@cache
def _templates() -> Environment:
    environment = Environment(
        loader=PackageLoader("tumble.calibrations", "report"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.globals["style"] = (_FOLDER / "style.css").read_text("utf-8")
    environment.globals["script"] = (_FOLDER / "figures.js").read_text("utf-8")
    return environment
