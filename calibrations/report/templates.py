"""The templates of all pages."""

from functools import cache

from jinja2 import ChoiceLoader, Environment, PackageLoader, StrictUndefined

from tumble.calibrations.report.language import finalized, language
from tumble.messages import Message


@cache
def templates(package: str = "") -> Environment:
    """Templates of a method, in the folder `report` of its package, beside those that all share.

    Their own texts are written as `{{ Message("…") }}`, and come out in the language of the page.
    """
    shared = PackageLoader("tumble.calibrations", "report")
    environment = Environment(
        loader=ChoiceLoader([PackageLoader(package, "report"), shared]) if package else shared,
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=finalized,
    )
    environment.globals["Message"] = Message
    environment.globals["language"] = language
    return environment
