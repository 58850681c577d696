"""A report as one HTML page that needs nothing else, with figures that can be zoomed and read."""

from functools import cache
from pathlib import Path
from typing import Any, Final

from jinja2 import Environment, PackageLoader, StrictUndefined

from tumble.calibrations.report.document import Report
from tumble.calibrations.report.written import written

_FOLDER: Final = Path(__file__).parent


def html(report: Report) -> str:
    """The page, in the language of `written_in`; the same input gives the same text."""
    return body(written(report))


def body(content: dict[str, Any]) -> str:
    """The page of a report in words."""
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
